// Line plots as SVG, to stand in a page.
//
// Colours are classes of the page's style sheet (page.h), so that a plot follows its light
// or dark scheme; a series is also told by its dashes and by the shape of its marks. Marks
// carry their values as titles, which browsers show on hovering.
//
// Shape   one <svg> element, well-formed as XML, without references to anything outside.
// Errors  none; a value that is not finite is a caller's bug and asserts.
#pragma once

#include <string>
#include <vector>

namespace haarmony::eval {

inline constexpr int kPlotColours = 10;
inline constexpr int kPlotDashes = 4;

struct PlotStyle {
    int colour = 0;  // 0 .. kPlotColours - 1
    int dash = 0;    // 0 is solid, up to kPlotDashes - 1
    friend bool operator==(const PlotStyle&, const PlotStyle&) = default;
};

struct PlotPoint {
    double x = 0;
    double y = 0;
    double low = 0;  // of the interval around y; both 0 for none
    double high = 0;
};

struct PlotSeries {
    std::string name;
    PlotStyle style;
    std::vector<PlotPoint> points;  // in rising order of x
    bool marks = true;
    bool band = false;  // shades the interval
};

struct PlotAxis {
    std::string label;
    double low = 0;
    double high = 1;  // above low; above 0 as well, as is low, where logarithmic
    bool logarithmic = false;
};

struct Plot {
    std::string title;
    PlotAxis x;
    PlotAxis y;
    std::vector<PlotSeries> series;
};

// Even, round values from low to high; on a logarithmic axis the powers of ten.
[[nodiscard]] std::vector<double> ticks(const PlotAxis& axis);

[[nodiscard]] std::string to_svg(const Plot& plot);

// A list of names with samples of their lines, each name once, in order of appearance.
[[nodiscard]] std::string legend(const std::vector<Plot>& plots);

}  // namespace haarmony::eval
