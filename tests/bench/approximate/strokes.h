// The strokes that are approximated: read from a file, or drawn by code.
#pragma once

#include <string>
#include <vector>

#include "engine/curve/points.h"

namespace haarmony::bench {

// Spirals, handwriting and coasts of 259 to 4,099 control points on a page of 1000 x 1000,
// with the noise of a hand; the same every time.
[[nodiscard]] std::vector<curve::Points> drawn_strokes();

// Of {"strokes":[{"control":[[x,y],...]},...]}. Ends the program if it is not that.
[[nodiscard]] std::vector<curve::Points> read_strokes(const std::string& path);

}  // namespace haarmony::bench
