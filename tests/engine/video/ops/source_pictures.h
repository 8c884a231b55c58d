// What a source of frames gives, as pictures; and sources that fail when they are told
// to.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/video/frame_source.h"
#include "engine/video/ops/clip_frames.h"
#include "engine/video/picture.h"
#include "engine/video/time_tree.h"

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

// A clip whose layers cannot be read from the n-th on.
class FailingClip final : public TimeTree {
  public:
    FailingClip(const TimeTree& clip, int reads)
        : TimeTree(clip.shape(), 0), clip_(clip), reads_(reads) {}
    [[nodiscard]] bool stored(const SiblingAddress& address) const override {
        return clip_.stored(address);
    }
    [[nodiscard]] Result<Frame::Nodes> nodes(
        const SiblingAddress& address) const override {
        return clip_.nodes(address);
    }
    [[nodiscard]] Result<Frame::LayerPtr> layer(const SiblingAddress& address,
                                                int level) const override {
        if (reads_-- <= 0) return Error{ErrorCode::kIo, "the disk is gone"};
        return clip_.layer(address, level);
    }

  private:
    const TimeTree& clip_;
    mutable int reads_;
};

}  // namespace haarmony::video::testing
