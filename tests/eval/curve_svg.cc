#include "tests/eval/curve_svg.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "engine/curve/bspline.h"
#include "engine/curve/level.h"
#include "tests/eval/csv.h"
#include "tests/eval/page.h"
#include "tests/eval/plot_svg.h"

namespace haarmony::eval {
namespace {

using curve::Ends;
using curve::Points;

constexpr double kWidth = 360;
constexpr double kHeading = 24;

std::string colour_class(int colour) {
    assert(colour >= 0 && colour < kPlotColours);
    return "c" + std::to_string(colour);
}

std::string line_class(int colour, Ink ink) {
    static constexpr const char* kInks[] = {"", " fine", " ghost"};
    return "line" + std::string(kInks[int(ink)]) + ' ' + colour_class(colour);
}

}  // namespace

Box box_of(const std::vector<Points>& controls, double margin) {
    assert(!controls.empty());
    Box box{INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (const Points& control : controls) {
        const Points bezier = curve::bezier_points(control, Ends::kOpen);
        for (std::size_t i = 0; i < bezier.size(); ++i) {
            box.left = std::min(box.left, bezier[i][0]);
            box.right = std::max(box.right, bezier[i][0]);
            box.top = std::min(box.top, bezier[i][1]);
            box.bottom = std::max(box.bottom, bezier[i][1]);
        }
    }
    return {box.left - margin, box.top - margin, box.right + margin, box.bottom + margin};
}

Points segments_of(const Points& control) {
    const Points chain = curve::bezier_points(control, Ends::kOpen);
    Points bezier((chain.size() - 1) / 3 * 4, chain.dimension());
    for (std::size_t i = 0; i < bezier.size(); ++i)
        std::ranges::copy(chain[i / 4 * 3 + i % 4], bezier[i].begin());
    return bezier;
}

SegmentPoint segment_point(const Points& bezier, std::size_t first, double t) {
    const double s = 1 - t;
    const double value[4] = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
    const double slope[4] = {
        -3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t};
    const auto dimension = static_cast<std::size_t>(bezier.dimension());
    SegmentPoint point{std::vector<double>(dimension), std::vector<double>(dimension)};
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t d = 0; d < dimension; ++d) {
            point.place[d] += value[i] * bezier[first + i][d];
            point.slope[d] += slope[i] * bezier[first + i][d];
        }
    }
    return point;
}

CurveDrawing::CurveDrawing(std::string title, const Box& box)
    : title_(std::move(title)),
      box_(box),
      scale_(kWidth / (box.right - box.left)),
      top_(kHeading) {}

CurveDrawing::CurveDrawing(std::string title, const Box& box, int width_px)
    : title_(std::move(title)),
      box_(box),
      scale_(width_px / (box.right - box.left)),
      width_px_(width_px) {}

std::string CurveDrawing::at(double x, double y) const {
    return number((x - box_.left) * scale_, 2) + ',' +
           number((y - box_.top) * scale_ + top_, 2);
}

void CurveDrawing::curve(const Points& control, int colour, Ink ink) {
    segments(segments_of(control), colour, ink);
}

void CurveDrawing::segments(const Points& bezier, int colour, Ink ink) {
    content_ += "<path class=\"" + line_class(colour, ink) + "\" d=\"";
    std::string end;
    for (std::size_t i = 0; i + 3 < bezier.size(); i += 4) {
        const std::string start = at(bezier[i][0], bezier[i][1]);
        if (start != end) content_ += 'M' + start;
        content_ += 'C' + at(bezier[i + 1][0], bezier[i + 1][1]) + ' ' +
                    at(bezier[i + 2][0], bezier[i + 2][1]) + ' ';
        end = at(bezier[i + 3][0], bezier[i + 3][1]);
        content_ += end;
    }
    content_ += "\"/>\n";
}

