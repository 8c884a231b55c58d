#include "tests/eval/plot_svg.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <set>

#include "tests/eval/csv.h"
#include "tests/eval/page.h"

namespace haarmony::eval {
namespace {

constexpr double kWidth = 360;
constexpr double kHeight = 270;
constexpr double kLeft = 48;
constexpr double kRight = 350;
constexpr double kTop = 30;
constexpr double kBottom = 222;

constexpr std::array<const char*, kPlotDashes> kDashes = {"", "6 3", "2 3", "8 3 2 3"};

double share_of(const PlotAxis& axis, double value) {
    if (!axis.logarithmic) return (value - axis.low) / (axis.high - axis.low);
    return std::log(value / axis.low) / std::log(axis.high / axis.low);
}

// Places on the drawing; what lies beyond the axes is drawn at their ends.
struct Frame {
    const Plot& plot;

    [[nodiscard]] double x(double value) const {
        return kLeft + (kRight - kLeft) * std::clamp(share_of(plot.x, value), 0.0, 1.0);
    }
    [[nodiscard]] double y(double value) const {
        return kBottom - (kBottom - kTop) * std::clamp(share_of(plot.y, value), 0.0, 1.0);
    }
    [[nodiscard]] std::string at(double vx, double vy) const {
        return number(x(vx), 2) + ',' + number(y(vy), 2);
    }
};

std::string attribute(const char* name, double value) {
    return ' ' + std::string(name) + "=\"" + number(value, 2) + '"';
}

std::string line(double x1, double y1, double x2, double y2, const char* css) {
    return "<line class=\"" + std::string(css) + '"' + attribute("x1", x1) +
           attribute("y1", y1) + attribute("x2", x2) + attribute("y2", y2) + "/>";
}

std::string text(double x, double y, const char* css, const std::string& content) {
    return "<text class=\"" + std::string(css) + '"' + attribute("x", x) +
           attribute("y", y) + '>' + escape(content) + "</text>";
}

std::string colour_class(const PlotStyle& style) {
    assert(style.colour >= 0 && style.colour < kPlotColours);
    return "c" + std::to_string(style.colour);
}

std::string dashes(const PlotStyle& style) {
    assert(style.dash >= 0 && style.dash < kPlotDashes);
    if (style.dash == 0) return "";
    return " stroke-dasharray=\"" + std::string(kDashes[style.dash]) + '"';
}

// The outline of a mark, a circle or a polygon by the colour's number.
std::string mark(const PlotStyle& style, double x, double y, const std::string& title) {
    const std::string css = " class=\"mark " + colour_class(style) + "\">";
    const std::string end = title.empty() ? "" : "<title>" + escape(title) + "</title>";
    const int shape = style.colour % 5;
    if (shape == 0) {
        return "<circle r=\"2.6\"" + attribute("cx", x) + attribute("cy", y) + css + end +
               "</circle>";
    }
    static constexpr std::array<std::array<double, 8>, 4> kOutlines = {{
        {-2.4, -2.4, 2.4, -2.4, 2.4, 2.4, -2.4, 2.4},  // square
        {0, -3.2, 3.2, 0, 0, 3.2, -3.2, 0},            // diamond
        {0, -3.2, 3, 2.4, -3, 2.4, -3, 2.4},           // triangle
        {0, 3.2, 3, -2.4, -3, -2.4, -3, -2.4},         // triangle upside down
    }};
    std::string points;
    for (std::size_t i = 0; i < 8; i += 2) {
        points += number(x + kOutlines[shape - 1][i], 2) + ',' +
                  number(y + kOutlines[shape - 1][i + 1], 2) + ' ';
    }
    points.pop_back();
    return "<polygon points=\"" + points + '"' + css + end + "</polygon>";
}

std::string band_of(const Frame& frame, const PlotSeries& series) {
    std::string points;
    for (const PlotPoint& point : series.points)
        points += frame.at(point.x, point.high) + ' ';
    for (auto it = series.points.rbegin(); it != series.points.rend(); ++it)
        points += frame.at(it->x, it->low) + ' ';
    points.pop_back();
    return "<polygon class=\"band " + colour_class(series.style) + "\" points=\"" +
           points + "\"/>\n";
}

std::string line_of(const Frame& frame, const PlotSeries& series) {
    std::string points;
    for (const PlotPoint& point : series.points)
        points += frame.at(point.x, point.y) + ' ';
    points.pop_back();
    return "<polyline class=\"line " + colour_class(series.style) + '"' +
           dashes(series.style) + " points=\"" + points + "\"/>\n";
}

std::string title_of(const PlotSeries& series, const PlotPoint& point) {
    std::string title =
        series.name + ": " + number(point.x, 3) + ", " + number(point.y, 1);
    if (point.high > 0)
        title += " (" + number(point.low, 1) + " to " + number(point.high, 1) + ')';
    return title;
}

std::string axes_of(const Plot& plot, const Frame& frame) {
    std::string svg;
    for (const double value : ticks(plot.x)) {
        svg += line(frame.x(value), kTop, frame.x(value), kBottom, "grid");
        svg += text(frame.x(value), kBottom + 14, "tick middle", number(value, 3));
    }
    for (const double value : ticks(plot.y)) {
        svg += line(kLeft, frame.y(value), kRight, frame.y(value), "grid");
        svg += text(kLeft - 5, frame.y(value) + 3.5, "tick end", number(value, 3));
    }
    svg += line(kLeft, kTop, kLeft, kBottom, "axis");
    svg += line(kLeft, kBottom, kRight, kBottom, "axis");
    svg += text((kLeft + kRight) / 2, kBottom + 32, "label middle", plot.x.label);
    const std::string middle = number((kTop + kBottom) / 2, 2);
    svg += "<text class=\"label middle\" transform=\"translate(12 " + middle +
           ") rotate(-90)\">" + escape(plot.y.label) + "</text>\n";
    return svg;
}

}  // namespace

std::vector<double> ticks(const PlotAxis& axis) {
    assert(std::isfinite(axis.low) && std::isfinite(axis.high) && axis.low < axis.high);
    std::vector<double> values;
    if (axis.logarithmic) {
        assert(axis.low > 0);
        const int last = static_cast<int>(std::floor(std::log10(axis.high) + 1e-9));
        for (int power = static_cast<int>(std::ceil(std::log10(axis.low) - 1e-9));
             power <= last;
             ++power) {
            values.push_back(std::pow(10, power));
        }
        return values;
    }
    // Four to ten steps of 1, 2 or 5 times a power of ten.
    const double range = axis.high - axis.low;
    const double power = std::pow(10, std::floor(std::log10(range / 4)));
    double step = power;
    for (const double factor : {2.0, 5.0}) {
        if (range / (factor * power) >= 4) step = factor * power;
    }
    const auto first = static_cast<std::int64_t>(std::ceil(axis.low / step - 1e-9));
    const auto last = static_cast<std::int64_t>(std::floor(axis.high / step + 1e-9));
    for (std::int64_t i = first; i <= last; ++i)
        values.push_back(static_cast<double>(i) * step);
    return values;
}

std::string to_svg(const Plot& plot) {
    const Frame frame{plot};
    std::string svg = "<svg class=\"plot\" role=\"img\" viewBox=\"0 0 " +
                      number(kWidth, 0) + ' ' + number(kHeight, 0) + "\" aria-label=\"" +
                      escape(plot.title) + "\">\n";
    svg += text((kLeft + kRight) / 2, 16, "heading middle", plot.title);
    svg += axes_of(plot, frame);
    for (const PlotSeries& series : plot.series) {
        if (series.band && !series.points.empty()) svg += band_of(frame, series);
    }
    for (const PlotSeries& series : plot.series) {
        if (series.points.empty()) continue;
        svg += line_of(frame, series);
        if (!series.marks) continue;
        for (const PlotPoint& point : series.points) {
            svg += mark(series.style,
                        frame.x(point.x),
                        frame.y(point.y),
                        title_of(series, point));
        }
        svg += '\n';
    }
    return svg + "</svg>\n";
}

std::string legend(const std::vector<Plot>& plots) {
    std::string html = "<ul class=\"legend\">\n";
    std::set<std::string> seen;
    for (const Plot& plot : plots) {
        for (const PlotSeries& series : plot.series) {
            if (!seen.insert(series.name).second) continue;
            html +=
                "<li><svg viewBox=\"0 0 36 12\" width=\"36\" height=\"12\" "
                "aria-hidden=\"true\"><polyline class=\"line " +
                colour_class(series.style) + '"' + dashes(series.style) +
                " points=\"1,6 35,6\"/>" +
                (series.marks ? mark(series.style, 18, 6, "") : "") + "</svg> " +
                escape(series.name) + "</li>\n";
        }
    }
    return html + "</ul>\n";
}

}  // namespace haarmony::eval
