#include "engine/curve/bezier_text.h"

#include <gtest/gtest.h>

#include <sstream>

#include "tests/engine/curve/drawn_strokes.h"

namespace haarmony::curve {
namespace {

// Segments along a line at y = 7, the second of which starts where the first ends or not.
Approximation two_segments(double second_start) {
    Approximation a;
    a.bezier = Points(8, 2);
    const double x[] = {0, 1, 2, 3, second_start, 5, 6.5, 8};
    for (std::size_t i = 0; i < 8; ++i) {
        a.bezier[i][0] = x[i];
        a.bezier[i][1] = 7;
    }
    a.possible = 4;
    a.tolerance = 0.5;
    a.bound = 0.25;
    a.max_error = 0.125;
    return a;
}

// All numbers of a text, in order.
std::vector<double> numbers_of(std::string text) {
    for (char& c : text) {
        if (std::string("0123456789.-+e").find(c) == std::string::npos) c = ' ';
    }
    std::istringstream stream(text);
    std::vector<double> numbers;
    for (std::string word; stream >> word;) {
        char* end = nullptr;
        const double number = std::strtod(word.c_str(), &end);
        if (*end == '\0') numbers.push_back(number);
    }
    return numbers;
}

TEST(SvgPath, DrawsSegmentsThatMeetAsOneSubpath) {
    EXPECT_EQ(svg_path(two_segments(3)), "M0 7C1 7 2 7 3 7C5 7 6.5 7 8 7");
}

TEST(SvgPath, MovesToASegmentThatDoesNotMeetTheLast) {
    EXPECT_EQ(svg_path(two_segments(4)), "M0 7C1 7 2 7 3 7M4 7C5 7 6.5 7 8 7");
}

TEST(SvgPath, ClosesAClosedCurveAndNoOther) {
    Approximation a = two_segments(3);
    a.bezier[7][0] = 0;
    EXPECT_EQ(svg_path(a).back(), '7');
    a.closed = true;
    EXPECT_EQ(svg_path(a).back(), 'Z');
    a.bezier[4][0] = 4;
    EXPECT_EQ(svg_path(a).find('Z'), std::string::npos);
}

TEST(SvgPath, BringsBackTheSameDoubles) {
    const auto a = approximate(drawn_stroke({.level = 6, .ends = Ends::kClosed}),
                               Ends::kClosed,
                               1,
                               Joining::kG1,
                               {});
    ASSERT_TRUE(a);
    std::string text = svg_path(*a);
    EXPECT_EQ(text.back(), 'Z');
    std::vector<double> want = {a->bezier[0][0], a->bezier[0][1]};
    for (std::size_t i = 0; i < a->bezier.size(); ++i) {
        if (i % 4 == 0) continue;
        want.push_back(a->bezier[i][0]);
        want.push_back(a->bezier[i][1]);
    }
    EXPECT_EQ(numbers_of(text), want);
}

TEST(SvgPath, OfACurveOfOneDimensionLiesOnTheAxis) {
    Approximation a;
    a.bezier = Points(4, 1);
    a.bezier[3][0] = 2;
    EXPECT_EQ(svg_path(a), "M0 0C0 0 0 0 2 0");
}

TEST(SvgDocument, ShowsTheWholeCurveAndWhatIsPromised) {
    const std::string text = svg_document(two_segments(3));
    // 8 wide, a line of 8 / 500, half of it around.
    const std::size_t view = text.find("viewBox=\"");
    ASSERT_NE(view, std::string::npos);
    const std::vector<double> box = numbers_of(text.substr(view, text.find('>') - view));
    ASSERT_EQ(box.size(), 4U) << text;
    EXPECT_NEAR(box[0], -0.008, 1e-12);
    EXPECT_NEAR(box[1], 6.992, 1e-12);
    EXPECT_NEAR(box[2], 8.016, 1e-12);
    EXPECT_NEAR(box[3], 0.016, 1e-12);
    EXPECT_NE(text.find(" d=\"" + svg_path(two_segments(3)) + "\""), std::string::npos);
}

TEST(SvgDocument, OfAPointHasAnArea) {
    Approximation a;
    a.bezier = Points(4, 2);
    EXPECT_NE(svg_document(a).find("viewBox=\"-0.5 -0.5 1 1\""), std::string::npos);
}

TEST(PostScript, IsMirroredWithinItsBoundingBox) {
    const std::string text = postscript(two_segments(4));
    EXPECT_EQ(text.rfind("%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: -1 -8 9 -6\n", 0), 0U)
        << text;
    EXPECT_NE(text.find("1 -1 scale\n"), std::string::npos);
    EXPECT_NE(text.find("newpath\n0 7 moveto\n1 7 2 7 3 7 curveto\n4 7 moveto\n"
                        "5 7 6.5 7 8 7 curveto\nstroke\n"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("%%Title: 2 of 4 segments, tolerance 0.5"), std::string::npos);
}

TEST(PostScript, ClosesAClosedCurve) {
    Approximation a = two_segments(3);
    a.bezier[7][0] = 0;
    a.closed = true;
    EXPECT_NE(postscript(a).find("curveto\nclosepath\nstroke"), std::string::npos);
}

TEST(PostScript, WritesAVastBoundingBoxInFull) {
    Approximation a = two_segments(3);
    a.bezier[7][0] = 1e30;
    const std::string text = postscript(a);
    EXPECT_EQ(text.find("e+"), text.find("e+", text.find("Title"))) << text;
    EXPECT_NE(text.find("%%BoundingBox: -1"), std::string::npos) << text;
}

}  // namespace
}  // namespace haarmony::curve
