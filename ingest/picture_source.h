// Pictures of one size, one after the other, each with its time: what every reader of clips
// gives, in the child (libav_source.h, webp_animation.h) and outside of it (video_source.h).
//
// Shape   straight RGBA, clear pixels canonical.
// Threads one caller a source.
#pragma once

#include <cstdint>

#include "engine/core/result.h"
#include "engine/video/clip_shape.h"
#include "engine/video/picture.h"

namespace haarmony::ingest {

struct TimedPicture {
    video::Picture picture;
    std::int64_t time_us = 0;  // when it is first shown, as the file says
};

class PictureSource {
  public:
    virtual ~PictureSource() = default;
    [[nodiscard]] virtual const video::FrameFormat& format() const = 0;
    // The next picture into `shown` (its storage is used again), or false at the end.
    [[nodiscard]] virtual Result<bool> next(TimedPicture& shown) = 0;
};

}  // namespace haarmony::ingest
