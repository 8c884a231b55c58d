// What a source of frames gives, as pictures; and a source that fails when it is told to.
#pragma once

#include <vector>

#include "engine/video/frame_source.h"
#include "engine/video/picture.h"

namespace haarmony::video::testing {

// Every frame, those that stay as often as they do. Fails the test if the source fails.
[[nodiscard]] std::vector<Picture> pictures_of(FrameSource& source);

// Frames of one opaque grey, each a little lighter, then an error if `fails`.
class GreyFrames final : public FrameSource {
  public:
    GreyFrames(const FrameFormat& format, int frames, bool fails)
        : format_(format), frames_(frames), fails_(fails) {}
    [[nodiscard]] const FrameFormat& format() const override { return format_; }
    [[nodiscard]] Result<bool> next(SourceFrame& frame) override;

  private:
    FrameFormat format_;
    int frames_;
    bool fails_;
    int next_ = 0;
};

}  // namespace haarmony::video::testing
