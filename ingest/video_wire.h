// What haarmony-video, the child that runs libav, and its parent say to each other.
//
//   to read a clip    parent: VideoRequest with the clip's file
//                     child:  kOpened, then kPicture with pixels for each, then kDone
//   to write a film   parent: VideoRequest without a file
//                     child:  any number of kBytes, then kDone
//                     parent: FilmMessage, with pixels if it is kAdd; child as above; ...
//                     kFinish is the last
//   at any time       child:  kFailed with a message, the last
//
// Structures travel as socket_wire.h says. The parent believes nothing in a reply before
// check_reply() has agreed.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/core/result.h"
#include "engine/video/clip_shape.h"
#include "engine/video/pixel.h"
#include "ingest/video_format.h"

namespace haarmony::ingest {

inline constexpr std::uint32_t kVideoMagic = 0x48563031;  // "HV01"
inline constexpr std::uint64_t kMaxVideoMessage = 1024;   // bytes of a kFailed
inline constexpr std::uint64_t kMaxFilmPart = std::uint64_t{1} << 20;  // of a kBytes

enum class VideoFrames : std::uint32_t {
    kAll,
    kKey,  // those that need no other frame: about one a shot, and much quicker
};

enum class VideoTask : std::uint32_t { kRead, kWriteMp4, kWriteWebm };

struct VideoRequest {
    std::uint32_t magic = kVideoMagic;
    VideoTask task = VideoTask::kRead;
    VideoFormat source = VideoFormat::kMp4;   // kRead
    VideoFrames frames = VideoFrames::kAll;   // kRead
    std::int64_t max_pixels = 0;              // kRead
    std::int64_t cpu_seconds = 0;             // kRead
    video::FrameFormat format;                // kWrite...
    video::Rgba background = {0, 0, 0, 255};  // kWriteMp4
};

enum class FilmStep : std::uint32_t { kAdd, kFinish };

struct FilmMessage {
    std::uint32_t magic = kVideoMagic;
    FilmStep step = FilmStep::kAdd;
};

enum class VideoReplyKind : std::uint32_t { kOpened, kPicture, kBytes, kDone, kFailed };

struct VideoReply {
    std::uint32_t magic = kVideoMagic;
    VideoReplyKind kind = VideoReplyKind::kFailed;
    video::FrameFormat format;                  // kOpened
    ErrorCode error = ErrorCode::kUndecodable;  // kFailed
    std::uint32_t padding = 0;
    std::int64_t time_us = 0;  // kPicture
    std::uint64_t length = 0;  // bytes that follow
};

[[nodiscard]] std::uint64_t picture_bytes(const video::FrameFormat& format);

// Whether a reply is one that an honest child could send while it reads a clip, respectively
// writes a film. `format` is that of the kOpened before, {} before it.
[[nodiscard]] bool check_read_reply(const VideoReply& reply,
                                    const video::FrameFormat& format,
                                    std::int64_t max_pixels);
[[nodiscard]] bool check_film_reply(const VideoReply& reply);

}  // namespace haarmony::ingest
