#include "tests/eval/figure_3_7.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "engine/curve/bspline.h"
#include "engine/curve/direct_edit.h"
#include "engine/curve/multires_curve.h"
#include "engine/curve/portion.h"
#include "tests/eval/csv.h"
#include "tests/eval/curve_distance.h"
#include "tests/eval/curve_strokes.h"
#include "tests/eval/curve_svg.h"
#include "tests/eval/page.h"

namespace haarmony::eval {
namespace {

using curve::Ends;
using curve::Points;

constexpr std::array<double, 2> kDelta = {0, -150};
constexpr double kGivenLevel = 3;
constexpr double kWanted = 0.3;
constexpr double kLeft = 0.3;
constexpr double kRight = 0.85;

// Share of the length of `original` that `edited` moved noticeably.
double share_moved(const Points& original, const Points& edited) {
    const std::vector<double> moved = distances(original, edited);
    const double least = std::hypot(kDelta[0], kDelta[1]) / 50;
    double all = 0;
    double some = 0;
    std::vector<double> before = curve::point_at(original, Ends::kOpen, 0);
    for (std::size_t i = 1; i < moved.size(); ++i) {
        std::vector<double> point =
            curve::point_at(original, Ends::kOpen, double(i) / double(moved.size() - 1));
        const double piece = std::hypot(point[0] - before[0], point[1] - before[1]);
        all += piece;
        if (moved[i] > least) some += piece;
        before = std::move(point);
    }
    return some / all;
}

// What an edit at u reaches, between the levels as PortionLengths puts it.
double reach(const curve::PortionLengths& lengths, double level, double u) {
    const int below = static_cast<int>(std::floor(level));
    const double part = level - below;
    const double here = lengths.affected(below, u);
    if (part == 0) return here / lengths.total();
    return ((1 - part) * here + part * lengths.affected(below + 1, u)) / lengths.total();
}

}  // namespace

Figure37 measure_figure_3_7() {
    Figure37 figure;
    figure.original = uneven_stroke();
    const curve::MultiresCurve parts = curve::decompose(figure.original, Ends::kOpen);
    const curve::PortionLengths lengths(figure.original, Ends::kOpen);
    struct Wanted {
        double u;
        double share;
    };
    for (const Wanted wanted : {Wanted{kLeft, 0},
                                Wanted{kRight, 0},
                                Wanted{kLeft, kWanted},
                                Wanted{kRight, kWanted}}) {
        PortionPull pull;
        pull.u = wanted.u;
        pull.wanted = wanted.share;
        pull.level = wanted.share == 0
                         ? kGivenLevel
                         : lengths.level_for(wanted.u, wanted.share * lengths.total());
        pull.affected = reach(lengths, pull.level, wanted.u);
        curve::PointEdit edit;
        edit.level = pull.level;
        edit.u = wanted.u;
        edit.delta = kDelta;
        edit.drag = curve::Drag::kFull;
        pull.control = curve::drag_point(parts, edit).value().control;
        pull.moved = share_moved(figure.original, pull.control);
        figure.pulls.push_back(std::move(pull));
    }
    return figure;
}

std::string to_html(const Figure37& figure) {
    std::vector<Points> all = {figure.original};
    for (const PortionPull& pull : figure.pulls) all.push_back(pull.control);
    const Box box = box_of(all, 20);
    CurveDrawing original("(a) 33 even steps of u", box);
    original.curve(figure.original, 9, Ink::kPlain);
    for (int i = 0; i <= 32; ++i) {
        const double u = double(i) / 32;
        const std::vector<double> p = curve::point_at(figure.original, Ends::kOpen, u);
        original.dot(p[0], p[1], 1, "u = " + number(u, 3));
    }
    std::vector<std::string> drawings = {original.svg()};
    HtmlTable table({"", "u", "level", "asked for", "within reach", "moved visibly"}, 1);
    char letter = 'b';
    for (const PortionPull& pull : figure.pulls) {
        const std::string title =
            '(' + std::string(1, letter++) + ") u = " + number(pull.u, 2) + ", " +
            (pull.wanted == 0 ? "level " + number(pull.level, 0)
                              : number(100 * pull.wanted, 0) + " % of the length");
        CurveDrawing drawing(title, box);
        drawing.curve(figure.original, 9, Ink::kGhost);
        drawing.curve(pull.control, 0, Ink::kPlain);
        const std::vector<double> p =
            curve::point_at(figure.original, Ends::kOpen, pull.u);
        drawing.arrow(p[0], p[1], kDelta[0], kDelta[1], 1);
        drawings.push_back(drawing.svg());
        table.add({title.substr(0, 3),
                   number(pull.u, 2),
                   number(pull.level, 4),
                   pull.wanted == 0 ? "-" : number(100 * pull.wanted, 0) + " %",
                   number(100 * pull.affected, 1) + " %",
                   number(100 * pull.moved, 1) + " %"});
    }
    return paragraph(
               "Even steps of u (red) are long on the right of this curve. An edit at "
               "level "
               "3 therefore moves little of it on the left (b) and much on the right "
               "(c); "
               "asked for 30 % of the length, the engine finds the level that reaches so "
               "far at either place (d, e). \"Moved visibly\" counts what moved by more "
               "than "
               "a 50th of the pull: edits fade out at their ends, so it is less than "
               "what is "
               "within reach.") +
           panels(drawings) + table.html();
}

}  // namespace haarmony::eval
