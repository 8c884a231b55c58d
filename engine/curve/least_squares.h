// The curve of one level that is nearest to points at given parameters, in linear time.
//   bspline.h -> [least_squares.h] -> fit.h
//
// Minimises the squared distances, and, so slightly that it decides only what they leave
// open, the squared differences of neighbouring control points by their distance in u: where
// a basis function sees no point, control points lie on a straight line between those that
// do. Iterated, so that what the points do decide is not biased.
//
// Units   a point weighs 1 (or its weight), a unit of squared slope kStiffness.
// Errors  none; a wrong shape is a caller's bug and asserts.
// Threads const-thread-safe.
// Cost    per point the 4 basis functions; 10 dimension() operations per control point.
// Source  normal equations of a B-spline basis (de Boor, ch. XIV); iterated Tikhonov
//         regularisation.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/curve/level.h"
#include "engine/curve/points.h"

namespace haarmony::curve {

class LeastSquares {
  public:
    static constexpr double kStiffness = 1e-6;

    LeastSquares(int level, Ends ends, int dimension);

    // A point that counts as `weight` ones. Many at one u are better added as their mean than
    // one by one, whose roundings add up to more than the stiffness.
    // Requires: 0 <= u <= 1, as many numbers as dimensions, of size 1 at most or so.
    void add(double u, std::span<const double> point, double weight);

    // The control points; the first and last of an open curve are `first` and `last` where
    // those are not empty. Requires: at least one point was added.
    [[nodiscard]] Points solve(std::span<const double> first,
                               std::span<const double> last) const;

  private:
    // A symmetric matrix with 3 entries beside its diagonal, of a closed curve with a border
    // of up to 3 last rows that reach all columns, in which the band's wrapped corners lie.
    struct Matrix {
        std::vector<std::array<double, 4>> band;  // row i: columns i, i - 1, i - 2, i - 3
        std::vector<std::array<double, 3>> border;  // row i: columns of the border
        std::array<std::array<double, 3>, 3> corner{};
        std::size_t border_rows = 0;

        void add(std::size_t row, std::size_t column, double value);
        void fix(std::size_t row, Points& right);
        void factor();
        void solve(Points& right) const;
    };

    // Between the control points i and i + 1: the inverse of their distance in u, in segments.
    [[nodiscard]] double edge(std::size_t i) const;
    [[nodiscard]] Points times_edges(const Points& control, double stiffness) const;

    int level_;
    Ends ends_;
    std::size_t count_;
    Matrix matrix_;
    Points right_;
};

}  // namespace haarmony::curve
