// Our own pictures as H.264 in MP4 or VP9 with alpha in WebM, encoded by libav; in the child
// (video export): the parent -> [libav_film.h] -> the parent.
//
//   mp4   libx264, 4:2:0, BT.709, fragments of two seconds; alpha over the background; an
//         odd side gets one more row or column, a repetition of the last
//   webm  libvpx-vp9, 4:2:0 and alpha, BT.709; written without going back, so without an
//         index; below clear pixels lies the colour of what is next to them
//
// One thread and no dates: the same pictures give the same film.
//
// Errors  kUnavailable (this libav has no such encoder), kInvalidArgument (what the encoder
//         refuses, with its words), kTooLarge (memory).
// Threads one caller a film.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/video/clip_shape.h"
#include "engine/video/picture.h"
#include "ingest/libav.h"
#include "ingest/video_wire.h"

namespace haarmony::ingest {

class LibavFilm {
  public:
    // False: nobody takes them any more.
    using Output = std::function<bool(std::span<const std::uint8_t>)>;

    LibavFilm() = default;
    ~LibavFilm();
    LibavFilm(const LibavFilm&) = delete;
    LibavFilm& operator=(const LibavFilm&) = delete;

    // Requires: request.task is kWriteMp4 or kWriteWebm; called once, before the rest.
    [[nodiscard]] Result<void> open(const VideoRequest& request, Output output);
    // Requires: a picture of the format's size.
    [[nodiscard]] Result<void> add(video::Picture& picture);
    [[nodiscard]] Result<void> finish();

  private:
    static int write(void* self, std::uint8_t* bytes, int count);
    [[nodiscard]] bool webm() const { return request_.task == VideoTask::kWriteWebm; }
    [[nodiscard]] Error failed(int code) const;
    [[nodiscard]] Result<void> open_container();
    [[nodiscard]] Result<void> open_encoder();
    [[nodiscard]] Result<void> open_scaler();
    // The picture into rows_; the distance of two rows.
    int pad(const video::Picture& picture);
    [[nodiscard]] Result<void> encode(const AVFrame* frame);

    VideoRequest request_;
    Output output_;
    AVFormatContext* container_ = nullptr;
    AVStream* stream_ = nullptr;
    Libav<AVIOContext> io_;
    Libav<AVCodecContext> encoder_;
    Libav<SwsContext> scaler_;
    Libav<AVFrame> frame_;
    Libav<AVPacket> packet_;
    std::vector<std::uint8_t> rows_;  // the picture with even sides, where need be
    std::int64_t frames_ = 0;
};

}  // namespace haarmony::ingest
