#include "engine/video/ops/retime.h"

#include <algorithm>
#include <bit>
#include <string>

#include "engine/video/ops/leaf_tree.h"

namespace haarmony::video {
namespace {

constexpr std::int64_t kMostTerms = 65'536;

std::int64_t ceil_of(std::int64_t numerator, std::int64_t denominator) {
    return (numerator + denominator - 1) / denominator;
}

class Retimed final : public FrameSource {
  public:
    Retimed(const TimeTree& clip, const Speed& speed, std::int64_t frames)
        : clip_(clip), speed_(speed), frames_(frames) {
        const auto whole =
            static_cast<std::uint64_t>(speed.numerator / speed.denominator);
        const int halvings = whole == 0 ? 0 : static_cast<int>(std::bit_width(whole)) - 1;
        time_level_ = std::max(0, clip.shape().time_levels() - halvings);
    }

    const FrameFormat& format() const override { return clip_.shape().format(); }

    Result<bool> next(SourceFrame& frame) override {
        if (next_ == frames_) return false;
        const ClipShape& shape = clip_.shape();
        const std::int64_t at = next_ * speed_.numerator / speed_.denominator;
        const std::int64_t index = at >> (shape.time_levels() - time_level_);
        const Result<Frame> found =
            clip_.frame({time_level_, index}, shape.space_levels());
        if (!found) return found.error();
        leaf_tree(*found, frame.tree);
        // The same is shown as long as floor(j speed) stays before the end of what is
        // stored.
        const std::int64_t end =
            std::min(frames_,
                     ceil_of(shape.frames_of((*found).stored()).end * speed_.denominator,
                             speed_.numerator));
        frame.repeats = end - next_;
        next_ = end;
        return true;
    }

  private:
    const TimeTree& clip_;
    Speed speed_;
    std::int64_t frames_;
    int time_level_ = 0;
    std::int64_t next_ = 0;
};

}  // namespace

Result<std::unique_ptr<FrameSource>> retime(const TimeTree& clip, const Speed& speed) {
    const auto within = [](std::int64_t term) { return term >= 1 && term <= kMostTerms; };
    const std::string named = "speed is " + std::to_string(speed.numerator) + "/" +
                              std::to_string(speed.denominator);
    if (!within(speed.numerator) || !within(speed.denominator)) {
        return Error{ErrorCode::kInvalidArgument,
                     named + "; want terms from 1 to " + std::to_string(kMostTerms),
                     "speed"};
    }
    const std::int64_t frames =
        ceil_of(clip.shape().frames() * speed.denominator, speed.numerator);
    if (const Result<ClipShape> shape = ClipShape::make(clip.shape().format(), frames);
        !shape) {
        return Error{ErrorCode::kInvalidArgument,
                     named + ", which makes too long a clip: " + shape.error().message,
                     "speed"};
    }
    return std::unique_ptr<FrameSource>(std::make_unique<Retimed>(clip, speed, frames));
}

}  // namespace haarmony::video
