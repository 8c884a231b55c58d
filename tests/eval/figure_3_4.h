// Figure 3.4: a curve smoothed to real levels.
//
// Source  sec. 3.3, equation (3.1).
#pragma once

#include <string>
#include <vector>

#include "engine/curve/points.h"
#include "tests/eval/curve_distance.h"

namespace haarmony::eval {

struct SmoothedVersion {
    double level = 0;
    bool pinned = false;  // ends
    curve::Points control;
    CurveDistance distance;  // from the original
    double end_moved = 0;    // the end that went further
};

struct Figure34 {
    curve::Points original;
    std::vector<SmoothedVersion> versions;
};

[[nodiscard]] Figure34 measure_figure_3_4();
[[nodiscard]] std::string to_html(const Figure34& figure);

}  // namespace haarmony::eval
