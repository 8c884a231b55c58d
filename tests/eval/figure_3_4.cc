#include "tests/eval/figure_3_4.h"

#include <algorithm>
#include <cmath>

#include "engine/curve/multires_curve.h"
#include "engine/curve/smooth.h"
#include "tests/eval/csv.h"
#include "tests/eval/curve_strokes.h"
#include "tests/eval/curve_svg.h"
#include "tests/eval/page.h"

namespace haarmony::eval {
namespace {

std::string name_of(const SmoothedVersion& version) {
    return number(version.level, 1) +
           (version.level == std::floor(version.level) ? ".0" : "") +
           (version.pinned ? ", ends pinned" : "");
}

}  // namespace

Figure34 measure_figure_3_4() {
    Figure34 figure;
    figure.original = profile_stroke();
    const curve::MultiresCurve parts =
        curve::decompose(figure.original, curve::Ends::kOpen);
    struct Wanted {
        double level;
        bool pinned;
    };
    for (const Wanted wanted :
         {Wanted{8, false}, Wanted{5.4, false}, Wanted{3.1, false}, Wanted{3.1, true}}) {
        SmoothedVersion version;
        version.level = wanted.level;
        version.pinned = wanted.pinned;
        version.control = curve::smooth(
            parts,
            wanted.level,
            wanted.pinned ? curve::SmoothedEnds::kPinned : curve::SmoothedEnds::kFree);
        version.distance = distance_between(figure.original, version.control);
        const std::vector<double> all = distances(figure.original, version.control);
        version.end_moved = std::max(all.front(), all.back());
        figure.versions.push_back(std::move(version));
    }
    return figure;
}

std::string to_html(const Figure34& figure) {
    std::vector<curve::Points> all;
    for (const SmoothedVersion& version : figure.versions) all.push_back(version.control);
    const Box box = box_of(all, 10);
    std::vector<std::string> drawings;
    HtmlTable table({"level", "control points", "rms distance", "largest", "ends moved"},
                    1);
    for (const SmoothedVersion& version : figure.versions) {
        CurveDrawing drawing("Level " + name_of(version), box);
        drawing.curve(figure.original, 9, Ink::kGhost);
        drawing.curve(version.control, 0, Ink::kPlain);
        drawings.push_back(drawing.svg());
        table.add({name_of(version),
                   std::to_string(version.control.size()),
                   number(version.distance.rms, 3),
                   number(version.distance.largest, 3),
                   number(version.end_moved, 3)});
    }
    return paragraph(
               "The original of level 8 (grey) and what is left of it (blue) at lower "
               "real "
               "levels: the least squares fit of each whole level, blended between two. "
               "A projection moves the ends; they can be pinned. Distances are at equal "
               "u, "
               "on a page about 400 wide and 700 high.") +
           small_panels(drawings) + table.html();
}

}  // namespace haarmony::eval
