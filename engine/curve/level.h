// Levels of a curve, and how many control points and details each has.
//   [level.h] -> bspline_filters.h, multires_curve.h, bspline.h
//
// Shape   level j has 2^j segments over u in [0, 1]. An open curve interpolates its ends and
//         has 2^j + 3 control points; a closed one is periodic and has 2^j. D^j has 2^j rows.
// Errors  none.
// Threads const-thread-safe.
// Source  sec. 3.2.2.
#pragma once

#include <cstddef>
#include <optional>

namespace haarmony::curve {

enum class Ends {
    kOpen,    // endpoint-interpolating
    kClosed,  // periodic
};

inline constexpr int kMostLevel = 20;

[[nodiscard]] constexpr std::size_t segment_count(int level) {
    return std::size_t{1} << level;
}
[[nodiscard]] constexpr std::size_t control_count(int level, Ends ends) {
    return segment_count(level) + (ends == Ends::kOpen ? 3 : 0);
}
// The level of a curve of so many control points, if there is one up to kMostLevel.
[[nodiscard]] std::optional<int> level_of(std::size_t controls, Ends ends);

}  // namespace haarmony::curve
