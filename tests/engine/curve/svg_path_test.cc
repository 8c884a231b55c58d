#include "engine/curve/svg_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine/curve/elliptical_arc.h"

namespace haarmony::curve {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::HasSubstr;

std::vector<double> numbers(const SvgSubpath& subpath) {
    return {subpath.bezier.numbers().begin(), subpath.bezier.numbers().end()};
}

std::vector<SvgSubpath> read(std::string_view text) {
    Result<std::vector<SvgSubpath>> result = parse_svg_path(text);
    EXPECT_TRUE(result.has_value()) << text << ": " << result.error().message;
    return result ? *std::move(result) : std::vector<SvgSubpath>{};
}

std::string refusal(std::string_view text) {
    const Result<std::vector<SvgSubpath>> result = parse_svg_path(text);
    EXPECT_FALSE(result.has_value()) << text;
    if (result) return "";
    EXPECT_EQ(result.error().code, ErrorCode::kInvalidArgument);
    EXPECT_EQ(result.error().param, "d");
    return result.error().message;
}

void expect_same(std::string_view one, std::string_view other) {
    const std::vector<SvgSubpath> a = read(one);
    const std::vector<SvgSubpath> b = read(other);
    ASSERT_EQ(a.size(), b.size()) << one;
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].closed, b[i].closed) << one;
        ASSERT_EQ(a[i].bezier.size(), b[i].bezier.size()) << one;
        for (std::size_t k = 0; k < numbers(a[i]).size(); ++k)
            EXPECT_NEAR(numbers(a[i])[k], numbers(b[i])[k], 1e-9)
                << one << " number " << k;
    }
}

TEST(SvgPath, LinesAreCubicSegmentsWithThirdsBetween) {
    const std::vector<SvgSubpath> paths = read("M0 3L3 0");
    ASSERT_EQ(paths.size(), 1U);
    EXPECT_FALSE(paths[0].closed);
    EXPECT_THAT(numbers(paths[0]), ElementsAre(0, 3, 1, 2, 2, 1, 3, 0));
}

