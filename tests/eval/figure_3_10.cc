#include "tests/eval/figure_3_10.h"

#include <algorithm>
#include <utility>

#include "tests/eval/curve_svg.h"
#include "tests/eval/figure_3_8.h"
#include "tests/eval/page.h"

namespace haarmony::eval {
namespace {

using curve::Joining;

constexpr double kPageWidth = 1000;
constexpr Box kPage = {0, 0, kPageWidth, 720};
constexpr std::array kJoinings = {Joining::kDyadic, Joining::kC0, Joining::kG1};

const char* name_of(Joining joining) {
    switch (joining) {
        case Joining::kDyadic:
            return "dyadic";
        case Joining::kC0:
            return "c0";
        default:
            return "g1";
    }
}

std::string percent(std::size_t part, std::size_t whole) {
    return number(100 * double(part) / double(whole), 1) + " %";
}

}  // namespace

std::size_t ApproximatedDrawing::count() const {
    std::size_t sum = 0;
    for (const ApproximatedStroke& stroke : strokes) sum += stroke.approximation.count();
    return sum;
}

std::size_t ApproximatedDrawing::possible() const {
    std::size_t sum = 0;
    for (const ApproximatedStroke& stroke : strokes) sum += stroke.approximation.possible;
    return sum;
}

double ApproximatedDrawing::bound() const {
    double worst = 0;
    for (const ApproximatedStroke& stroke : strokes)
        worst = std::max(worst, stroke.approximation.bound);
    return worst;
}

double ApproximatedDrawing::max_error() const {
    double worst = 0;
    for (const ApproximatedStroke& stroke : strokes)
        worst = std::max(worst, stroke.approximation.max_error);
    return worst;
}

Figure310 measure_figure_3_10() {
    Figure310 figure;
    const std::vector<DrawnPart> parts = drawn_landscape();
    for (const int size_px : kSizesPx) {
        for (const Joining joining : kJoinings) {
            ApproximatedDrawing drawing;
            drawing.size_px = size_px;
            drawing.joining = joining;
            drawing.tolerance = kTolerancePx * kPageWidth / size_px;
            for (const DrawnPart& part : parts) {
                drawing.strokes.push_back(
                    {part.name,
                     part.character,
                     curve::approximate(
                         part.control, curve::Ends::kOpen, drawing.tolerance, joining, {})
                         .value()});
            }
            figure.drawings.push_back(std::move(drawing));
        }
    }
    return figure;
}

std::string sizes_html(const Figure310& figure) {
    std::string html = paragraph(
        "A drawing of nine strokes of 256 segments each, at four sizes: every size has "
        "just "
        "the segments that a tolerance of half a pixel needs. Upper row: dyadic, the "
        "dissertation's algorithm; lower row: g1, segments merged as far as a proved "
        "bound "
        "allows.");
    for (const Joining joining : {Joining::kDyadic, Joining::kG1}) {
        std::vector<std::string> row;
        for (const ApproximatedDrawing& drawing : figure.drawings) {
            if (drawing.joining != joining) continue;
            CurveDrawing small(std::to_string(drawing.count()) + " segments, " +
                                   std::to_string(drawing.size_px) + " pixels",
                               kPage,
                               drawing.size_px);
            for (const ApproximatedStroke& stroke : drawing.strokes)
                small.segments(stroke.approximation.bezier, 0, Ink::kFine);
            row.push_back(small.svg());
        }
        html += in_a_row(row);
    }
    HtmlTable table({"mode",
                     "pixels",
                     "segments",
                     "of all",
                     "tolerance, px",
                     "bound, px",
                     "error, px"},
                    1);
    for (const Joining joining : kJoinings) {
        for (const ApproximatedDrawing& drawing : figure.drawings) {
            if (drawing.joining != joining) continue;
            const double scale = drawing.size_px / kPageWidth;
            table.add({name_of(joining),
                       std::to_string(drawing.size_px),
                       std::to_string(drawing.count()),
                       percent(drawing.count(), drawing.possible()),
                       number(drawing.tolerance * scale, 3),
                       number(drawing.bound() * scale, 4),
                       number(drawing.max_error() * scale, 4)});
        }
    }
    return html + table.html() +
           paragraph(
               "Bound and error are those of the worst stroke. For dyadic and c0 (the "
               "same, "
               "but segments meet) the error is the supremum of the distance at equal u, "
               "for "
               "g1 the two-sided Hausdorff distance. curves_approximation.csv has every "
               "stroke.");
}

std::string constant_size_html(const Figure310& figure) {
    std::string html = paragraph(
        "The same curves at one size, with dots (red) where segments begin and end: what "
        "was left out for the smaller sizes.");
    for (const Joining joining : {Joining::kDyadic, Joining::kG1}) {
        std::vector<std::string> row;
        for (const ApproximatedDrawing& drawing : figure.drawings) {
            if (drawing.joining != joining) continue;
            CurveDrawing large(std::string(name_of(joining)) + ", for " +
                                   std::to_string(drawing.size_px) + " pixels: " +
                                   std::to_string(drawing.count()) + " segments",
                               kPage);
            for (const ApproximatedStroke& stroke : drawing.strokes) {
                large.segments(stroke.approximation.bezier, 0, Ink::kFine);
                large.joints(stroke.approximation.bezier, 1);
            }
            row.push_back(large.svg());
        }
        html += small_panels(row);
    }
    return html;
}

CsvTable to_csv(const Figure310& figure) {
    CsvTable table({"stroke",
                    "character",
                    "size_px",
                    "mode",
                    "tolerance",
                    "count",
                    "possible",
                    "bound",
                    "max_error"});
    for (const ApproximatedDrawing& drawing : figure.drawings) {
        for (const ApproximatedStroke& stroke : drawing.strokes) {
            const curve::Approximation& approximation = stroke.approximation;
            table.add({stroke.name,
                       stroke.character,
                       drawing.size_px,
                       name_of(drawing.joining),
                       approximation.tolerance,
                       approximation.count(),
                       approximation.possible,
                       approximation.bound,
                       approximation.max_error});
        }
    }
    return table;
}

}  // namespace haarmony::eval
