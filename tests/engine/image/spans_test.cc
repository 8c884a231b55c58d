#include "engine/image/spans.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace haarmony::image {
namespace {

// Whether a disc somewhere between a and b covers the point, by the definition: the square
// of the distance less the square of the radius is a quadratic in t, and its least value on
// [0, 1] lies at an end or at its vertex.
bool covered(const Disc& a, const Disc& b, double x, double y) {
    const auto excess = [&](double t) {
        const double cx = a.center.x + t * (b.center.x - a.center.x) - x;
        const double cy = a.center.y + t * (b.center.y - a.center.y) - y;
        const double r = a.radius + t * (b.radius - a.radius);
        return cx * cx + cy * cy - r * r;
    };
    const double f0 = excess(0);
    const double f1 = excess(1);
    const double curvature = 2 * (f0 + f1 - 2 * excess(0.5));
    if (f0 <= 0 || f1 <= 0) return true;
    if (curvature <= 0) return false;
    const double vertex = (f0 - f1 + curvature) / (2 * curvature);
    return vertex > 0 && vertex < 1 && excess(vertex) <= 0;
}

TEST(DiscHull, CoversWhatADiscOnTheWayCovers) {
    std::mt19937 random(181);
    const auto number = [&random](double scale) {
        return scale * static_cast<double>(random() >> 4) / (1 << 28);
    };
    for (int i = 0; i < 300; ++i) {
        const Disc a{{number(20), number(20)}, number(i % 3 == 0 ? 0.5 : 6)};
        const Disc b{{number(20), i % 5 == 0 ? a.center.y : number(20)}, number(6)};
        const DiscHull hull(a, b);
        for (double y = -7.25; y < 28; y += 0.5) {
            const Span span = hull.at(y);
            EXPECT_EQ(span.empty(), y < hull.top() || y > hull.bottom())
                << i << ", " << y;
            for (double x = -7.1; x < 28; x += 0.37) {
                const bool inside = x >= span.begin && x <= span.end;
                const bool near_edge =
                    std::min(std::fabs(x - span.begin), std::fabs(x - span.end)) < 1e-9;
                ASSERT_TRUE(near_edge || inside == covered(a, b, x, y))
                    << "hull " << i << " at " << x << ", " << y;
            }
        }
    }
}

TEST(DiscHull, OfADiscWithinTheOtherIsTheLargerOne) {
    const DiscHull hull({{5, 5}, 4}, {{6, 5}, 1});
    EXPECT_EQ(hull.top(), 1);
    EXPECT_EQ(hull.bottom(), 9);
    EXPECT_EQ(hull.at(5).begin, 1);
    EXPECT_EQ(hull.at(5).end, 9);
    EXPECT_TRUE(hull.at(9.5).empty());
}

TEST(Spans, UniteWhereTheyTouch) {
    std::vector<Span> spans = {{5, 6}, {0, 1}, {1, 2}, {4, 9}, {7, 8}};
    const std::vector<Span> found = united(spans);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].begin, 0);
    EXPECT_EQ(found[0].end, 2);
    EXPECT_EQ(found[1].begin, 4);
    EXPECT_EQ(found[1].end, 9);
}

TEST(Spans, AreInsideWhereTheWindingNumberIsNotZero) {
    std::vector<Crossing> crossings = {
        {4, -1}, {1, +1}, {2, +1}, {3, -1}, {6, -1}, {7, +1}};
    const std::vector<Span> found = spans_of(crossings);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].begin, 1);
    EXPECT_EQ(found[0].end, 4);
    EXPECT_EQ(found[1].begin, 6);
    EXPECT_EQ(found[1].end, 7);
}

}  // namespace
}  // namespace haarmony::image
