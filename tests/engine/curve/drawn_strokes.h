// Strokes as somebody with an unsteady hand draws them, the same for the same seed, and their
// distances the slow way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/curve/level.h"
#include "engine/curve/plane_cubic.h"
#include "engine/curve/points.h"

namespace haarmony::curve {

struct Stroke {
    int level = 6;
    Ends ends = Ends::kOpen;
    int dimension = 2;
    double noise = 0.3;  // standard deviation; the stroke fills some 600 x 300
    std::uint32_t seed = 1;
};
// Control points: a few waves, closed ones around a centre. Dimensions from the third on are
// waves of their own.
[[nodiscard]] Points drawn_stroke(const Stroke& stroke);

// The point at t of the four rows from `first` on, by the sum of Bernstein polynomials.
[[nodiscard]] std::vector<double> bernstein_sum(const Points& rows,
                                                std::size_t first,
                                                double t);

// The four points of a cubic as rows.
[[nodiscard]] Points rows_of(const PlaneCubic& cubic);

// Rows of four a segment, of 3k + 1 rows that neighbours share.
[[nodiscard]] Points four_rows_each(const Points& chain);

// The largest distance, in x and y, from `per_segment` + 1 points of each segment of `a` to
// the nearest of as many of `b`; rows of four a segment.
[[nodiscard]] double sampled_one_sided(const Points& a,
                                       const Points& b,
                                       std::size_t per_segment);
[[nodiscard]] double sampled_hausdorff(const Points& a,
                                       const Points& b,
                                       std::size_t per_segment);

// The largest distance of two neighbouring samples: by so much, halved, a distance to the
// nearest sample is above that to the curve.
[[nodiscard]] double widest_gap(const Points& bezier, std::size_t per_segment);

}  // namespace haarmony::curve
