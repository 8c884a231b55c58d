// Cubics in the plane: what approximation and its errors are computed with.
//   [plane_cubic.h] -> chain.h, cubic_fit.h, run_bound.h, parametric_error.h, hausdorff.h
//
// Shape    x and y alone; a curve of one dimension lies on y = 0.
// Errors   none; t is in [0, 1].
// Threads  const-thread-safe.
// Source   FvDFH, sec. 11.2; Farin, sec. 4.3 [Bernstein form, de Casteljau].
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "engine/curve/points.h"

namespace haarmony::curve {

struct PlaneVector {
    double x = 0;
    double y = 0;

    friend PlaneVector operator+(PlaneVector a, PlaneVector b) {
        return {a.x + b.x, a.y + b.y};
    }
    friend PlaneVector operator-(PlaneVector a, PlaneVector b) {
        return {a.x - b.x, a.y - b.y};
    }
    friend PlaneVector operator*(double scale, PlaneVector a) {
        return {scale * a.x, scale * a.y};
    }
    friend bool operator==(PlaneVector, PlaneVector) = default;
};
[[nodiscard]] inline double dot(PlaneVector a, PlaneVector b) {
    return a.x * b.x + a.y * b.y;
}
[[nodiscard]] inline double squared(PlaneVector a) { return dot(a, a); }
[[nodiscard]] inline double norm(PlaneVector a) { return std::sqrt(squared(a)); }
// Of length 1, or zero as it is.
[[nodiscard]] inline PlaneVector unit(PlaneVector a) {
    const double length = norm(a);
    return length > 0 ? (1 / length) * a : a;
}
[[nodiscard]] inline PlaneVector between(PlaneVector a, PlaneVector b, double t) {
    return a + t * (b - a);
}

// x and y of a row.
[[nodiscard]] inline PlaneVector in_plane(std::span<const double> row) {
    return {row[0], row.size() > 1 ? row[1] : 0};
}

// In Bernstein form.
using PlaneCubic = std::array<PlaneVector, 4>;

// Four rows from `first` on.
[[nodiscard]] inline PlaneCubic cubic_at(const Points& rows, std::size_t first) {
    return {in_plane(rows[first]),
            in_plane(rows[first + 1]),
            in_plane(rows[first + 2]),
            in_plane(rows[first + 3])};
}
// Of rows of four each.
[[nodiscard]] std::vector<PlaneCubic> cubics_of(const Points& bezier);

// The parts before and after t.
[[nodiscard]] std::pair<PlaneCubic, PlaneCubic> split(const PlaneCubic& cubic, double t);

// In powers of t: quicker to evaluate.
struct PlanePolynomial {
    explicit PlanePolynomial(const PlaneCubic& p)
        : c0(p[0]),
          c1(3 * (p[1] - p[0])),
          c2(3 * ((p[2] - p[1]) - (p[1] - p[0]))),
          c3((p[3] - p[0]) - 3 * (p[2] - p[1])) {}

    [[nodiscard]] PlaneVector value(double t) const {
        return c0 + t * (c1 + t * (c2 + t * c3));
    }
    [[nodiscard]] PlaneVector slope(double t) const {
        return c1 + t * (2 * c2 + (3 * t) * c3);
    }
    [[nodiscard]] PlaneVector bend(double t) const { return 2 * c2 + (6 * t) * c3; }

    // Newton's step from t towards the nearest point to q.
    [[nodiscard]] double nearer(PlaneVector q, double t) const {
        const PlaneVector off = value(t) - q;
        const PlaneVector along = slope(t);
        const double speed2 = squared(along);
        double curvature = speed2 + dot(off, bend(t));
        // Where the distance is not convex the Gauss-Newton step still goes downhill.
        if (curvature < 0.3 * speed2) curvature = speed2;
        return curvature > 0 ? t - dot(off, along) / curvature : t;
    }
    // `steps` of them, within [from, to].
    [[nodiscard]] double nearest(PlaneVector q,
                                 double t,
                                 double from,
                                 double to,
                                 int steps) const {
        for (int i = 0; i < steps; ++i) t = std::clamp(nearer(q, t), from, to);
        return t;
    }

    PlaneVector c0, c1, c2, c3;
};

// Unit tangents at the ends, also where control points coincide; zero if all do.
[[nodiscard]] PlaneVector tangent_at_start(const PlaneCubic& cubic);
[[nodiscard]] PlaneVector tangent_at_end(const PlaneCubic& cubic);

}  // namespace haarmony::curve
