// A curve apart into its overall sweep and its details, level by level, and together again.
//   bspline_filters.h, banded.h -> [multires_curve.h] -> smooth.h, sweep_edit.h, character.h
//
// Scale    details belong to wavelets of unit L2 norm on [0, 1], positive at their peak; in
//          the axes of the page (frame.h turns them into the curve's own).
// Errors   none; a wrong shape is a caller's bug and asserts.
// Threads  const-thread-safe.
// Cost     linear in the control points of the finest level.
// Source   sec. 3.2.1, equations (3.2) to (3.4) [analysis and synthesis], sec. 3.2.2.
#pragma once

#include <vector>

#include "engine/curve/level.h"
#include "engine/curve/points.h"

namespace haarmony::curve {

// C^0 and D^0 .. D^(j-1).
struct MultiresCurve {
    Ends ends = Ends::kOpen;
    Points coarse;
    std::vector<Points> details;

    [[nodiscard]] int level() const { return static_cast<int>(details.size()); }
};

// C^(j-1) and D^(j-1) of C^j, the least squares projection on [0, 1] and what it leaves.
// Requires: a level above 0.
struct AnalysisStep {
    Points coarse;
    Points detail;
};
[[nodiscard]] AnalysisStep analyze(const Points& control, Ends ends);

// C^j = P^j C^(j-1) + Q^j D^(j-1). An empty `detail` is one of zeros.
[[nodiscard]] Points synthesize(const Points& coarse, const Points& detail, Ends ends);

// Requires: as many points as a level has (level_of()).
[[nodiscard]] MultiresCurve decompose(const Points& control, Ends ends);

// C^level. Requires: 0 <= level <= curve.level().
[[nodiscard]] Points reconstruct(const MultiresCurve& curve, int level);
[[nodiscard]] inline Points reconstruct(const MultiresCurve& curve) {
    return reconstruct(curve, curve.level());
}

}  // namespace haarmony::curve
