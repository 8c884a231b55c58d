// Pictures encoded by libav, in memory and without a container: how small others keep them,
// and what others' decoders are timed on.
//   video_clips.h -> [video_encoder.h] -> video_sizes.h, video_decoder.h
//
// Encodings  FFV1 level 3 and x264 at qp 0 keep RGB exactly (x264 leaves alpha out); crf 23
//            has 4:2:0 colours, or 4:4:4 where a side is odd, at x264's default preset.
// Errors     kUnavailable: this libav lacks the encoder; kInvalidArgument: what the encoder
//            refuses, with its words.
// Threads    one; const-thread-safe.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/video/picture.h"

namespace haarmony::eval {

enum class VideoEncoding : std::uint8_t {
    kFfv1,      // what archives use
    kLossless,  // x264, qp 0, RGB
    kIntra,     // x264, crf 23, every frame a key frame
    kInter,     // x264, crf 23, its default group of pictures (up to 250 frames)
};

struct FilmPacket {
    std::vector<std::uint8_t> bytes;
    std::int64_t frame = 0;  // which one it holds; packets are in the order of decoding
    bool key = false;
};

struct EncodedFilm {
    VideoEncoding encoding = VideoEncoding::kFfv1;
    std::int32_t width = 0;
    std::int32_t height = 0;
    std::vector<std::uint8_t> header;  // what a decoder must know beforehand
    std::vector<FilmPacket> packets;

    [[nodiscard]] std::uint64_t bytes() const;
};

// Requires: frames not empty, all of one size.
[[nodiscard]] Result<EncodedFilm> encode_film(std::span<const video::Picture> frames,
                                              VideoEncoding encoding);

}  // namespace haarmony::eval
