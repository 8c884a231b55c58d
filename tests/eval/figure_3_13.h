// Figure 3.13: thickness as a third dimension, carried along and edited like the others.
//
// Source  sec. 3.6 "Textured strokes".
#pragma once

#include <cstddef>
#include <string>

#include "engine/curve/points.h"

namespace haarmony::eval {

struct Figure313 {
    curve::Points original;      // x, y, thickness
    curve::Points smoothed;      // all three
    curve::Points bent;          // x and y edited
    curve::Points pressed;       // the thickness edited
    curve::Points scribbled;     // with another character
    curve::Points approximated;  // Bezier segments, four rows each

    double thickness_of_bent = 0;       // the largest change
    double place_of_pressed = 0;        // the largest change of x and y
    double missed_pressing = 0;         // the dragged thickness from what was asked for
    double thickness_of_scribbled = 0;  // the largest change

    // Of the approximation: in x and y; thickness where segments meet.
    double tolerance = 0;
    double bound = 0;
    double max_error = 0;
    double carried_error = 0;
    std::size_t possible = 0;  // segments
};

[[nodiscard]] Figure313 measure_figure_3_13();
[[nodiscard]] std::string to_html(const Figure313& figure);

}  // namespace haarmony::eval
