#include "engine/video/playback.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "engine/video/mix.h"

namespace haarmony::video {

Playback::Playback(const ClipShape& shape, const PlaybackOptions& options, double now_s)
    : shape_(shape),
      smooth_in_time_(options.smooth_in_time),
      speed_(options.speed),
      anchor_position_(options.position),
      anchor_s_(now_s),
      front_(static_cast<std::int64_t>(options.speed < 0
                                           ? std::ceil(options.position)
                                           : std::floor(options.position))) {
    assert(std::isfinite(options.speed));
    assert(options.position >= 0 &&
           options.position <= static_cast<double>(shape.frames()));
}

double Playback::position(double now_s) const {
    assert(now_s >= anchor_s_);
    const double moved = speed_ * shape_.rate().per_second() * (now_s - anchor_s_);
    return std::clamp(
        anchor_position_ + moved, 0.0, static_cast<double>(shape_.frames()));
}

void Playback::set_speed(double speed, double now_s) {
    assert(std::isfinite(speed));
    const double position = this->position(now_s);
    const Direction before = direction();
    anchor_position_ = position;
    anchor_s_ = now_s;
    speed_ = speed;
    // What a blurred step showed ahead of time is shown again at the new pace; what it has
    // not shown yet is still to come, unless the clip turns round.
    const bool turns = direction() != before;
    if (direction() == Direction::kForwards) {
        const auto here = static_cast<std::int64_t>(std::floor(position));
        front_ = turns ? here : std::min(front_, here);
    } else {
        const auto here = static_cast<std::int64_t>(std::ceil(position));
        front_ = turns ? here : std::max(front_, here);
    }
}

std::optional<TimeStep> Playback::next(double now_s, double period_s) {
    assert(period_s > 0);
    const double move = speed_ * shape_.rate().per_second() * period_s;
    const double position = this->position(now_s);
    return std::abs(move) < 1 ? single(position, move) : blurred(position, move);
}

std::optional<TimeStep> Playback::blurred(double position, double move) {
    if (at_end(shape_, front_, direction())) return std::nullopt;
    const double target =
        std::clamp(position + move, 0.0, static_cast<double>(shape_.frames()));
    const double ahead = target - static_cast<double>(front_);
    // Already there, but for less than half a frame.
    if (last_ && (move < 0 ? -ahead : ahead) < 0.5) return show(*last_);
    TimeStep step;
    step.at = steady_node(shape_, front_, direction(), target, std::abs(move));
    front_ = front_of(shape_.frames_of(step.at), direction());
    return show(step);
}

std::optional<TimeStep> Playback::single(double position, double move) {
    const bool backwards = direction() == Direction::kBackwards;
    const auto frames = static_cast<double>(shape_.frames());
    if (move != 0 && position == (backwards ? 0 : frames) &&
        at_end(shape_, front_, direction())) {
        return std::nullopt;
    }
    const double middle = std::clamp(position + move / 2, 0.0, frames);
    const std::int64_t frame =
        std::min(static_cast<std::int64_t>(middle), shape_.frames() - 1);
    const std::int64_t end = backwards ? frame : frame + 1;
    TimeStep step;
    if (backwards ? frame < front_ - 1 : frame > front_) {  // frames were missed
        step.at = furthest_node(shape_, front_, direction(), static_cast<double>(end));
        front_ = front_of(shape_.frames_of(step.at), direction());
    } else {
        step.at = {shape_.time_levels(), frame};
        if (smooth_in_time_) step = between_frames(middle);
        front_ = end;
    }
    return show(step);
}

TimeStep Playback::between_frames(double position) const {
    // A frame shows its own instant in its middle; before the first and after the last there
    // is nothing to be mixed with.
    const auto last = static_cast<double>(shape_.frames() - 1);
    const double place = std::clamp(position - 0.5, 0.0, last);
    const double before = std::floor(place);
    constexpr std::uint32_t kOne = 1U << kTimeBits;
    TimeStep step;
    step.at = {shape_.time_levels(), static_cast<std::int64_t>(before)};
    step.weight = kOne - static_cast<std::uint32_t>(std::lround((place - before) * kOne));
    if (step.weight < kOne) step.next = {step.at.time_level, step.at.index + 1};
    return step;
}

TimeStep Playback::show(TimeStep step) {
    step.repeated = last_ && step.at == last_->at && step.next == last_->next &&
                    step.weight == last_->weight;
    last_ = step;
    return step;
}

Result<Picture> zoom_step(const TimeTree& clip,
                          const TimeStep& step,
                          std::int32_t root_side,
                          Edge edge,
                          const PixelBox& box,
                          Finer finer) {
    const int level = zoom_level(clip.shape(), root_side);
    const Result<Frame> frame = clip.frame(step.at, level);
    if (!frame) return frame.error();
    Picture picture = zoom(*frame, root_side, edge, box, finer);
    if (!step.next) return picture;
    const Result<Frame> after = clip.frame(*step.next, level);
    if (!after) return after.error();
    return mixed(
        picture, zoom(*after, root_side, edge, box, finer), step.weight, kTimeBits);
}

}  // namespace haarmony::video
