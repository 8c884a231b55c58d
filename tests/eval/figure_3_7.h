// Figure 3.7: a portion of wanted length edited, on a curve whose u is uneven.
//
// Source  sec. 3.4.1 "Editing a desired portion of the curve".
#pragma once

#include <string>
#include <vector>

#include "engine/curve/points.h"

namespace haarmony::eval {

struct PortionPull {
    double u = 0;
    double level = 0;
    double wanted = 0;    // share of the length asked for; 0: the level was given
    double affected = 0;  // share of the length that an edit of the level may move
    double moved = 0;     // share that moved by more than a 50th of the pull
    curve::Points control;
};

struct Figure37 {
    curve::Points original;
    std::vector<PortionPull> pulls;
};

[[nodiscard]] Figure37 measure_figure_3_7();
[[nodiscard]] std::string to_html(const Figure37& figure);

}  // namespace haarmony::eval
