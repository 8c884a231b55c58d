// Figures 3.10 and 3.11: a drawing at four sizes, each stroke with as many Bezier segments as
// half a pixel needs.
//
// Source  sec. 3.5.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "engine/curve/approximate.h"
#include "engine/curve/points.h"
#include "tests/eval/csv.h"

namespace haarmony::eval {

// A page 1000 wide, drawn so wide; the tolerance is kTolerancePx there.
inline constexpr std::array<int, 4> kSizesPx = {60, 120, 240, 480};
inline constexpr double kTolerancePx = 0.5;

struct ApproximatedStroke {
    std::string name;
    std::string character;
    curve::Approximation approximation;
};

struct ApproximatedDrawing {
    int size_px = 0;
    curve::Joining joining = curve::Joining::kDyadic;
    double tolerance = 0;  // on the page
    std::vector<ApproximatedStroke> strokes;

    [[nodiscard]] std::size_t count() const;
    [[nodiscard]] std::size_t possible() const;
    [[nodiscard]] double bound() const;      // of the worst stroke
    [[nodiscard]] double max_error() const;  // of the worst stroke
};

struct Figure310 {
    std::vector<ApproximatedDrawing> drawings;  // by size, for each joining
};

[[nodiscard]] Figure310 measure_figure_3_10();
[[nodiscard]] std::string sizes_html(const Figure310& figure);          // Figure 3.10
[[nodiscard]] std::string constant_size_html(const Figure310& figure);  // Figure 3.11
// A row for each stroke, size and joining.
[[nodiscard]] CsvTable to_csv(const Figure310& figure);

}  // namespace haarmony::eval
