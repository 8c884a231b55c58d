#include "engine/curve/direct_edit.h"

#include <cassert>
#include <cmath>
#include <string>
#include <vector>

#include "engine/curve/bspline.h"

namespace haarmony::curve {
namespace {

// Turning details answer a pull almost linearly: a step leaves a tenth or so of the way. What
// is left when that is a hundredth of a pixel of a large page, or no longer shrinks, is moved
// without turning, which is exact.
constexpr int kMostPulls = 30;
constexpr double kNear = 1e-5;  // of the largest coordinate

// The pseudo-inverse of the row Phi^level(u) as a change for each unit of delta.
Points pseudo_inverse(int level, Ends ends, double u) {
    Points column(control_count(level, ends), 1);
    const BasisAt basis = basis_at(level, ends, u);
    // On a coarse closed curve several of the four are of the same control point.
    for (std::size_t i = 0; i < basis.value.size(); ++i) {
        column[(basis.first + i) % column.size()][0] += basis.value[i];
    }
    double square = 0;
    for (const double value : column.numbers()) square += value * value;
    for (double& value : column.numbers()) value /= square;
    return column;
}

Points times(const Points& column, std::span<const double> delta) {
    if (column.empty()) return {};
    Points points(column.size(), int(delta.size()));
    for (std::size_t row = 0; row < points.size(); ++row) {
        for (std::size_t d = 0; d < delta.size(); ++d) {
            points[row][d] = column[row][0] * delta[d];
        }
    }
    return points;
}

SweepChange unit_change(RealLevel level, Ends ends, double u) {
    const Points broad = pseudo_inverse(level.floor, ends, u);
    if (level.fraction == 0) return sweep_change(level, ends, broad, {});
    return sweep_change(level, ends, broad, pseudo_inverse(level.ceil(), ends, u));
}

SweepChange scaled(const SweepChange& unit, std::span<const double> delta) {
    return {unit.level, times(unit.control, delta), times(unit.detail, delta)};
}

double response(const SweepChange& unit, Ends ends, double u) {
    return point_at(refined(unit, ends), ends, u)[0];
}

using Delta = std::vector<double>;

Delta minus(Delta a, std::span<const double> b) {
    for (std::size_t d = 0; d < a.size(); ++d) a[d] -= b[d];
    return a;
}

double length_of(std::span<const double> delta) {
    double square = 0;
    for (const double number : delta) square += number * number;
    return std::sqrt(square);
}

// Whatever the details do, f^n(u) arrives: pulls until it does, and then moves the rest in
// the page's axes, where the answer is linear.
Edited pull_full(const MultiresCurve& curve, const PointEdit& edit, const Delta& start) {
    const RealLevel level(edit.level);
    const SweepChange unit = unit_change(level, curve.ends, edit.u);
    const double answer = response(unit, curve.ends, edit.u);
    assert(answer > 0);
    const auto pulled = [&](const Delta& pull) {
        Edited edited = apply(curve, scaled(unit, pull), edit.frame);
        edited.moved = minus(point_at(edited.control, curve.ends, edit.u), start);
        return edited;
    };
    Delta pull(edit.delta.begin(), edit.delta.end());
    for (double& number : pull) number /= answer;
    Edited best = pulled(pull);
    if (edit.frame == Frame::kFixed) return best;

    Delta rest = minus({edit.delta.begin(), edit.delta.end()}, best.moved);
    for (int step = 0; step < kMostPulls; ++step) {
        if (length_of(rest) <= kNear * coordinate_size(best.control)) break;
        for (std::size_t d = 0; d < pull.size(); ++d) pull[d] += rest[d] / answer;
        Edited next = pulled(pull);
        Delta left = minus({edit.delta.begin(), edit.delta.end()}, next.moved);
        if (!(length_of(left) < length_of(rest))) break;
        best = std::move(next);
        rest = std::move(left);
    }
    for (double& number : rest) number /= answer;
    const Points last = refined(scaled(unit, rest), curve.ends, curve.level());
    for (std::size_t i = 0; i < last.numbers().size(); ++i) {
        best.control.numbers()[i] += last.numbers()[i];
    }
    best.moved = minus(point_at(best.control, curve.ends, edit.u), start);
    best.affected =
        affected_by_edit(reconstruct(curve), best.control, curve.ends, level.ceil());
    return best;
}

}  // namespace

SweepChange point_change(RealLevel level,
                         Ends ends,
                         double u,
                         std::span<const double> delta) {
    return scaled(unit_change(level, ends, u), delta);
}

double overshoot(RealLevel level, Ends ends, double u) {
    return response(unit_change(level, ends, u), ends, u);
}

Result<Edited> drag_point(const MultiresCurve& curve, const PointEdit& edit) {
    if (auto checked = check_edit(curve, edit.level, edit.delta); !checked) {
        return std::move(checked).error();
    }
    if (!(edit.u >= 0 && edit.u <= 1)) {
        return Error{ErrorCode::kInvalidArgument,
                     "u " + std::to_string(edit.u) + " is outside 0..1",
                     "u"};
    }
    const Delta start = point_at(reconstruct(curve), curve.ends, edit.u);
    if (edit.drag == Drag::kFull) {
        return checked_edit(pull_full(curve, edit, start), edit.delta);
    }
    const SweepChange change =
        point_change(RealLevel(edit.level), curve.ends, edit.u, edit.delta);
    Edited edited = apply(curve, change, edit.frame);
    edited.moved = minus(point_at(edited.control, curve.ends, edit.u), start);
    return checked_edit(std::move(edited), edit.delta);
}

}  // namespace haarmony::curve
