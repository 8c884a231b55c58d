#include "tests/eval/figure_3_6.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "engine/curve/direct_edit.h"
#include "engine/curve/multires_curve.h"
#include "tests/eval/csv.h"
#include "tests/eval/curve_distance.h"
#include "tests/eval/curve_strokes.h"
#include "tests/eval/curve_svg.h"
#include "tests/eval/page.h"

namespace haarmony::eval {
namespace {

using curve::Points;

constexpr double kMiddle = 0.5;
constexpr double kUp = -240;

curve::Edited drag(const curve::MultiresCurve& parts,
                   double level,
                   double up,
                   curve::Drag drag) {
    const std::array<double, 2> delta = {0, up};
    curve::PointEdit edit;
    edit.level = level;
    edit.u = kMiddle;
    edit.delta = delta;
    edit.drag = drag;
    return curve::drag_point(parts, edit).value();
}

double share_beyond_half(const std::vector<double>& moved) {
    const double half = std::ranges::max(moved) / 2;
    const auto beyond =
        std::ranges::count_if(moved, [&](double distance) { return distance > half; });
    return double(beyond) / double(moved.size());
}

PulledAtLevel pull(const Points& original, double level) {
    const curve::MultiresCurve parts = curve::decompose(original, curve::Ends::kOpen);
    PulledAtLevel result;
    result.level = level;
    for (const double part : {1.0 / 3, 2.0 / 3, 1.0}) {
        curve::Edited edited = drag(parts, level, part * kUp, curve::Drag::kFull);
        result.affected = edited.affected;
        result.missed = std::max(
            result.missed, std::hypot(edited.moved[0], edited.moved[1] - part * kUp));
        result.pulled.push_back(std::move(edited.control));
    }
    result.half_width = share_beyond_half(distances(original, result.pulled.back()));
    result.overshoot = drag(parts, level, kUp, curve::Drag::kSmooth).moved[1] / kUp;
    return result;
}

std::vector<PulledAtLevel> pull(const Points& original,
                                std::initializer_list<double> levels) {
    std::vector<PulledAtLevel> result;
    for (const double level : levels) result.push_back(pull(original, level));
    return result;
}

std::string drawn(const Figure36& figure, const std::vector<PulledAtLevel>& pulls) {
    Box box = box_of({figure.original}, 20);
    box.top += kUp;
    std::vector<std::string> drawings;
    for (const PulledAtLevel& at : pulls) {
        CurveDrawing drawing("Level " + number(at.level, 1), box);
        for (const Points& pulled : at.pulled) drawing.curve(pulled, 0, Ink::kFine);
        drawing.curve(figure.original, 9, Ink::kPlain);
        drawings.push_back(drawing.svg());
    }
    return small_panels(drawings);
}

}  // namespace

Figure36 measure_figure_3_6() {
    Figure36 figure;
    figure.original = trembling_line();
    figure.integer = pull(figure.original, {1, 2, 3, 4});
    figure.fractional = pull(figure.original, {2.2, 2.4, 2.6, 2.8});
    return figure;
}

std::string to_html(const Figure36& figure) {
    HtmlTable table({"level",
                     "u from",
                     "u to",
                     "u moved by more than half",
                     "missed by",
                     "smoothed curve dragged: f^n goes"},
                    1);
    for (const auto* pulls : {&figure.integer, &figure.fractional}) {
        for (const PulledAtLevel& at : *pulls) {
            table.add({number(at.level, 1),
                       number(at.affected.from, 4),
                       number(at.affected.to, 4),
                       number(100 * at.half_width, 1) + " %",
                       scientific(at.missed, 1),
                       number(100 * at.overshoot, 2) + " %"});
        }
    }
    return paragraph(
               "The middle of the dark curve is pulled up by " + number(-kUp, 0) +
               " in three steps. Upper row: integer levels; lower row: between 2 and 3, "
               "where the part "
               "that moves narrows from that of level 2 to that of level 3. The point of "
               "the curve itself "
               "is dragged and arrives exactly; where that of the smoothed curve is "
               "dragged, the curve "
               "overshoots at fractional levels, by the percentage in the last column.") +
           drawn(figure, figure.integer) + drawn(figure, figure.fractional) +
           table.html();
}

}  // namespace haarmony::eval
