#include "tests/eval/figure_3_5.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "engine/curve/affected.h"
#include "engine/curve/built_in_character.h"
#include "engine/curve/character.h"
#include "engine/curve/sweep_edit.h"
#include "tests/eval/csv.h"
#include "tests/eval/curve_distance.h"
#include "tests/eval/curve_strokes.h"
#include "tests/eval/curve_svg.h"
#include "tests/eval/page.h"

namespace haarmony::eval {
namespace {

using curve::Ends;
using curve::Frame;
using curve::Points;

struct Pull {
    std::size_t index;
    std::array<double, 2> delta;
};
constexpr std::array<Pull, 3> kPulls = {{{1, {0, -130}}, {3, {0, 220}}, {5, {0, -170}}}};

Points looping_arch() {
    const Points loops = curve::built_in_character("loose")->stroke();
    const auto character = curve::character_of(loops, Ends::kOpen, Frame::kUnnormalized);
    return curve::give_character(
               curve::decompose(arch_stroke(), Ends::kOpen), character, 3, 1)
        .value();
}

}  // namespace

Figure35 measure_figure_3_5() {
    Figure35 figure;
    figure.original = looping_arch();
    const curve::MultiresCurve parts = curve::decompose(figure.original, Ends::kOpen);
    figure.sweep = curve::reconstruct(parts, kSweepLevel);
    figure.changed_sweep = figure.sweep;
    figure.edited = figure.original;
    for (const Pull& pull : kPulls) {
        curve::ControlEdit edit;
        edit.level = kSweepLevel;
        edit.index = pull.index;
        edit.delta = pull.delta;
        edit.frame = Frame::kNormalized;
        figure.edited =
            curve::edit_sweep(curve::decompose(figure.edited, Ends::kOpen), edit)
                .value()
                .control;
        for (std::size_t d = 0; d < 2; ++d)
            figure.changed_sweep[pull.index][d] += pull.delta[d];
    }
    const curve::MultiresCurve edited = curve::decompose(figure.edited, Ends::kOpen);
    figure.sweep_error =
        largest_difference(curve::reconstruct(edited, kSweepLevel), figure.changed_sweep);
    const auto before = curve::to_local(parts, Frame::kNormalized);
    const auto after = curve::to_local(edited, Frame::kNormalized);
    for (std::size_t level = kSweepLevel; level < before.details.size(); ++level) {
        figure.character_error =
            std::max(figure.character_error,
                     largest_difference(before.details[level], after.details[level]));
        figure.largest_detail = std::max(figure.largest_detail,
                                         curve::coordinate_size(before.details[level]));
    }
    return figure;
}

std::string to_html(const Figure35& figure) {
    const Box box = box_of({figure.original, figure.changed_sweep, figure.edited}, 40);
    CurveDrawing original("(a) The original", box);
    original.curve(figure.original, 0, Ink::kPlain);
    CurveDrawing sweep("(b) Its sweep, level 2", box);
    sweep.curve(figure.original, 9, Ink::kGhost);
    sweep.curve(figure.sweep, 2, Ink::kPlain);
    CurveDrawing changed("(c) The sweep changed", box);
    changed.curve(figure.sweep, 9, Ink::kGhost);
    changed.curve(figure.changed_sweep, 2, Ink::kPlain);
    for (const Pull& pull : kPulls) {
        const auto from = figure.sweep[pull.index];
        changed.arrow(from[0], from[1], pull.delta[0], pull.delta[1], 1);
    }
    CurveDrawing edited("(d) The details on the new sweep", box);
    edited.curve(figure.changed_sweep, 9, Ink::kGhost);
    edited.curve(figure.edited, 0, Ink::kPlain);

    HtmlTable table({"what", "value"}, 1);
    table.add({"control points of the sweep, of the curve",
               std::to_string(figure.sweep.size()) + ", " +
                   std::to_string(figure.original.size())});
    table.add({"control points pulled", std::to_string(kPulls.size())});
    table.add({"sweep of (d) beside (c), largest difference",
               scientific(figure.sweep_error, 1)});
    table.add({"details of (d) beside (a), in their frames, largest difference",
               scientific(figure.character_error, 1)});
    table.add({"largest detail of (a)", number(figure.largest_detail, 3)});
    return paragraph(
               "Three control points of level 2 are pulled (red: from where to where); "
               "the "
               "loops follow in frames that turn with the curve (normalised).") +
           small_panels({original.svg(), sweep.svg(), changed.svg(), edited.svg()}) +
           table.html();
}

}  // namespace haarmony::eval
