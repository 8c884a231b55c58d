// The curve figures of chapter 3 with our own curves, as a page and a table; also an example
// of how the library of curves is used without the server.
//
// Source  Figures 3.4 to 3.11 and 3.13.
#pragma once

#include <vector>

#include "tests/eval/figures.h"

namespace haarmony::eval {

// curves.html and curves_approximation.csv, the same at every call.
[[nodiscard]] std::vector<OutputFile> make_curve_figures();

}  // namespace haarmony::eval
