// Figure 3.5: another sweep under the same character.
//
// Source  sec. 3.4.1 "Editing the sweep", sec. 3.4.3 (normalised frames).
#pragma once

#include <string>

#include "engine/curve/points.h"

namespace haarmony::eval {

inline constexpr int kSweepLevel = 2;

struct Figure35 {
    curve::Points original;       // (a)
    curve::Points sweep;          // (b), of level kSweepLevel
    curve::Points changed_sweep;  // (c)
    curve::Points edited;         // (d)
    double sweep_error = 0;       // the sweep found in (d) beside (c)
    double character_error = 0;   // details of (d) in its frames beside those of (a)
    double largest_detail = 0;    // of (a), what character_error is to be compared with
};

[[nodiscard]] Figure35 measure_figure_3_5();
[[nodiscard]] std::string to_html(const Figure35& figure);

}  // namespace haarmony::eval
