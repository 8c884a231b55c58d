// Figure 3.9: details that keep their direction, and details that turn with the curve.
//
// Source  sec. 3.4.3.
#pragma once

#include <string>
#include <vector>

#include "engine/curve/frame.h"
#include "engine/curve/points.h"

namespace haarmony::eval {

struct Oriented {
    curve::Frame frame = curve::Frame::kFixed;
    curve::Points control;
    // Of the details' directions, the largest; tiny details, below a tenth of the largest
    // one, are left out.
    double turned_degrees = 0;
    // Their size after the edit, times that before: the least and the most.
    double least_growth = 0;
    double most_growth = 0;
};

struct Figure39 {
    curve::Points original;
    std::vector<Oriented> edited;
};

[[nodiscard]] Figure39 measure_figure_3_9();
[[nodiscard]] std::string to_html(const Figure39& figure);

}  // namespace haarmony::eval
