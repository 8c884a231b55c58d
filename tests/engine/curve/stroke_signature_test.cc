#include "engine/curve/stroke_signature.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/curve/fit.h"
#include "engine/curve/multires_curve.h"
#include "tests/engine/curve/scribble.h"

namespace haarmony::curve {
namespace {

using testing::Each;
using testing::IsEmpty;

// x' = a x + b y + c, y' = d x + e y + f.
Points
moved(const Points& points, double a, double b, double c, double d, double e, double f) {
    Points result = points;
    for (std::size_t i = 0; i < points.size(); ++i) {
        result[i][0] = a * points[i][0] + b * points[i][1] + c;
        result[i][1] = d * points[i][0] + e * points[i][1] + f;
    }
    return result;
}

double furthest(const Points& a, const Points& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        most = std::max(most, std::hypot(a[i][0] - b[i][0], a[i][1] - b[i][1]));
    return most;
}

TEST(NormalizedStroke, HasMeanZeroAndMeanSquareOneAndNoSlant) {
    Scribble hand(1, 5);
    for (std::size_t word = 0; word < 5; ++word) {
        const Points stroke = normalized_stroke(hand.write(word, 0.1), 400);
        double x = 0, y = 0, square = 0, both = 0, upright = 0, wide = 0;
        for (std::size_t i = 0; i < stroke.size(); ++i) {
            x += stroke[i][0];
            y += stroke[i][1];
            square += stroke[i][0] * stroke[i][0] + stroke[i][1] * stroke[i][1];
            if (i == 0) continue;
            const double dx = stroke[i][0] - stroke[i - 1][0];
            const double dy = stroke[i][1] - stroke[i - 1][1];
            both += dx * dy;
            upright += dy * dy;
            wide += dx * dx;
        }
        EXPECT_NEAR(x, 0, 1e-9);
        EXPECT_NEAR(y, 0, 1e-9);
        EXPECT_NEAR(square / 400, 1, 1e-9);
        EXPECT_LT(std::fabs(both) / std::sqrt(upright * wide), 0.02);
    }
}

TEST(NormalizedStroke, ForgetsPlaceSizeAndSlant) {
    Scribble hand(2, 1);
    const Points stroke = hand.write(0, 0);
    const Points once = normalized_stroke(stroke, 200);
    EXPECT_LT(furthest(once, normalized_stroke(moved(stroke, 3, 0, 70, 0, 3, -9), 200)),
              1e-9);
    // Equal distances are those of the upright stroke, which is found in a few rounds.
    EXPECT_LT(furthest(once, normalized_stroke(moved(stroke, 1, 0.3, 0, 0, 1, 0), 200)),
              0.02);
}

TEST(NormalizedStroke, ForgetsSpeed) {
    // The same polyline with each chord cut into parts.
    Scribble hand(3, 1);
    const Points stroke = hand.write(0, 0);
    Points slower(3 * (stroke.size() - 1) + 1, 2);
    for (std::size_t i = 0; i < slower.size(); ++i) {
        const std::size_t chord = std::min(i / 3, stroke.size() - 2);
        const double t = std::pow(double(i - 3 * chord) / 3, 1.5);
        for (std::size_t axis = 0; axis < 2; ++axis) {
            slower[i][axis] =
                stroke[chord][axis] + t * (stroke[chord + 1][axis] - stroke[chord][axis]);
        }
    }
    EXPECT_LT(furthest(normalized_stroke(stroke, 200), normalized_stroke(slower, 200)),
              1e-9);
}

TEST(NormalizedStroke, OfNoLengthIsZero) {
    EXPECT_THAT(normalized_stroke(Points(5, 3), 9).numbers(), Each(0.0));
    Points huge(2, 2);
    huge[0][0] = -1e308;
    huge[1][0] = 1e308;
    EXPECT_THAT(
        normalized_stroke(huge, 9).numbers(),
        Each(testing::Truly([](double number) { return std::isfinite(number); })));
}

TEST(StrokeSignature, IsTheLargestDetailsOfTheNormalizedStroke) {
    // By sorting all details of a curve whose samples are the normalized stroke.
    Scribble hand(4, 1);
    const Points word = hand.write(0, 0.1);
    const StrokeSignature signature = stroke_signature(word, Frame::kFixed);
    ASSERT_EQ(signature.terms.size(), kSignatureTerms);
    const Points points = normalized_stroke(word, 512);
    std::vector<double> parameters(512);
    for (std::size_t i = 0; i < 512; ++i) parameters[i] = double(i) / 511;
    const Points control =
        fit(points, kSignatureLevel, {.rounds = 0, .parameters = parameters}).control;
    std::vector<double> sizes;
    const MultiresCurve curve = decompose(control, Ends::kOpen);
    for (const Points& detail : curve.details)
        for (const double number : detail.numbers()) sizes.push_back(std::fabs(number));
    std::ranges::sort(sizes, std::greater());
    for (const std::int16_t term : signature.terms) {
        // Details follow each other row after row, as their keys do.
        std::size_t key = std::size_t(std::abs(term)) - 1;
        std::size_t level = 0;
        while (key >= curve.details[level].numbers().size())
            key -= curve.details[level++].numbers().size();
        const double value = curve.details[level].numbers()[key];
        EXPECT_EQ(value < 0, term < 0) << term;
        EXPECT_GE(std::fabs(value), sizes[kSignatureTerms - 1]) << term;
    }
    EXPECT_TRUE(std::ranges::is_sorted(
        signature.terms, {}, [](std::int16_t term) { return std::abs(term); }));
}

TEST(StrokeSignature, InLocalFramesDoesNotTurnWithTheStroke) {
    // A spiral has no slant to speak of, however it is turned.
    Points spiral(600, 2);
    for (std::size_t i = 0; i < spiral.size(); ++i) {
        const double a = 40 * double(i) / 600;
        spiral[i][0] = (5 + a) * std::cos(a);
        spiral[i][1] = (5 + a) * std::sin(a);
    }
    const double cos = std::cos(0.6), sin = std::sin(0.6);
    const Points turned = moved(spiral, cos, -sin, 0, sin, cos, 0);
    const auto shared = [&](Frame frame) {
        const StrokeSignature one = stroke_signature(spiral, frame);
        const StrokeSignature other = stroke_signature(turned, frame);
        return std::ranges::count_if(one.terms, [&](std::int16_t term) {
            return std::ranges::find(other.terms, term) != other.terms.end();
        });
    };
    EXPECT_GE(shared(Frame::kNormalized), 54);
    EXPECT_LE(shared(Frame::kFixed), 50);
}

TEST(StrokeSignature, OfNoLengthHasNoTerms) {
    EXPECT_THAT(stroke_signature(Points(2, 2), Frame::kNormalized).terms, IsEmpty());
    EXPECT_THAT(stroke_signature(Points(9, 1), Frame::kFixed).terms, IsEmpty());
}

TEST(StrokeSignature, OfAStraightLineHasNoTerms) {
    Points line(2, 2);
    line[1][0] = 7;
    line[1][1] = 3;
    EXPECT_THAT(stroke_signature(line, Frame::kNormalized).terms, IsEmpty());
}

}  // namespace
}  // namespace haarmony::curve
