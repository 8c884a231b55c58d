#include "engine/video/clip_shape.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <string>

namespace haarmony::video {
namespace {

int ceil_log2(std::uint64_t value) { return static_cast<int>(std::bit_width(value - 1)); }

Error outside(const char* name, const std::string& value, const std::string& want) {
    return {ErrorCode::kInvalidArgument,
            std::string(name) + " is " + value + "; want " + want,
            name};
}

}  // namespace

Result<ClipShape> ClipShape::make(const FrameFormat& format, std::int64_t frames) {
    const std::string side = "1 to " + std::to_string(kMaxSide);
    if (format.width < 1 || format.width > kMaxSide) {
        return outside("width", std::to_string(format.width), side);
    }
    if (format.height < 1 || format.height > kMaxSide) {
        return outside("height", std::to_string(format.height), side);
    }
    if (format.rate.numerator < 1 || format.rate.denominator < 1) {
        return outside("rate",
                       std::to_string(format.rate.numerator) + "/" +
                           std::to_string(format.rate.denominator),
                       "a positive fraction");
    }
    const int space =
        ceil_log2(static_cast<std::uint64_t>(std::max(format.width, format.height)));
    const int most = std::min(kMaxTimeLevels, kMaxSampleBits - 2 * space);
    if (frames < 1 || frames > std::int64_t{1} << most) {
        return outside("frames",
                       std::to_string(frames),
                       "1 to " + std::to_string(std::int64_t{1} << most));
    }
    return ClipShape(format, frames);
}

ClipShape::ClipShape(const FrameFormat& format, std::int64_t frames)
    : format_(format),
      frames_(frames),
      time_levels_(ceil_log2(static_cast<std::uint64_t>(frames))),
      space_levels_(
          ceil_log2(static_cast<std::uint64_t>(std::max(format.width, format.height)))) {}

std::int64_t ClipShape::nodes_at(int time_level) const {
    assert(time_level >= 0 && time_level <= time_levels_);
    const int below = time_levels_ - time_level;
    return (frames_ + (std::int64_t{1} << below) - 1) >> below;
}

std::int64_t ClipShape::time_nodes() const {
    std::int64_t nodes = 0;
    for (int level = 0; level <= time_levels_; ++level) nodes += nodes_at(level);
    return nodes;
}

bool ClipShape::contains(const NodeAddress& at) const {
    return at.time_level >= 0 && at.time_level <= time_levels_ && at.index >= 0 &&
           at.index < nodes_at(at.time_level);
}

FrameRange ClipShape::frames_of(const NodeAddress& at) const {
    assert(contains(at));
    const int below = time_levels_ - at.time_level;
    return {at.index << below, std::min((at.index + 1) << below, frames_)};
}

std::int32_t ClipShape::width_at(int space_level) const {
    assert(space_level >= 0 && space_level <= space_levels_);
    const int below = space_levels_ - space_level;
    return static_cast<std::int32_t>(
        (std::int64_t{width()} + (std::int64_t{1} << below) - 1) >> below);
}

std::int32_t ClipShape::height_at(int space_level) const {
    assert(space_level >= 0 && space_level <= space_levels_);
    const int below = space_levels_ - space_level;
    return static_cast<std::int32_t>(
        (std::int64_t{height()} + (std::int64_t{1} << below) - 1) >> below);
}

}  // namespace haarmony::video
