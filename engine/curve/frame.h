// Details in the axes of the page, or along the tangent and normal of the curve they refine.
//   multires_curve.h, wavelet_peak.h -> [frame.h] -> sweep_edit.h, character.h
//
// The frame of row k of D^j is taken from f^j at the peak u0 of that wavelet: T = f^j'(u0),
// N = T turned by a quarter from x to y. A detail of (a, b) in it is a T + b N on the page.
// Where T is shorter than 1e-12 the frame is that of the page. Only x and y turn.
//
// Scale    kNormalized: |T| = 1, details are as long as on the page. kUnnormalized: details
//          are in units of |f^j'| and so grow with the curve.
// Errors   none; a wrong shape is a caller's bug and asserts.
// Threads  const-thread-safe.
// Cost     linear in the control points.
// Source   sec. 3.4.3; f^j where it prints f^(j-1), which D^0 would not have.
#pragma once

#include <vector>

#include "engine/curve/multires_curve.h"

namespace haarmony::curve {

enum class Frame {
    kFixed,  // the page's axes
    kNormalized,
    kUnnormalized,
};

// C^0 and D^0 .. D^(j-1) with the details in their frames.
struct LocalDetails {
    Ends ends = Ends::kOpen;
    Frame frame = Frame::kFixed;
    Points coarse;
    std::vector<Points> details;

    [[nodiscard]] int level() const { return static_cast<int>(details.size()); }
};

[[nodiscard]] LocalDetails to_local(const MultiresCurve& curve, Frame frame);

// The frames come from the curve as far as it is already reconstructed, so that the details
// follow a sweep which was changed.
[[nodiscard]] MultiresCurve to_world(const LocalDetails& curve);

// C^level, as reconstruct() of to_world(). Requires: 0 <= level <= curve.level().
[[nodiscard]] Points reconstruct(const LocalDetails& curve, int level);

// One level: D^j into and out of the frames of the curve with control points C^j.
// Requires: detail.size() rows are those of the level of `control`.
void into_frames(Points& detail, const Points& control, Ends ends, Frame frame);
void out_of_frames(Points& detail, const Points& control, Ends ends, Frame frame);

}  // namespace haarmony::curve