void CurveDrawing::joints(const Points& bezier, int colour) {
    // Dots are lines of no length with round ends.
    content_ += "<path class=\"joint " + colour_class(colour) + "\" d=\"";
    for (std::size_t i = 0; i + 3 < bezier.size(); i += 4)
        content_ += 'M' + at(bezier[i][0], bezier[i][1]) + "h0";
    const std::size_t last = bezier.size() - 1;
    content_ += 'M' + at(bezier[last][0], bezier[last][1]) + "h0\"/>\n";
}

void CurveDrawing::ribbon(const Points& bezier, int colour) {
    assert(bezier.dimension() >= 3);
    // So many points of a stroke look round, however few its segments.
    constexpr int kSamples = 768;
    const int each = std::max(3, kSamples * 4 / static_cast<int>(bezier.size()));
    std::string there;
    std::vector<std::string> back;
    for (std::size_t first = 0; first + 3 < bezier.size(); first += 4) {
        for (int i = 0; i <= each; ++i) {
            const SegmentPoint point = segment_point(bezier, first, double(i) / each);
            const double speed =
                std::max(std::hypot(point.slope[0], point.slope[1]), 1e-9);
            const double half = std::max(point.place[2], 0.0) / 2;
            const double nx = -point.slope[1] / speed * half;
            const double ny = point.slope[0] / speed * half;
            there += at(point.place[0] + nx, point.place[1] + ny) + ' ';
            back.push_back(at(point.place[0] - nx, point.place[1] - ny));
        }
    }
    for (auto place = back.rbegin(); place != back.rend(); ++place) there += *place + ' ';
    there.pop_back();
    content_ += "<polygon class=\"ribbon " + colour_class(colour) + "\" points=\"" +
                there + "\"/>\n";
}

void CurveDrawing::dot(double x, double y, int colour, const std::string& title) {
    content_ += "<circle class=\"mark " + colour_class(colour) + "\" r=\"2.6\" cx=\"" +
                number((x - box_.left) * scale_, 2) + "\" cy=\"" +
                number((y - box_.top) * scale_ + top_, 2) + "\"><title>" + escape(title) +
                "</title></circle>\n";
}

void CurveDrawing::arrow(double x, double y, double dx, double dy, int colour) {
    const double size = std::hypot(dx, dy);
    assert(size > 0);
    const double head = 7 / scale_ / size;
    content_ += "<path class=\"" + line_class(colour, Ink::kPlain) + "\" d=\"M" +
                at(x, y) + 'L' + at(x + dx, y + dy) + 'M' +
                at(x + dx - head * (dx + dy / 2), y + dy - head * (dy - dx / 2)) + 'L' +
                at(x + dx, y + dy) + 'L' +
                at(x + dx - head * (dx - dy / 2), y + dy - head * (dy + dx / 2)) +
                "\"/>\n";
}

std::string CurveDrawing::svg() const {
    const double width = (box_.right - box_.left) * scale_;
    const double height = (box_.bottom - box_.top) * scale_ + top_;
    std::string svg = width_px_ == 0 ? "<svg class=\"plot\""
                                     : "<svg width=\"" + std::to_string(width_px_) +
                                           "\" height=\"" + number(height, 2) + '"';
    svg += " role=\"img\" viewBox=\"0 0 " + number(width, 2) + ' ' + number(height, 2) +
           "\" aria-label=\"" + escape(title_) + "\">\n";
    if (width_px_ == 0) {
        svg += "<text class=\"heading middle\" x=\"" + number(width / 2, 2) +
               "\" y=\"15\">" + escape(title_) + "</text>\n";
    }
    return svg + content_ + "</svg>\n";
}

std::string in_a_row(const std::vector<std::string>& drawings) {
    std::string html = "<div class=\"sizes\">\n";
    for (const std::string& drawing : drawings) html += "<div>" + drawing + "</div>\n";
    return html + "</div>\n";
}

}  // namespace haarmony::eval
