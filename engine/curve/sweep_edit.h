// Editing the sweep of a curve: one control point of a smoothed version moves, the details
// follow.
//   multires_curve.h, frame.h, affected.h -> [sweep_edit.h] -> direct_edit.h
//
// A real level l = j + t means the curve (1 - t) f^j + t f^(j+1), whose control points are
// of level ceil(l); the edit's breadth goes from that of level j to that of level j + 1.
//
// Units    u in [0, 1]; deltas in the axes of the page.
// Errors   edit_sweep: a level, index or delta that the curve does not have; `param` names
//          the field of ControlEdit.
// Threads  const-thread-safe.
// Cost     linear in the control points.
// Source   sec. 3.4.1, equations (3.3) to (3.6), g(t) = t^2; at t = 0 delta D is 0.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/curve/affected.h"
#include "engine/curve/frame.h"
#include "engine/curve/multires_curve.h"

namespace haarmony::curve {

// l = j + t with 0 <= t < 1, and the level of the control points, ceil(l).
struct RealLevel {
    explicit RealLevel(double level);

    int floor = 0;        // j
    double fraction = 0;  // t
    [[nodiscard]] int ceil() const { return floor + (fraction > 0 ? 1 : 0); }
};

// What an edit at level j + t changes before finer details are added.
struct SweepChange {
    RealLevel level;
    Points control;  // delta C^j
    Points detail;   // delta D^j in the axes of the page; empty where t = 0
};

// Equation (3.5): `broad` is the change to C^j that would do alone, `narrow` the one to
// C^(j+t). Requires: 0 <= level; at t = 0 `narrow` is not looked at.
[[nodiscard]] SweepChange sweep_change(RealLevel level,
                                       Ends ends,
                                       const Points& broad,
                                       const Points& narrow);

// P delta C^j + Q delta D^j: what the change adds to C^ceil(l) in the page's axes, and by
// equation (3.6) to the C^n of a finer level n.
[[nodiscard]] Points refined(const SweepChange& change, Ends ends);
[[nodiscard]] Points refined(const SweepChange& change, Ends ends, int level);

struct Edited {
    Points control;             // at the curve's own level
    Interval affected;          // affected_by_edit() between knots of level ceil(l)
    std::vector<double> moved;  // what was pulled moved by this, dimension() numbers
};

// Between knots of `knot_level`, what moves by more than 1e-9 of the largest coordinate.
[[nodiscard]] Interval affected_by_edit(const Points& before,
                                        const Points& after,
                                        Ends ends,
                                        int knot_level);

// The edited curve without `moved`. Equation (3.6) in the page's axes; with another frame
// the details turn with the curve, which is reconstructed level by level.
// Requires: the change's levels are the curve's.
[[nodiscard]] Edited apply(const MultiresCurve& curve,
                           const SweepChange& change,
                           Frame frame);

struct ControlEdit {
    double level = 0;               // in [0, curve.level()]
    std::size_t index = 0;          // of C^ceil(level)
    std::span<const double> delta;  // dimension() finite numbers
    Frame frame = Frame::kFixed;
};

// `moved` is that of control point `index` of C^level: delta in the page's axes; in other
// frames at a fractional level a turning D^j adds to it.
[[nodiscard]] Result<Edited> edit_sweep(const MultiresCurve& curve,
                                        const ControlEdit& edit);

// Control point `index` of C^ceil(level) moved by `delta`. Requires: all fit the curve.
[[nodiscard]] SweepChange control_change(RealLevel level,
                                         Ends ends,
                                         std::size_t index,
                                         std::span<const double> delta);

// Whether a level and a delta are the curve's; the error names the one that is not.
[[nodiscard]] Result<void> check_edit(const MultiresCurve& curve,
                                      double level,
                                      std::span<const double> delta);

// The edit, unless `delta` was so large that its numbers are no longer finite.
[[nodiscard]] Result<Edited> checked_edit(Edited edited, std::span<const double> delta);

}  // namespace haarmony::curve
