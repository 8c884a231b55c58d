// Which editing level moves a portion of given length.
//   bspline.h -> [portion.h] -> sweep_edit.h, direct_edit.h
//
// h^j(u) is the length of f^n over the supports of the basis functions of level j that are
// not 0 at u; it falls as j grows. Between two levels it is interpolated. What is not
// shorter than h^0 means level 0, what is not longer than h^n level n.
//
// Units    lengths in x and y of the page, by 16-point Gauss quadrature of each segment. Only
//          at a cusp does that miss by more than 1e-5, up to 1e-3 of the segment: an edit
//          fades out over several of them.
// Errors   none; a wrong shape is a caller's bug and asserts.
// Threads  const-thread-safe.
// Source   sec. 3.4.1 "Editing a desired portion of the curve".
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/curve/level.h"
#include "engine/curve/points.h"

namespace haarmony::curve {

// The lengths of f^n that portions are measured with: made once, asked often.
class PortionLengths {
  public:
    // Cost: linear in the control points.
    PortionLengths(const Points& control, Ends ends);

    [[nodiscard]] int level() const { return level_; }
    [[nodiscard]] double total() const { return until_.back(); }

    // h^level(u). Requires: 0 <= level <= level(), 0 <= u <= 1. Cost: constant.
    [[nodiscard]] double affected(int level, double u) const;

    // The real level whose edit at u moves about `length`. Requires: length > 0.
    [[nodiscard]] double level_for(double u, double length) const;

    // The same centred on the peak of control point `index` of the level found: of the
    // levels j that have the index, the first whose own answer l has ceil(l) = j; where none
    // agrees the one that misses least, its answer brought to within (j - 1, j].
    // Nothing where level() has no such index. Requires: length > 0.
    [[nodiscard]] std::optional<double> level_for_control(std::size_t index,
                                                          double length) const;

  private:
    int level_ = 0;
    Ends ends_ = Ends::kOpen;
    std::vector<double> until_;  // length up to each knot of the curve, from 0
};

}  // namespace haarmony::curve
