// The slow second method behind the tests of editing: B-splines by recursion, inner products
// by quadrature, projections by elimination of full matrices. Shares no code with the engine
// but the shape of Points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "engine/curve/level.h"
#include "engine/curve/points.h"

namespace haarmony::curve::dense {

using Matrix = std::vector<std::vector<double>>;

[[nodiscard]] std::size_t points_of(int level, Ends ends);
// Basis function `index` of a level at u.
[[nodiscard]] double basis(int level, Ends ends, std::size_t index, double u);
[[nodiscard]] std::vector<double> point(const Points& control, Ends ends, double u);
// Derivative by u, from the cubic through four points of the segment.
[[nodiscard]] std::vector<double> slope(const Points& control, Ends ends, double u);

// The least squares projection on [0, 1] to a coarser level, and the same curve at a finer.
[[nodiscard]] Points project(const Points& control, Ends ends, int level);
[[nodiscard]] Points refine(const Points& control, Ends ends, int level);

// Control points of level `level` + 1 of wavelet `row` of an open curve: the only function in
// the window of minimal support that is orthogonal to the level; unit norm, peak positive.
[[nodiscard]] Points wavelet(int level, std::size_t row);
// The weights with which the columns add up to `sum`, by least squares.
[[nodiscard]] Points combination(const Points& sum, const std::vector<Points>& columns);
// Where |f| is largest, f of one dimension; the mean of two that are alike.
[[nodiscard]] double peak(const Points& control, Ends ends);

// a + weight * b.
[[nodiscard]] Points sum(const Points& a, double weight, const Points& b);
// The largest difference of two numbers; infinite where the shapes differ.
[[nodiscard]] double distance(const Points& a, const Points& b);

// A random walk with the first number about `scale` times larger than its steps.
[[nodiscard]] Points random_curve(int level,
                                  Ends ends,
                                  int dimension,
                                  std::uint32_t seed);

}  // namespace haarmony::curve::dense
