#include "engine/curve/bezier_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "engine/curve/number_text.h"
#include "engine/curve/plane_cubic.h"

namespace haarmony::curve {
namespace {

struct Box {
    PlaneVector low, high;
    double line;  // width
};

// Of the control points, which hold the curve, and half a line around them.
Box box_of(const Points& bezier) {
    Box box{in_plane(bezier[0]), in_plane(bezier[0]), 0};
    for (std::size_t i = 1; i < bezier.size(); ++i) {
        const PlaneVector p = in_plane(bezier[i]);
        box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
        box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
    }
    const double side = std::max(box.high.x - box.low.x, box.high.y - box.low.y);
    box.line = side > 0 ? side / 500 : 1;
    const PlaneVector half{box.line / 2, box.line / 2};
    box.low = box.low - half;
    box.high = box.high + half;
    return box;
}

void append_point(std::string& text, PlaneVector p) {
    append_number(text, p.x);
    text += ' ';
    append_number(text, p.y);
}

// Without exponent or fraction. A double has up to 309 digits before the point.
void append_whole(std::string& text, double value) {
    std::array<char, 320> digits{};
    const auto end = std::to_chars(digits.data(),
                                   digits.data() + digits.size(),
                                   value,
                                   std::chars_format::fixed,
                                   0)
                         .ptr;
    text.append(digits.data(), end);
}

std::string promises(const Approximation& a) {
    return std::to_string(a.count()) + " of " + std::to_string(a.possible) +
           " segments, tolerance " + number_text(a.tolerance) + ", bound " +
           number_text(a.bound) + ", measured error " + number_text(a.max_error);
}

// Writes every segment: `move` before a subpath, `curve` after its three points.
struct Operators {
    const char* before_move;
    const char* after_move;
    const char* before_curve;
    const char* after_curve;
    const char* close;
};
std::string path(const Approximation& approximation, const Operators& operators) {
    const Points& bezier = approximation.bezier;
    const std::vector<std::size_t> starts = subpath_starts(bezier);
    std::string text;
    auto start = starts.begin();
    for (std::size_t i = 0; i < approximation.count(); ++i) {
        if (start != starts.end() && *start == i) {
            ++start;
            text += operators.before_move;
            append_point(text, in_plane(bezier[4 * i]));
            text += operators.after_move;
        }
        text += operators.before_curve;
        for (std::size_t k = 1; k < 4; ++k) {
            if (k > 1) text += ' ';
            append_point(text, in_plane(bezier[4 * i + k]));
        }
        text += operators.after_curve;
    }
    if (is_closed_path(approximation)) text += operators.close;
    return text;
}

}  // namespace

std::vector<std::size_t> subpath_starts(const Points& bezier) {
    std::vector<std::size_t> starts;
    for (std::size_t i = 0; i < bezier.size() / 4; ++i) {
        if (i == 0 || in_plane(bezier[4 * i]) != in_plane(bezier[4 * i - 1])) {
            starts.push_back(i);
        }
    }
    return starts;
}

bool is_closed_path(const Approximation& approximation) {
    const Points& bezier = approximation.bezier;
    return approximation.closed && subpath_starts(bezier).size() == 1 &&
           in_plane(bezier[0]) == in_plane(bezier[bezier.size() - 1]);
}

std::string svg_path(const Approximation& approximation) {
    return path(approximation, {"M", "", "C", "", "Z"});
}

std::string svg_document(const Approximation& approximation) {
    const Box box = box_of(approximation.bezier);
    std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"";
    append_point(text, box.low);
    text += ' ';
    append_point(text, box.high - box.low);
    text += "\">\n<desc>" + promises(approximation) +
            "</desc>\n<path fill=\"none\" stroke=\"black\" stroke-width=\"" +
            number_text(box.line) + "\" d=\"" + svg_path(approximation) +
            "\"/>\n</svg>\n";
    return text;
}

std::string postscript(const Approximation& approximation) {
    const Box box = box_of(approximation.bezier);
    std::string text = "%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox:";
    for (const double side : {std::floor(box.low.x),
                              std::floor(-box.high.y),
                              std::ceil(box.high.x),
                              std::ceil(-box.low.y)}) {
        text += ' ';
        append_whole(text, side + 0.0);  // no "-0"
    }
    text += "\n%%Title: " + promises(approximation) +
            "\n%%EndComments\ngsave\n1 -1 scale\n" + number_text(box.line) +
            " setlinewidth\nnewpath\n";
    text += path(approximation, {"", " moveto\n", "", " curveto\n", "closepath\n"});
    text += "stroke\ngrestore\nshowpage\n%%EOF\n";
    return text;
}

}  // namespace haarmony::curve
