#include "engine/video/ops/placement.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

namespace haarmony::video {
namespace {

// No clip has more levels to shrink by.
constexpr int kMaxShrink = std::bit_width(static_cast<unsigned>(kMaxSide)) - 1;
constexpr std::int64_t kFarthest = std::int64_t{1} << 32;

Error refused(const char* param, const std::string& message) {
    return {ErrorCode::kInvalidArgument, message, param};
}

bool integer(double value) { return value == std::floor(value); }

}  // namespace

Result<Scale> scale_of(double x, double y) {
    for (const double value : {x, y}) {
        if (!(value > 0 && value <= kMaxSide)) {
            return refused("scale",
                           "scale is " + std::to_string(value) +
                               "; want a positive number up to " +
                               std::to_string(kMaxSide));
        }
    }
    int shrink = 0;
    for (; !integer(x) || !integer(y); x *= 2, y *= 2) {
        if (++shrink > kMaxShrink) {
            return refused("scale",
                           "scale is no integer over a power of two up to 2^" +
                               std::to_string(kMaxShrink));
        }
    }
    if (std::max(x, y) > kMaxSide) {
        return refused("scale",
                       "scale needs pixels repeated " + std::to_string(std::max(x, y)) +
                           " times; want at most " + std::to_string(kMaxSide));
    }
    return Scale{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), shrink};
}

Result<CanvasBox> placed_box(const ClipShape& clip, const Placement& placement) {
    const int finest = clip.space_levels();
    const Scale& scale = placement.scale;
    if (scale.x < 1 || scale.y < 1 || scale.x > kMaxSide || scale.y > kMaxSide) {
        return refused("scale",
                       "scale repeats pixels " + std::to_string(scale.x) + " and " +
                           std::to_string(scale.y) + " times; want 1 to " +
                           std::to_string(kMaxSide));
    }
    if (scale.shrink < 0 || scale.shrink > finest) {
        return refused("scale",
                       "scale shrinks by 2^" + std::to_string(scale.shrink) +
                           "; the clip has " + std::to_string(finest) + " levels");
    }
    const int at_level = placement.at_level.value_or(finest);
    if (at_level < 0 || at_level > finest) {
        return refused("at_level",
                       "at_level is " + std::to_string(at_level) + "; want 0 to " +
                           std::to_string(finest));
    }
    const std::int64_t unit = std::int64_t{1} << (finest - at_level);
    for (const std::int64_t shift : {placement.dx, placement.dy}) {
        if (shift < -kFarthest / unit || shift > kFarthest / unit) {
            return refused("translate",
                           "translate moves by " + std::to_string(shift) +
                               "; want at most " + std::to_string(kFarthest / unit) +
                               " either way");
        }
    }
    const int level = finest - scale.shrink;
    return CanvasBox{placement.dx * unit,
                     placement.dy * unit,
                     std::int64_t{clip.width_at(level)} * scale.x,
                     std::int64_t{clip.height_at(level)} * scale.y};
}

}  // namespace haarmony::video
