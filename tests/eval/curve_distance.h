// How far curves are apart at equal u.
//   [curve_distance.h] -> figure_3_4.h ... figure_3_13.h
//
// Shape   open curves of any two levels; x and y count.
// Units   those of the curves; samples are kSamplesEach to a segment of the finer one.
// Source  sec. 3.5, the L-infinity norm; sec. 3.3, the L2 norm.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/curve/points.h"

namespace haarmony::eval {

inline constexpr std::size_t kSamplesEach = 8;

// The same curve with the control points of a finer level.
// Requires: `level` is not below its own.
[[nodiscard]] curve::Points refined_to(const curve::Points& control, int level);

// |a(u) - b(u)| at even steps of u from 0 to 1.
[[nodiscard]] std::vector<double> distances(const curve::Points& a,
                                            const curve::Points& b);

struct CurveDistance {
    double largest = 0;
    double rms = 0;
};
[[nodiscard]] CurveDistance distance_between(const curve::Points& a,
                                             const curve::Points& b);

// The largest difference of two numbers in the same place.
// Requires: the same shape.
[[nodiscard]] double largest_difference(const curve::Points& a, const curve::Points& b);

}  // namespace haarmony::eval
