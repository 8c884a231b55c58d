// Bicubic tensor-product surfaces at several levels of detail.
//   multires_curve.h, sweep_edit.h -> [surface.h]
//
// Shape   a grid of control points, u first: (2^a + 3) x (2^b + 3), endpoint-interpolating in
//         both directions. Decomposition goes by pairs: each step halves u and v once, until
//         one of them is at level 0.
// Scale   as of curves: wavelets of unit L2 norm, in each direction.
// Errors  edit_surface: a level, index or delta that the grid cannot take; `param` names the
//         field. Elsewhere a wrong shape is a caller's bug and asserts.
// Threads const-thread-safe.
// Cost    linear in the control points.
// Source  sec. 6.3, "Surfaces"; equation (3.1) and (3.3) to (3.6) in each direction.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/curve/level.h"
#include "engine/curve/points.h"

namespace haarmony::curve {

// Rows of points: (0, 0), (0, 1), ..., (0, along_v - 1), (1, 0), ...
struct Grid {
    Grid() = default;
    // All numbers are 0.
    Grid(std::size_t u, std::size_t v, int dimension)
        : along_u(u), along_v(v), points(u * v, dimension) {}

    std::size_t along_u = 0;
    std::size_t along_v = 0;
    Points points;

    [[nodiscard]] std::span<double> at(std::size_t a, std::size_t b) {
        return points[a * along_v + b];
    }
    [[nodiscard]] std::span<const double> at(std::size_t a, std::size_t b) const {
        return points[a * along_v + b];
    }
    friend bool operator==(const Grid&, const Grid&) = default;
};

// What a step leaves: `cd` are wavelets in v, `dc` in u, `dd` in both.
struct DetailGrids {
    Grid cd;
    Grid dc;
    Grid dd;
};

struct MultiresSurface {
    Grid coarse;                       // of levels (a - s, b - s), s = min(a, b)
    std::vector<DetailGrids> details;  // coarsest first, s of them
};

// Requires: as many points in each direction as a level has.
[[nodiscard]] MultiresSurface decompose(const Grid& control);

// The surface with its `steps` coarsest details. Requires: 0 <= steps <= details.size().
[[nodiscard]] Grid reconstruct(const MultiresSurface& surface, std::size_t steps);

// The surface smoothed to real levels: f^l in u of f^l in v, equation (3.1) for each; control
// points of levels ceil(level_u), ceil(level_v). Requires: 0 <= each <= that of the grid.
[[nodiscard]] Grid smooth(const Grid& control, double level_u, double level_v);

// Control point (index_u, index_v) of levels (level_u, level_v) moves by `delta`. At real
// levels the change is the product of two changes of curves, so that its breadth in each
// direction is that of a curve's; the details follow in the axes of the page.
struct SurfaceEdit {
    double level_u = 0;
    double level_v = 0;
    std::size_t index_u = 0;        // of C^ceil(level_u)
    std::size_t index_v = 0;        // of C^ceil(level_v)
    std::span<const double> delta;  // dimension() finite numbers
};
struct EditedSurface {
    Grid control;
    std::size_t changed = 0;  // control points
};
[[nodiscard]] Result<EditedSurface> edit_surface(const Grid& control,
                                                 const SurfaceEdit& edit);

// A point of the surface, dimension() numbers. Requires: 0 <= u, v <= 1.
[[nodiscard]] std::vector<double> point_at(const Grid& control, double u, double v);

}  // namespace haarmony::curve
