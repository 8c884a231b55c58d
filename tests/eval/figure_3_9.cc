#include "tests/eval/figure_3_9.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "engine/curve/built_in_character.h"
#include "engine/curve/sweep_edit.h"
#include "tests/eval/csv.h"
#include "tests/eval/curve_svg.h"
#include "tests/eval/page.h"

namespace haarmony::eval {
namespace {

using curve::Ends;
using curve::Frame;
using curve::Points;

constexpr double kLevel = 1;  // of the edits: 5 control points
struct Pull {
    std::size_t index;
    std::array<double, 2> delta;
};
// Into a hill as high as wide.
constexpr std::array<Pull, 3> kPulls = {
    {{1, {120, -420}}, {2, {0, -420}}, {3, {-120, -420}}}};

Points pulled(const Points& original, Frame frame) {
    Points control = original;
    for (const Pull& pull : kPulls) {
        curve::ControlEdit edit;
        edit.level = kLevel;
        edit.index = pull.index;
        edit.delta = pull.delta;
        edit.frame = frame;
        control = curve::edit_sweep(curve::decompose(control, Ends::kOpen), edit)
                      .value()
                      .control;
    }
    return control;
}

void compare(const Points& before, const Points& after, Oriented& result) {
    double largest = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
        largest = std::max(largest, std::hypot(before[i][0], before[i][1]));
    for (std::size_t i = 0; i < before.size(); ++i) {
        const double size = std::hypot(before[i][0], before[i][1]);
        if (size < largest / 10) continue;
        const double growth = std::hypot(after[i][0], after[i][1]) / size;
        const double along = before[i][0] * after[i][0] + before[i][1] * after[i][1];
        const double across = before[i][0] * after[i][1] - before[i][1] * after[i][0];
        result.turned_degrees =
            std::max(result.turned_degrees,
                     std::abs(std::atan2(across, along)) * 180 / std::numbers::pi);
        result.least_growth = std::min(result.least_growth, growth);
        result.most_growth = std::max(result.most_growth, growth);
    }
}

const char* name_of(Frame frame) {
    switch (frame) {
        case Frame::kFixed:
            return "fixed";
        case Frame::kNormalized:
            return "normalised";
        default:
            return "unnormalised";
    }
}

}  // namespace

Figure39 measure_figure_3_9() {
    Figure39 figure;
    figure.original = curve::built_in_character("spiky")->stroke();
    const curve::MultiresCurve before = curve::decompose(figure.original, Ends::kOpen);
    for (const Frame frame : {Frame::kFixed, Frame::kNormalized, Frame::kUnnormalized}) {
        Oriented oriented;
        oriented.frame = frame;
        oriented.control = pulled(figure.original, frame);
        oriented.least_growth = INFINITY;
        const curve::MultiresCurve after =
            curve::decompose(oriented.control, Ends::kOpen);
        // The thorns are in the finer half of the levels.
        for (std::size_t level = before.details.size() / 2; level < before.details.size();
             ++level) {
            compare(before.details[level], after.details[level], oriented);
        }
        figure.edited.push_back(std::move(oriented));
    }
    return figure;
}

std::string to_html(const Figure39& figure) {
    std::vector<Points> all = {figure.original};
    for (const Oriented& oriented : figure.edited) all.push_back(oriented.control);
    const Box box = box_of(all, 20);
    CurveDrawing original("(a) The original", box);
    original.curve(figure.original, 0, Ink::kPlain);
    std::vector<std::string> drawings = {original.svg()};
    HtmlTable table({"frame", "details turned by up to", "their size, least", "most"}, 1);
    char letter = 'b';
    for (const Oriented& oriented : figure.edited) {
        const std::string name = name_of(oriented.frame);
        CurveDrawing drawing('(' + std::string(1, letter++) + ") " + name, box);
        drawing.curve(oriented.control, 0, Ink::kPlain);
        drawings.push_back(drawing.svg());
        table.add({name,
                   number(oriented.turned_degrees, 1) + " degrees",
                   number(oriented.least_growth, 3),
                   number(oriented.most_growth, 3)});
    }
    return paragraph(
               "The sweep of (a) is pulled up at level 1. In the page's axes the thorns "
               "still point up, like trees on a hill (b); in the frames of the curve "
               "they "
               "stand out from it, like hair (c); unnormalised frames also grow and "
               "shrink "
               "with the speed of the curve (d). The table compares the details of the "
               "finer "
               "half of the levels after the edit with those before, on the page.") +
           small_panels(drawings) + table.html();
}

}  // namespace haarmony::eval
