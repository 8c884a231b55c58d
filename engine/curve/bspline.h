// A curve as a function of u: points, derivatives, lengths, and what is nearest to a point.
//   level.h -> [bspline.h] -> bezier.h, direct_edit.h, frame.h, portion.h
//
// Shape    control points of one level, cubic B-splines, uniform but for the ends of an open
//          curve; u in [0, 1], which a closed curve takes modulo 1.
// Errors   none; a wrong shape is a caller's bug and asserts.
// Threads  const-thread-safe.
// Source   sec. 3.2.2 (endpoint-interpolating uniform cubic B-splines); FvDFH, sec. 11.2.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "engine/curve/level.h"
#include "engine/curve/points.h"

namespace haarmony::curve {

// The four basis functions that are not 0 at u, and their derivatives by u.
struct BasisAt {
    std::size_t first = 0;  // control point of the first; of a closed curve modulo
    std::array<double, 4> value{};  // their sum is 1
    std::array<double, 4> slope{};
    std::array<double, 4> bend{};  // second derivative
};
// Requires: 0 <= u <= 1.
[[nodiscard]] BasisAt basis_at(int level, Ends ends, double u);

// One point, dimension() numbers. Requires: 0 <= u <= 1.
[[nodiscard]] std::vector<double> point_at(const Points& control, Ends ends, double u);
// Its derivative by u, and the second one.
[[nodiscard]] std::vector<double> slope_at(const Points& control, Ends ends, double u);
[[nodiscard]] std::vector<double> bend_at(const Points& control, Ends ends, double u);

// Where the basis function of a control point is largest: u in [0, 1].
[[nodiscard]] double peak_of_basis(int level, Ends ends, std::size_t index);

// Length of the curve in x and y between two parameters, to a relative 1e-6.
// Requires: 0 <= from <= to <= 1.
[[nodiscard]] double length(const Points& control, Ends ends, double from, double to);

// The parameter of the point of the curve that is nearest to (x, y); the smallest of equals.
[[nodiscard]] double nearest(const Points& control, Ends ends, double x, double y);

// The control points of the Bezier segments, 3 * 2^j + 1 rows; neighbours share their ends.
[[nodiscard]] Points bezier_points(const Points& control, Ends ends);

}  // namespace haarmony::curve
