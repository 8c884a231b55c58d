#include "engine/video/scrub.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace haarmony::video {

void Scrub::move(double position, double now_s) {
    assert(!std::isnan(position));
    const auto last = static_cast<double>(shape_.frames() - 1);
    const auto frame =
        static_cast<std::int64_t>(std::floor(std::clamp(position, 0.0, last)));
    if (!held_ || frame != hand_) moved_s_ = now_s;
    hand_ = frame;
    lowest_ = held_ ? std::min(lowest_, frame) : frame;
    highest_ = held_ ? std::max(highest_, frame) : frame;
    held_ = true;
}

bool Scrub::behind() const {
    return held_ && (!last_ || lowest_ < shown_.first || highest_ >= shown_.end);
}

std::optional<NodeAddress> Scrub::next(double now_s) {
    if (!held_) return std::nullopt;
    const NodeAddress pointed_at{shape_.time_levels(), hand_};
    if (!last_) {
        // The hand may have come from elsewhere: the way begins with the end that it is
        // farther from, so that it ends where the hand is.
        const bool from_below = hand_ - lowest_ >= highest_ - hand_;
        return show({shape_.time_levels(), from_below ? lowest_ : highest_});
    }
    const bool up = highest_ >= shown_.end;
    const bool down = lowest_ < shown_.first;
    if (up && (!down || highest_ - hand_ > hand_ - lowest_)) {
        const auto limit = static_cast<double>(highest_ + 1);
        return show(furthest_node(shape_, shown_.end, Direction::kForwards, limit));
    }
    if (down) {
        const auto limit = static_cast<double>(lowest_);
        return show(furthest_node(shape_, shown_.first, Direction::kBackwards, limit));
    }
    if (*last_ == pointed_at || now_s - moved_s_ < rest_s_) return std::nullopt;
    return show(pointed_at);
}

NodeAddress Scrub::show(const NodeAddress& node) {
    const FrameRange frames = shape_.frames_of(node);
    const FrameRange before = last_ ? shown_ : frames;
    // What lies within either is shown; the way to the hand from there may be new.
    if (lowest_ >= std::min(before.first, frames.first)) lowest_ = hand_;
    if (highest_ < std::max(before.end, frames.end)) highest_ = hand_;
    last_ = node;
    shown_ = frames;
    return node;
}

}  // namespace haarmony::video