TEST(SvgPath, CubicSegmentsAreTakenAsTheyAre) {
    EXPECT_THAT(numbers(read("M1 2C3 4 5 6 7 8")[0]),
                ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
}

TEST(SvgPath, QuadraticSegmentsAreRaised) {
    // Two thirds of the way to the middle control point.
    EXPECT_THAT(numbers(read("M0 0Q3 6 6 0")[0]), ElementsAre(0, 0, 2, 4, 4, 4, 6, 0));
}

TEST(SvgPath, ArcsAreThoseOfTheEllipse) {
    const std::vector<PathPoint> arc =
        arc_beziers({{10, 20}, 30, 40, 25, true, false, {50, 70}});
    std::vector<double> expected{10, 20};
    for (const PathPoint& point : arc)
        expected.insert(expected.end(), {point.x, point.y});
    EXPECT_THAT(numbers(read("M10 20A30 40 25 1 0 50 70")[0]),
                ElementsAreArray(expected));
}

TEST(SvgPath, RelativeCommandsAreRelativeToTheCurrentPoint) {
    expect_same("m1 2 l3 4", "M1 2L4 6");
    expect_same("m1 2 h3 v4 h-1", "M1 2H4V6H3");
    expect_same("m1 2 c1 1 2 2 3 0", "M1 2C2 3 3 4 4 2");
    expect_same("m1 2 q1 1 3 0 q1 1 3 0", "M1 2Q2 3 4 2Q5 3 7 2");
    expect_same("m1 2 a5 6 7 0 1 3 4", "M1 2A5 6 7 0 1 4 6");
    expect_same("M1 2c1 1 2 2 3 0s2 2 3 0", "M1 2C2 3 3 4 4 2S6 4 7 2");
    expect_same("M1 2q1 1 3 0t2 1", "M1 2Q2 3 4 2T6 3");
}

TEST(SvgPath, SmoothCubicMirrorsOnlyAfterACubic) {
    expect_same("M0 0C1 2 3 4 5 5S8 8 9 5", "M0 0C1 2 3 4 5 5C7 6 8 8 9 5");
    expect_same("M0 0S1 2 3 4S8 8 9 5", "M0 0C0 0 1 2 3 4C5 6 8 8 9 5");
    expect_same("M0 0Q3 3 5 5S8 8 9 5", "M0 0Q3 3 5 5C5 5 8 8 9 5");
    expect_same("M0 0C1 2 3 4 5 5L6 6S8 8 9 5", "M0 0C1 2 3 4 5 5L6 6C6 6 8 8 9 5");
}

TEST(SvgPath, SmoothQuadraticMirrorsOnlyAfterAQuadratic) {
    expect_same("M0 0Q3 3 5 0T9 1T12 0", "M0 0Q3 3 5 0Q7 -3 9 1Q11 5 12 0");
    // Without one the control point is the current point, and the segment straight.
    expect_same("M0 0T9 0T12 3", "M0 0Q0 0 9 0Q18 0 12 3");
    expect_same("M0 0C1 1 2 2 3 0T9 1", "M0 0C1 1 2 2 3 0Q3 0 9 1");
}

TEST(SvgPath, ArgumentsRepeatTheirCommandAndAMovetoIsFollowedByLines) {
    expect_same("M0 0 1 1 2 0", "M0 0L1 1L2 0");
    expect_same("m5 5 1 1 2 0", "M5 5L6 6L8 6");
    expect_same("M0 0H1 2 3V1 2", "M0 0H1H2H3V1V2");
    expect_same("M0 0C1 1 2 2 3 3 4 4 5 5 6 6", "M0 0C1 1 2 2 3 3C4 4 5 5 6 6");
    expect_same("M0 0S1 1 2 2 3 3 4 4", "M0 0S1 1 2 2S3 3 4 4");
    expect_same("M0 0Q1 1 2 2 3 3 4 4", "M0 0Q1 1 2 2Q3 3 4 4");
    expect_same("M0 0T1 1 2 2", "M0 0T1 1T2 2");
    expect_same("M0 0a1 1 0 0 1 2 2 1 1 0 0 1 2 2", "M0 0A1 1 0 0 1 2 2A1 1 0 0 1 4 4");
}

TEST(SvgPath, NumbersNeedNoSeparators) {
    expect_same("M.5.5-.5-1e1", "M 0.5,0.5 L -0.5 , -10");
    expect_same("M1-1+2+3", "M 1 -1 L 2 3");
    expect_same("M1e1,2E+1L3e-1 4", "M10 20L0.3 4");
    expect_same("\t\f\r\nM\n1\t2\fL\r3,4 ", "M1 2L3 4");
    expect_same("M0 0a25,25 -30 01.5.5", "M0 0A25 25 -30 0 1 .5 .5");
    expect_same("M0 0a25,25-30 1110-5", "M0 0A25 25 -30 1 1 10 -5");
    expect_same("M007 -0L1 1", "M7 0L1 1");
}

TEST(SvgPath, ClosingDrawsALineOnlyWhereOneIsMissing) {
    const std::vector<SvgSubpath> open_end = read("M0 0L3 0L3 3Z");
    ASSERT_EQ(open_end.size(), 1U);
    EXPECT_TRUE(open_end[0].closed);
    EXPECT_EQ(open_end[0].bezier.size(), 10U);
    EXPECT_THAT(open_end[0].bezier[9], ElementsAre(0, 0));
    EXPECT_EQ(read("M0 0L3 0L3 3L0 0z")[0].bezier.size(), 10U);
}

TEST(SvgPath, EachSubpathIsACurve) {
    const std::vector<SvgSubpath> paths = read("M0 0L1 1M5 5m1 0l1 0Zl0 1zM9 9");
    ASSERT_EQ(paths.size(), 3U);
    EXPECT_FALSE(paths[0].closed);
    EXPECT_THAT(paths[1].bezier[0], ElementsAre(6, 5));
    EXPECT_TRUE(paths[1].closed);
    // After z the next one starts where the closed one did.
    EXPECT_THAT(paths[2].bezier[0], ElementsAre(6, 5));
    EXPECT_TRUE(paths[2].closed);
    expect_same("M1 1l1 0l0 1zm2 2l1 1", "M1 1L2 1L2 2ZM3 3L4 4");
}

TEST(SvgPath, APointThatIsClosedIsDrawn) {
    const std::vector<SvgSubpath> paths = read("M4 5Z");
    ASSERT_EQ(paths.size(), 1U);
    EXPECT_THAT(numbers(paths[0]), ElementsAre(4, 5, 4, 5, 4, 5, 4, 5));
}

TEST(SvgPath, RefusalsNameThePositionAndTheText) {
    const std::pair<const char*, const char*> cases[] = {
        {"L1 1", "position 0: expected a moveto, M or m, found 'L1 1'"},
        {"M", "position 1: expected a number, found the end"},
        {"M1", "position 2: expected a number, found the end"},
        {"M1 1Lx", "position 5: expected a number, found 'x'"},
        {"M1 1L2 2,", "position 9: expected a number, found the end"},
        {"M,1 1", "position 1: expected a number, found ',1 1'"},
        {"M1 1,,2 2", "position 5: expected a number, found ',2 2'"},
        {"M1 1L2 2,L3 3", "position 9: expected a number, found 'L3 3'"},
        {"M1.L2 2", "position 1: expected a number, found '1.L2 2'"},
        {"M1 1L--5 1", "position 5: expected a number, found '--5 1'"},
        {"M1 1L5e 1", "position 6: expected a number, found 'e 1'"},
        {"M1 1H", "position 5: expected a number, found the end"},
        {"M1 1V.", "position 5: expected a number, found '.'"},
        {"M1 1C1 1 2 2 3", "position 14: expected a number, found the end"},
        {"M1 1C1 1 2 Z", "position 11: expected a number, found 'Z'"},
        {"M1 1CZ", "position 5: expected a number, found 'Z'"},
        {"M1 1S1 1", "position 8: expected a number, found the end"},
        {"M1 1Q1 1", "position 8: expected a number, found the end"},
        {"M1 1QZ", "position 5: expected a number, found 'Z'"},
        {"M1 1T1", "position 6: expected a number, found the end"},
        {"M1 1AZ", "position 5: expected a number, found 'Z'"},
        {"M1 1A1", "position 6: expected a number, found the end"},
        {"M1 1A1 1", "position 8: expected a number, found the end"},
        {"M1 1A1 1 0 2 0 5 5", "position 11: expected a flag, 0 or 1, found '2 0 5 5'"},
        {"M1 1A1 1 0 1", "position 12: expected a flag, 0 or 1, found the end"},
        {"M1 1A1 1 0 1 1 5", "position 16: expected a number, found the end"},
        {"M1 1 ; L 2 2", "position 5: expected a command, found '; L 2 2'"},
        {"M1 1Z5 5", "position 5: expected a command, found '5 5'"},
        {"M1 1LM2 2", "position 5: expected a number, found 'M2 2'"},
        {"M1 1L1e999 1", "position 5: expected a number within doubles, found '1e999 1'"},
        {"M1 1L1e-999 1",
         "position 5: expected a number within doubles, found '1e-999 1'"},
        {"M1 1L1e101 1", "position 5: expected coordinates up to 1e100, found '1e101 1'"},
        {"M1e101 1L1 1", "position 1: expected coordinates up to 1e100"},
        {"M9e99 1l9e99 1", "position 8: expected coordinates up to 1e100"},
        {"M1 1A1e-300 1e300 0 1 1 5 5", "position 5: expected coordinates up to 1e100"},
        {"", "position 0: expected something that is drawn, found the end"},
        {"  M1 1 m2 2", "position 11: expected something that is drawn, found the end"},
    };
    for (const auto& [text, message] : cases)
        EXPECT_THAT(refusal(text), HasSubstr(message)) << text;
}

TEST(SvgPath, RefusalsAreOneShortLineOfPlainText) {
    EXPECT_THAT(refusal(std::string_view("M1 1L\n\0\xff", 8)),
                HasSubstr("found '?"
                          "?'"));
    EXPECT_THAT(refusal("M1 1L" + std::string(1000, '#')),
                HasSubstr("found '" + std::string(16, '#') + "...'"));
}

}  // namespace
}  // namespace haarmony::curve
