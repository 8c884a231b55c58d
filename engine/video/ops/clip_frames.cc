#include "engine/video/ops/clip_frames.h"

#include <algorithm>
#include <string>
#include <utility>

#include "engine/video/ops/leaf_tree.h"

namespace haarmony::video {
namespace {

class RangeFrames final : public FrameSource {
  public:
    RangeFrames(const TimeTree& clip, const FrameRange& range)
        : clip_(clip), range_(range) {}

    const FrameFormat& format() const override { return clip_.shape().format(); }

    Result<bool> next(SourceFrame& frame) override {
        if (range_.count() == 0) return false;
        const ClipShape& shape = clip_.shape();
        const Result<Frame> found =
            clip_.frame({shape.time_levels(), range_.first}, shape.space_levels());
        if (!found) return found.error();
        leaf_tree(*found, frame.tree);
        const std::int64_t end =
            std::min(range_.end, shape.frames_of((*found).stored()).end);
        frame.repeats = end - range_.first;
        range_.first = end;
        return true;
    }

  private:
    const TimeTree& clip_;
    FrameRange range_;  // still to come
};

}  // namespace

Result<std::unique_ptr<FrameSource>> range_frames(const TimeTree& clip,
                                                  const FrameRange& range) {
    if (range.first < 0 || range.first >= range.end ||
        range.end > clip.shape().frames()) {
        return Error{ErrorCode::kInvalidArgument,
                     "frames are " + std::to_string(range.first) + " to " +
                         std::to_string(range.end) + "; the clip has 0 to " +
                         std::to_string(clip.shape().frames()),
                     "frames"};
    }
    return std::unique_ptr<FrameSource>(std::make_unique<RangeFrames>(clip, range));
}

}  // namespace haarmony::video
