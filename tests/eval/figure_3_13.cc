#include "tests/eval/figure_3_13.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/curve/approximate.h"
#include "engine/curve/bspline.h"
#include "engine/curve/built_in_character.h"
#include "engine/curve/character.h"
#include "engine/curve/direct_edit.h"
#include "engine/curve/smooth.h"
#include "tests/eval/csv.h"
#include "tests/eval/curve_distance.h"
#include "tests/eval/curve_strokes.h"
#include "tests/eval/curve_svg.h"
#include "tests/eval/page.h"

namespace haarmony::eval {
namespace {

using curve::Ends;
using curve::Points;

constexpr double kSmoothLevel = 2.5;
constexpr double kBendLevel = 2;
constexpr double kPressLevel = 3;
// The character: finer than the stroke's own shape, and half as strong.
constexpr int kCharacterLevel = 4;
constexpr double kStrength = 0.5;
constexpr std::array<double, 3> kBend = {0, 190, 0};
constexpr std::array<double, 3> kPress = {0, 0, 30};
constexpr double kBendAt = 0.75;
constexpr double kPressAt = 0.5;

Points dragged(const curve::MultiresCurve& parts,
               double level,
               double u,
               const std::array<double, 3>& delta) {
    curve::PointEdit edit;
    edit.level = level;
    edit.u = u;
    edit.delta = delta;
    edit.drag = curve::Drag::kFull;
    return curve::drag_point(parts, edit).value().control;
}

// The largest difference of two curves of one level in the numbers from `first` up to `last`.
double largest_change(const Points& a,
                      const Points& b,
                      std::size_t first,
                      std::size_t last) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t d = first; d < last; ++d)
            largest = std::max(largest, std::abs(a[i][d] - b[i][d]));
    }
    return largest;
}

double squared(std::span<const double> a, std::span<const double> b) {
    return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]);
}

// Every joint is one of the curve's own knots; they come in the same order.
double largest_carried_error(const Points& bezier, const Points& original) {
    const Points chain = curve::bezier_points(original, Ends::kOpen);
    double largest = 0;
    std::size_t knot = 0;
    for (std::size_t row = 3; row < bezier.size(); row += 4) {
        std::size_t best = knot + 3;
        for (std::size_t next = best; next < chain.size(); next += 3) {
            if (squared(chain[next], bezier[row]) < squared(chain[best], bezier[row]))
                best = next;
        }
        knot = best;
        largest = std::max(largest, std::abs(chain[knot][2] - bezier[row][2]));
    }
    return largest;
}

std::string range_of_thickness(const Points& control) {
    double low = INFINITY;
    double high = -INFINITY;
    for (std::size_t i = 0; i < control.size(); ++i) {
        low = std::min(low, control[i][2]);
        high = std::max(high, control[i][2]);
    }
    return number(low, 1) + " to " + number(high, 1);
}

}  // namespace

Figure313 measure_figure_3_13() {
    Figure313 figure;
    figure.original = pen_stroke();
    const curve::MultiresCurve parts = curve::decompose(figure.original, Ends::kOpen);
    figure.smoothed = curve::smooth(parts, kSmoothLevel, curve::SmoothedEnds::kFree);
    figure.bent = dragged(parts, kBendLevel, kBendAt, kBend);
    figure.pressed = dragged(parts, kPressLevel, kPressAt, kPress);
    const auto wiggly = curve::character_of(curve::built_in_character("wiggly")->stroke(),
                                            Ends::kOpen,
                                            curve::Frame::kUnnormalized);
    figure.scribbled =
        curve::give_character(parts, wiggly, kCharacterLevel, kStrength).value();
    figure.thickness_of_bent = largest_change(figure.original, figure.bent, 2, 3);
    figure.place_of_pressed = largest_change(figure.original, figure.pressed, 0, 2);
    figure.thickness_of_scribbled =
        largest_change(figure.original, figure.scribbled, 2, 3);
    figure.missed_pressing =
        std::abs(curve::point_at(figure.pressed, Ends::kOpen, kPressAt)[2] -
                 curve::point_at(figure.original, Ends::kOpen, kPressAt)[2] - kPress[2]);
    figure.tolerance = 1;
    const curve::Approximation approximation =
        curve::approximate(
            figure.original, Ends::kOpen, figure.tolerance, curve::Joining::kG1, {})
            .value();
    figure.approximated = approximation.bezier;
    figure.possible = approximation.possible;
    figure.bound = approximation.bound;
    figure.max_error = approximation.max_error;
    figure.carried_error = largest_carried_error(figure.approximated, figure.original);
    return figure;
}

std::string to_html(const Figure313& figure) {
    const Box box = box_of(
        {figure.original, figure.bent, figure.pressed, figure.smoothed, figure.scribbled},
        35);
    std::vector<std::string> drawings;
    const auto draw = [&](const std::string& title, const Points& bezier) {
        CurveDrawing drawing(title, box);
        drawing.ribbon(bezier, 0);
        drawings.push_back(drawing.svg());
    };
    draw("(a) The original", segments_of(figure.original));
    draw("(b) Smoothed to level " + number(kSmoothLevel, 1),
         segments_of(figure.smoothed));
    draw("(c) Its place dragged at level " + number(kBendLevel, 0),
         segments_of(figure.bent));
    draw("(d) Its thickness dragged at level " + number(kPressLevel, 0),
         segments_of(figure.pressed));
    draw("(e) With the character \"wiggly\"", segments_of(figure.scribbled));
    draw("(f) Approximated, g1: " + std::to_string(figure.approximated.size() / 4) +
             " segments of " + std::to_string(figure.possible),
         figure.approximated);

    HtmlTable table({"what", "value"}, 1);
    table.add({"thickness of (a), of (b), of (d)",
               range_of_thickness(figure.original) + ", " +
                   range_of_thickness(figure.smoothed) + ", " +
                   range_of_thickness(figure.pressed)});
    table.add(
        {"(c): largest change of thickness", scientific(figure.thickness_of_bent, 1)});
    table.add({"(d): largest change of place", scientific(figure.place_of_pressed, 1)});
    table.add({"(d): thickness at the middle, beside what was asked for",
               scientific(figure.missed_pressing, 1)});
    table.add({"(e): largest change of thickness",
               scientific(figure.thickness_of_scribbled, 1)});
    table.add({"(f): tolerance, bound, error in x and y",
               number(figure.tolerance, 3) + ", " + number(figure.bound, 4) + ", " +
                   number(figure.max_error, 4)});
    table.add({"(f): largest error of thickness where segments meet",
               scientific(figure.carried_error, 1)});
    return paragraph(
               "A stroke of x, y and thickness. Everything works on all three numbers; "
               "an "
               "edit of the place leaves the thickness alone and the other way round, "
               "and a "
               "character of two dimensions leaves the third as it was.") +
           panels(drawings) + table.html();
}

}  // namespace haarmony::eval
