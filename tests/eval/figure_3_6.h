// Figure 3.6: the middle of a curve pulled at integer and at fractional levels.
//
// Source  sec. 3.4.1, equations (3.3) to (3.7).
#pragma once

#include <string>
#include <vector>

#include "engine/curve/affected.h"
#include "engine/curve/points.h"

namespace haarmony::eval {

struct PulledAtLevel {
    double level = 0;
    std::vector<curve::Points> pulled;  // by thirds of the way, by all of it
    curve::Interval affected;
    double half_width = 0;  // share of u that moved by more than half of the most
    double missed = 0;      // the dragged point of f^n from where it should be
    double overshoot = 0;   // f^n(u) where the smoothed curve is dragged: times the way
};

struct Figure36 {
    curve::Points original;
    std::vector<PulledAtLevel> integer;     // 1, 2, 3, 4
    std::vector<PulledAtLevel> fractional;  // 2.2, 2.4, 2.6, 2.8
};

[[nodiscard]] Figure36 measure_figure_3_6();
[[nodiscard]] std::string to_html(const Figure36& figure);

}  // namespace haarmony::eval
