#include "tests/eval/figure_3_8.h"

#include <string_view>
#include <utility>

#include "engine/curve/built_in_character.h"
#include "engine/curve/character.h"
#include "tests/eval/csv.h"
#include "tests/eval/curve_distance.h"
#include "tests/eval/curve_strokes.h"
#include "tests/eval/curve_svg.h"
#include "tests/eval/page.h"

namespace haarmony::eval {
namespace {

using curve::Ends;
using curve::Points;

// Requires: `name` is built in.
Points with_character(const Points& sweep, std::string_view name, int from_level) {
    const Points stroke = curve::built_in_character(name)->stroke();
    const auto character =
        curve::character_of(stroke, Ends::kOpen, curve::Frame::kUnnormalized);
    return curve::give_character(
               curve::decompose(sweep, Ends::kOpen), character, from_level, 1)
        .value();
}

// Every part with one character; with its own where that is "".
std::vector<DrawnPart> landscape_in(std::string_view character) {
    std::vector<DrawnPart> parts;
    for (const DrawingPart& part : landscape()) {
        const std::string_view name = character.empty() ? part.character : character;
        parts.push_back({std::string(part.name),
                         std::string(name),
                         with_character(part.sweep, name, part.from_level)});
    }
    return parts;
}

}  // namespace

std::vector<DrawnPart> drawn_landscape() { return landscape_in(""); }

Figure38 measure_figure_3_8() {
    Figure38 figure;
    figure.sweep = arch_stroke();
    const Points sweep =
        curve::reconstruct(curve::decompose(figure.sweep, Ends::kOpen), kCharacterLevel);
    for (const curve::BuiltInCharacter& built_in : curve::built_in_characters()) {
        WithCharacter with;
        with.character = built_in.name;
        with.control = with_character(figure.sweep, built_in.name, kCharacterLevel);
        with.sweep_error = largest_difference(
            curve::reconstruct(curve::decompose(with.control, Ends::kOpen),
                               kCharacterLevel),
            sweep);
        with.distance = distance_between(with.control, sweep).largest;
        figure.characters.push_back(std::move(with));
    }
    for (const char* character : {"smooth", "rough", "loose", ""})
        figure.drawings.push_back(landscape_in(character));
    return figure;
}

std::string to_html(const Figure38& figure) {
    std::vector<Points> all;
    for (const WithCharacter& with : figure.characters) all.push_back(with.control);
    const Box box = box_of(all, 15);
    std::vector<std::string> strokes;
    HtmlTable table(
        {"character", "control points", "sweep changed by", "largest distance"}, 1);
    for (const WithCharacter& with : figure.characters) {
        CurveDrawing drawing(with.character, box);
        drawing.curve(with.control, 0, Ink::kPlain);
        strokes.push_back(drawing.svg());
        table.add({with.character,
                   std::to_string(with.control.size()),
                   scientific(with.sweep_error, 1),
                   number(with.distance, 2)});
    }
    std::vector<std::string> drawings;
    for (const std::vector<DrawnPart>& parts : figure.drawings) {
        const bool one_hand = parts.front().character == parts.back().character;
        CurveDrawing drawing(
            one_hand ? "all of it " + parts.front().character : "to each its own",
            {0, 0, 1000, 720});
        for (const DrawnPart& part : parts) drawing.curve(part.control, 0, Ink::kFine);
        drawings.push_back(drawing.svg());
    }
    return paragraph(
               "One sweep, of level " + std::to_string(kCharacterLevel) +
               ", with the details of every built-in character from there on, in frames "
               "that turn and grow with the curve (unnormalised, as in the "
               "dissertation's "
               "figure). The sweep stays what it was, to rounding.") +
           small_panels(strokes) + table.html() +
           paragraph("A drawing of nine strokes in four hands.") + small_panels(drawings);
}

}  // namespace haarmony::eval
