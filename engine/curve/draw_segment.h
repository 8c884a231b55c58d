// Which segments of which levels stand for the whole curve, within a tolerance.
//   error_bounds.h -> [draw_segment.h] -> approximate.h
//
// draw_segments() is Figure 3.12. Its segments need not meet. Averaging the ends that do not,
// as sec. 3.5 suggests, can exceed the tolerance; draw_joined_segments() counts the move of
// an end as an error, and splits a segment that it takes beyond the tolerance.
//
// Where the curve may turn, at knots of the finest level, no segment goes across, and joined
// ones end on the curve itself instead of halfway to each other.
//
// Shape    segments in the order of u; four rows of `bezier` for each.
// Errors   none; a wrong shape is a caller's bug and asserts.
// Threads  const-thread-safe.
// Source   sec. 3.5, DrawSegment of Figure 3.12, and the end of the section.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/curve/error_bounds.h"
#include "engine/curve/level.h"
#include "engine/curve/points.h"

namespace haarmony::curve {

// s_index^level.
struct SegmentName {
    int level = 0;
    std::size_t index = 0;

    friend bool operator==(SegmentName, SegmentName) = default;
};

struct DrawnSegments {
    std::vector<SegmentName> names;
    Points bezier;
    double bound = 0;  // on the distance at equal u; < tolerance
};

// `turns`: knots of the finest level, 0 to 2^n, ascending.
// Requires: tolerance > 0; the levels of error_bounds().
[[nodiscard]] DrawnSegments draw_segments(std::span<const SegmentLevel> levels,
                                          double tolerance,
                                          std::span<const std::size_t> turns);
// The end of each segment is the start of the next, of a closed curve all around.
[[nodiscard]] DrawnSegments draw_joined_segments(std::span<const SegmentLevel> levels,
                                                 Ends ends,
                                                 double tolerance,
                                                 std::span<const std::size_t> turns);

}  // namespace haarmony::curve
