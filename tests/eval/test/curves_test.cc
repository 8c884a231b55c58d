// The curve figures: what their numbers promise, and the page as a whole.
#include "tests/eval/curves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "engine/curve/bspline.h"
#include "engine/curve/level.h"
#include "tests/eval/curve_distance.h"
#include "tests/eval/curve_strokes.h"
#include "tests/eval/curve_svg.h"
#include "tests/eval/figure_3_10.h"
#include "tests/eval/figure_3_13.h"
#include "tests/eval/figure_3_4.h"
#include "tests/eval/figure_3_5.h"
#include "tests/eval/figure_3_6.h"
#include "tests/eval/figure_3_7.h"
#include "tests/eval/figure_3_8.h"
#include "tests/eval/figure_3_9.h"
#include "tests/eval/test/xml_reader.h"

namespace haarmony::eval {
namespace {

using curve::Ends;
using curve::Points;

// What rounding may leave of coordinates up to 1000 through eight levels.
constexpr double kRounding = 1e-9;

bool is_finite(const Points& points) {
    return std::ranges::all_of(points.numbers(),
                               [](double n) { return std::isfinite(n); });
}

TEST(CurveStrokes, AreOfTheirLevelAndTheSameEveryTime) {
    for (const auto stroke :
         {profile_stroke, arch_stroke, trembling_line, uneven_stroke, pen_stroke}) {
        const Points control = stroke();
        EXPECT_EQ(curve::level_of(control.size(), Ends::kOpen), kStrokeLevel);
        EXPECT_TRUE(is_finite(control));
        EXPECT_EQ(control, stroke());
    }
    for (const DrawingPart& part : landscape()) {
        EXPECT_EQ(curve::level_of(part.sweep.size(), Ends::kOpen), kStrokeLevel)
            << part.name;
        EXPECT_TRUE(is_finite(part.sweep)) << part.name;
    }
}

TEST(Figure34, SmootherVersionsAreFurtherFromTheOriginal) {
    const Figure34 figure = measure_figure_3_4();
    ASSERT_EQ(figure.versions.size(), 4U);
    EXPECT_EQ(figure.versions[0].level, 8);
    EXPECT_LT(figure.versions[0].distance.largest, kRounding);
    EXPECT_EQ(figure.versions[1].level, 5.4);
    EXPECT_EQ(figure.versions[1].control.size(), 67U);  // 2^6 + 3
    EXPECT_EQ(figure.versions[2].level, 3.1);
    EXPECT_EQ(figure.versions[2].control.size(), 19U);  // 2^4 + 3
    EXPECT_GT(figure.versions[1].distance.rms, kRounding);
    EXPECT_GT(figure.versions[2].distance.rms, figure.versions[1].distance.rms);
    // The projection moves ends; pinned ones stay, at the cost of the mean square.
    EXPECT_GT(figure.versions[2].end_moved, 0.1);
    EXPECT_TRUE(figure.versions[3].pinned);
    EXPECT_LT(figure.versions[3].end_moved, kRounding);
    EXPECT_GT(figure.versions[3].distance.rms, figure.versions[2].distance.rms);
}

TEST(Figure35, TheSweepIsTheNewOneAndTheCharacterTheOld) {
    const Figure35 figure = measure_figure_3_5();
    EXPECT_LT(figure.sweep_error, kRounding);
    EXPECT_LT(figure.character_error, kRounding);
    EXPECT_GT(figure.largest_detail, 0.1);
    EXPECT_EQ(figure.sweep.size(), 7U);
    EXPECT_NE(figure.sweep, figure.changed_sweep);
    EXPECT_NE(figure.original, figure.edited);
}

TEST(Figure36, HigherLevelsMoveLess) {
    const Figure36 figure = measure_figure_3_6();
    ASSERT_EQ(figure.integer.size(), 4U);
    ASSERT_EQ(figure.fractional.size(), 4U);
    for (const auto* pulls : {&figure.integer, &figure.fractional}) {
        for (std::size_t i = 0; i < pulls->size(); ++i) {
            const PulledAtLevel& at = (*pulls)[i];
            EXPECT_LT(at.missed, kRounding) << at.level;
            EXPECT_EQ(at.pulled.size(), 3U);
            // Pulled at the middle, both halves go the same way.
            const std::vector<double> moved =
                distances(figure.original, at.pulled.back());
            for (std::size_t k = 0; k < moved.size() / 2; ++k)
                ASSERT_NEAR(moved[k], moved[moved.size() - 1 - k], kRounding) << at.level;
            if (at.level == std::floor(at.level)) {
                EXPECT_NEAR(at.overshoot, 1, kRounding) << at.level;
            } else {
                EXPECT_GT(at.overshoot, 1.001) << at.level;
                EXPECT_LT(at.overshoot, 1.1) << at.level;
            }
            if (i > 0) {
                EXPECT_LT(at.half_width, (*pulls)[i - 1].half_width) << at.level;
            }
        }
    }
    EXPECT_LT(figure.fractional.front().half_width, figure.integer[1].half_width);
    EXPECT_GT(figure.fractional.back().half_width, figure.integer[2].half_width);
}

TEST(Figure37, APortionIsAsLongWhereverItLies) {
    const Figure37 figure = measure_figure_3_7();
    ASSERT_EQ(figure.pulls.size(), 4U);
    const PortionPull& left_level = figure.pulls[0];
    const PortionPull& right_level = figure.pulls[1];
    EXPECT_EQ(left_level.level, right_level.level);
    EXPECT_GT(right_level.affected, 2 * left_level.affected);
    EXPECT_GT(right_level.moved, 2 * left_level.moved);
    for (const PortionPull& pull : {figure.pulls[2], figure.pulls[3]}) {
        EXPECT_NEAR(pull.affected, pull.wanted, 1e-6);
        EXPECT_LT(pull.moved, pull.wanted * 1.5);
        EXPECT_GT(pull.moved, pull.wanted / 4);
    }
    EXPECT_LT(figure.pulls[2].level, figure.pulls[3].level);
}

TEST(Figure38, CharactersLeaveTheSweepAlone) {
    const Figure38 figure = measure_figure_3_8();
    EXPECT_GE(figure.characters.size(), 5U);
    for (const WithCharacter& with : figure.characters) {
        EXPECT_LT(with.sweep_error, kRounding) << with.character;
        if (with.character == "smooth") {
            EXPECT_LT(with.distance, kRounding);
        } else {
            EXPECT_GT(with.distance, 1) << with.character;
        }
    }
    ASSERT_EQ(figure.drawings.size(), 4U);
    std::set<std::string> hands;
    for (const DrawnPart& part : figure.drawings.back()) hands.insert(part.character);
    EXPECT_GE(hands.size(), 5U);
}

TEST(Figure39, OnlyFramesOfTheCurveTurnAndOnlyUnnormalisedOnesGrow) {
    const Figure39 figure = measure_figure_3_9();
    ASSERT_EQ(figure.edited.size(), 3U);
    const Oriented& fixed = figure.edited[0];
    const Oriented& normalised = figure.edited[1];
    const Oriented& unnormalised = figure.edited[2];
    EXPECT_LT(fixed.turned_degrees, 1e-6);
    EXPECT_GT(normalised.turned_degrees, 30);
    EXPECT_GT(unnormalised.turned_degrees, 30);
    for (const Oriented* oriented : {&fixed, &normalised}) {
        EXPECT_NEAR(oriented->least_growth, 1, 1e-6);
        EXPECT_NEAR(oriented->most_growth, 1, 1e-6);
    }
    EXPECT_GT(unnormalised.most_growth, 1.2);
}

TEST(CurveDistance, IsThatOfTheCurvesWhateverTheirLevels) {
    // A straight line of even speed, and the same line moved by (3, 4).
    Points line(4, 2);
    Points moved(4, 2);
    for (std::size_t i = 0; i < 4; ++i) {
        line[i][0] = 10.0 * double(i);
        moved[i][0] = 10.0 * double(i) + 3;
        moved[i][1] = 4;
    }
    const Points fine = refined_to(line, 3);
    EXPECT_EQ(fine.size(), 11U);
    EXPECT_LT(distance_between(line, fine).largest, 1e-12);
    const CurveDistance distance = distance_between(moved, fine);
    EXPECT_NEAR(distance.largest, 5, 1e-12);
    EXPECT_NEAR(distance.rms, 5, 1e-12);
    EXPECT_EQ(distances(line, fine).size(), 8 * kSamplesEach + 1);
    EXPECT_EQ(largest_difference(line, moved), 4);
}

TEST(CurveDrawing, PlacesThePageInItsView) {
    Points line(4, 2);
    for (std::size_t i = 0; i < 4; ++i) line[i][0] = 100.0 * double(i);
    const Box box = box_of({line}, 30);
    EXPECT_EQ(box.left, -30);
    EXPECT_EQ(box.right, 330);
    EXPECT_EQ(box.top, -30);
    EXPECT_EQ(box.bottom, 30);
    CurveDrawing drawing("a < b", box);  // one unit to a unit, below the heading
    drawing.curve(line, 0, Ink::kPlain);
    const std::string svg = drawing.svg();
    EXPECT_EQ(read_xml(svg).error, "");
    EXPECT_NE(svg.find("d=\"M30,54C130,54 230,54 330,54\""), std::string::npos) << svg;
    CurveDrawing small("a", box, 36);
    small.curve(line, 0, Ink::kPlain);
    EXPECT_NE(small.svg().find("d=\"M3,3C13,3 23,3 33,3\""), std::string::npos);
    EXPECT_NE(small.svg().find("width=\"36\""), std::string::npos);
}

TEST(CurveDrawing, OnlyGapsStartASubpath) {
    Points bezier(12, 2);
    for (std::size_t i = 0; i < 12; ++i) bezier[i][0] = double(i) - (i >= 4 ? 1 : 0);
    CurveDrawing drawing("three segments, the last apart", {0, 0, 360, 10});
    drawing.segments(bezier, 0, Ink::kPlain);
    EXPECT_NE(drawing.svg().find("d=\"M0,24C1,24 2,24 3,24C4,24 5,24 6,24M7,24C"),
              std::string::npos)
        << drawing.svg();
}

TEST(CurveDrawing, RibbonsAreAsThickAsTheThirdNumberSays) {
    Points bezier(4, 3);
    for (std::size_t i = 0; i < 4; ++i) {
        bezier[i][0] = 10.0 * double(i);
        bezier[i][2] = 4;
    }
    CurveDrawing drawing("a bar", {0, -5, 360, 5});
    drawing.ribbon(bezier, 0);
    const std::string svg = drawing.svg();
    EXPECT_NE(svg.find("points=\"0,31 "), std::string::npos) << svg;
    EXPECT_NE(svg.find(" 15,31 "), std::string::npos) << svg;
    EXPECT_NE(svg.find(" 30,31 30,27 "), std::string::npos) << svg;
    EXPECT_NE(svg.find(" 15,27 "), std::string::npos) << svg;
    EXPECT_NE(svg.find(" 0,27\""), std::string::npos) << svg;
}

// Distances from points of the segments to the nearest of points of the curve, and back.
double sampled_hausdorff(const Points& bezier, const Points& control) {
    const auto sampled = [](const Points& rows, int each) {
        std::vector<std::vector<double>> places;
        for (std::size_t first = 0; first < rows.size(); first += 4) {
            for (int i = 0; i <= each; ++i)
                places.push_back(segment_point(rows, first, double(i) / each).place);
        }
        return places;
    };
    const Points own = segments_of(control);
    const int each = static_cast<int>(4 * own.size() / bezier.size());
    const auto a = sampled(bezier, each);
    const auto b = sampled(own, 4);
    double farthest = 0;
    for (const auto* from : {&a, &b}) {
        for (const std::vector<double>& p : *from) {
            double nearest = INFINITY;
            for (const std::vector<double>& q : from == &a ? b : a)
                nearest = std::min(nearest, std::hypot(p[0] - q[0], p[1] - q[1]));
            farthest = std::max(farthest, nearest);
        }
    }
    return farthest;
}

TEST(Figure310, EveryStrokeKeepsItsBoundAndLargerSizesNeedMoreSegments) {
    const Figure310 figure = measure_figure_3_10();
    ASSERT_EQ(figure.drawings.size(), 3 * kSizesPx.size());
    const std::vector<DrawnPart> parts = drawn_landscape();
    std::map<curve::Joining, std::size_t> before;
    for (const ApproximatedDrawing& drawing : figure.drawings) {
        EXPECT_EQ(drawing.tolerance, 500.0 / drawing.size_px);
        ASSERT_EQ(drawing.strokes.size(), parts.size());
        for (const ApproximatedStroke& stroke : drawing.strokes) {
            const curve::Approximation& approximation = stroke.approximation;
            EXPECT_LE(approximation.max_error, approximation.bound) << stroke.name;
            EXPECT_LE(approximation.bound, drawing.tolerance) << stroke.name;
            EXPECT_EQ(approximation.possible, 256U) << stroke.name;
            EXPECT_TRUE(is_finite(approximation.bezier)) << stroke.name;
        }
        EXPECT_GT(drawing.count(), before[drawing.joining]) << drawing.size_px;
        before[drawing.joining] = drawing.count();
        EXPECT_LT(drawing.count(), drawing.possible());
    }
    EXPECT_LT(before.at(curve::Joining::kG1), before.at(curve::Joining::kDyadic));

    // The second method: samples, whose steps are allowed for.
    const ApproximatedDrawing& smallest = figure.drawings[2];
    ASSERT_EQ(smallest.joining, curve::Joining::kG1);
    for (std::size_t i : {0U, 3U}) {
        const double sampled =
            sampled_hausdorff(smallest.strokes[i].approximation.bezier, parts[i].control);
        EXPECT_LT(sampled, smallest.tolerance + 2) << parts[i].name;
    }
}

TEST(Figure313, PlaceAndThicknessAreEditedApart) {
    const Figure313 figure = measure_figure_3_13();
    EXPECT_EQ(figure.original.dimension(), 3);
    EXPECT_LT(figure.thickness_of_bent, kRounding);
    EXPECT_LT(figure.place_of_pressed, kRounding);
    EXPECT_LT(figure.missed_pressing, kRounding);
    EXPECT_LT(figure.thickness_of_scribbled, kRounding);
    EXPECT_LE(figure.max_error, figure.bound);
    EXPECT_LE(figure.bound, figure.tolerance);
    EXPECT_LT(figure.approximated.size() / 4, figure.possible / 4);
    EXPECT_EQ(figure.approximated.dimension(), 3);
    EXPECT_LT(figure.carried_error, kRounding);
}

TEST(SegmentsOf, AreTheCurve) {
    const Points control = pen_stroke();
    const Points bezier = segments_of(control);
    ASSERT_EQ(bezier.size(), 4U * 256);
    for (const std::size_t segment : {0U, 100U, 255U}) {
        const SegmentPoint point = segment_point(bezier, 4 * segment, 0.25);
        const double u = (double(segment) + 0.25) / 256;
        const std::vector<double> place = curve::point_at(control, Ends::kOpen, u);
        const std::vector<double> slope = curve::slope_at(control, Ends::kOpen, u);
        for (std::size_t d = 0; d < 3; ++d) {
            EXPECT_NEAR(point.place[d], place[d], kRounding);
            EXPECT_NEAR(point.slope[d] * 256, slope[d], 1e-6);
        }
    }
}

class CurvePage : public ::testing::Test {
  protected:
    static const std::vector<OutputFile>& files() {
        static const std::vector<OutputFile> made = make_curve_figures();
        return made;
    }
};

TEST_F(CurvePage, IsWellFormedHasEveryFigureAndNeedsNothingFromElsewhere) {
    ASSERT_EQ(files().size(), 2U);
    EXPECT_EQ(files()[0].name, "curves.html");
    const std::string& html = files()[0].text;
    const XmlReading page = read_xml(html.substr(html.find('\n') + 1));
    EXPECT_EQ(page.error, "");
    EXPECT_EQ(page.attributes.at("id"),
              (std::vector<std::string>{"figure-3-4",
                                        "figure-3-5",
                                        "figure-3-6",
                                        "figure-3-7",
                                        "figure-3-8",
                                        "figure-3-9",
                                        "figure-3-10",
                                        "figure-3-11",
                                        "figure-3-13"}));
    EXPECT_EQ(page.elements.at("svg"), 4 + 4 + 8 + 5 + 7 + 4 + 4 + 8 + 8 + 6);
    EXPECT_EQ(page.elements.at("table"), 8);
    EXPECT_EQ(page.elements.count("script"), 0U);
    EXPECT_EQ(page.attributes.count("src"), 0U);
    EXPECT_EQ(html.find("http"), std::string::npos);
    EXPECT_EQ(html.find("nan"), std::string::npos);
    EXPECT_EQ(html.find(">inf"), std::string::npos);
}

TEST_F(CurvePage, TheTableHasARowForEachStrokeSizeAndMode) {
    EXPECT_EQ(files()[1].name, "curves_approximation.csv");
    std::istringstream lines(files()[1].text);
    std::string line;
    ASSERT_TRUE(std::getline(lines, line));
    EXPECT_EQ(line,
              "stroke,character,size_px,mode,tolerance,count,possible,bound,max_error");
    std::size_t rows = 0;
    while (std::getline(lines, line)) {
        ++rows;
        EXPECT_EQ(std::ranges::count(line, ','), 8) << line;
        EXPECT_EQ(line.find("nan"), std::string::npos) << line;
        EXPECT_EQ(line.find("inf"), std::string::npos) << line;
    }
    EXPECT_EQ(rows, landscape().size() * kSizesPx.size() * 3);
}

}  // namespace
}  // namespace haarmony::eval
