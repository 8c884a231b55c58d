// An approximation as SVG and as PostScript.
//   approximate.h -> [bezier_text.h]
//
// Segments that meet are one subpath; a closed curve's only subpath is closed. Documents say
// in a description or in comments what was asked for and what is promised.
//
// Units    the curve's own, y down the page; PostScript, whose y goes up, mirrors it.
// Errors   none.
// Threads  const-thread-safe.
// Source   sec. 3.5 [PostScript]; SVG 2, sec. 9.3; PostScript Language Reference, 1990.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/curve/approximate.h"
#include "engine/curve/points.h"

namespace haarmony::curve {

// The first segments of subpaths: those that do not start where the one before ends.
[[nodiscard]] std::vector<std::size_t> subpath_starts(const Points& bezier);

// Whether there is one subpath and it comes back to its start.
[[nodiscard]] bool is_closed_path(const Approximation& approximation);

// Path data: "M0 0C1 2 3 4 5 6Z".
[[nodiscard]] std::string svg_path(const Approximation& approximation);
// A document whose view is the bounding box, with a line a 500th of it in width.
[[nodiscard]] std::string svg_document(const Approximation& approximation);
// An encapsulated document of one page.
[[nodiscard]] std::string postscript(const Approximation& approximation);

}  // namespace haarmony::curve
