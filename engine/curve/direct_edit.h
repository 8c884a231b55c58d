// Dragging a point of the curve itself instead of a control point.
//   bspline.h, sweep_edit.h -> [direct_edit.h]
//
// Units    u in [0, 1]; deltas in the axes of the page.
// Errors   drag_point: a level, u or delta that the curve does not have; `param` names the
//          field of PointEdit.
// Threads  const-thread-safe.
// Cost     linear in the control points; the pseudo-inverses are constant.
// Source   sec. 3.4.1 "Editing with direct manipulation", equation (3.7), then (3.5), (3.6).
#pragma once

#include <span>

#include "engine/core/result.h"
#include "engine/curve/sweep_edit.h"

namespace haarmony::curve {

enum class Drag {
    kSmooth,  // f^level(u) moves by delta; at a fractional level f^n(u) overshoots a little
    kFull,    // f^n(u) moves by delta, exactly, in every frame
};

struct PointEdit {
    double level = 0;               // in [0, curve.level()]
    double u = 0;                   // in [0, 1]
    std::span<const double> delta;  // dimension() finite numbers
    Drag drag = Drag::kSmooth;
    Frame frame = Frame::kFixed;
};

// `moved` is what f^n(u) moved by. With Drag::kFull and turning details the way is found by
// repeated pulls, down to 1e-5 of the largest coordinate; the rest is moved with the details
// as they then stand.
[[nodiscard]] Result<Edited> drag_point(const MultiresCurve& curve,
                                        const PointEdit& edit);

// The least change of control points that moves f^level(u) by `delta`: pseudo-inverses (3.7)
// put together by (3.5). Requires: all fit the curve.
[[nodiscard]] SweepChange point_change(RealLevel level,
                                       Ends ends,
                                       double u,
                                       std::span<const double> delta);

// How far f^n(u) goes for each unit that f^level(u) goes, in the page's axes: 1 at integer
// levels, 1 + t (1 - t) b between them. b is between -0.01 and 0.31, on a closed curve of
// few points up to 0.5.
[[nodiscard]] double overshoot(RealLevel level, Ends ends, double u);

}  // namespace haarmony::curve
