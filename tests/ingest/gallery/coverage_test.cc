#include "ingest/gallery/coverage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "ingest/gallery/random.h"

namespace haarmony::gallery {
namespace {

constexpr Frame kFrame{48, 32};

// The oracle: 32 x 32 samples a pixel.
constexpr int kSamples = 32;

double sampled(int x, int y, const std::function<bool(Point)>& inside) {
    int hits = 0;
    for (int j = 0; j < kSamples; ++j)
        for (int i = 0; i < kSamples; ++i)
            hits += inside({(x + (i + 0.5) / kSamples) / kFrame.height,
                            (y + (j + 0.5) / kSamples) / kFrame.height})
                        ? 1
                        : 0;
    return static_cast<double>(hits) / (kSamples * kSamples);
}

void expect_coverage(const Mask& mask,
                     const std::function<bool(Point)>& inside,
                     double tolerance) {
    for (int y = 0; y < kFrame.height; ++y)
        for (int x = 0; x < kFrame.width; ++x)
            ASSERT_NEAR(mask.at(x, y), sampled(x, y, inside), tolerance)
                << "pixel " << x << ", " << y;
}

// Crossings of a ray to the right: odd inside.
bool inside_polygon(const std::vector<Point>& outline, Point p) {
    bool inside = false;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Point a = outline[i];
        const Point b = outline[(i + 1) % outline.size()];
        if ((a.y > p.y) != (b.y > p.y) &&
            p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
            inside = !inside;
    }
    return inside;
}

// A star-shaped polygon about a centre does not cross itself.
std::vector<Point> random_polygon(Random& random, Point centre, double most) {
    std::vector<Point> outline;
    const int corners = 3 + random.below(9);
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * M_PI * i / corners;
        const double r = most * random.between(0.2, 1);
        outline.push_back(centre + Point{r * std::cos(angle), r * std::sin(angle)});
    }
    if (random.chance(0.5)) std::reverse(outline.begin(), outline.end());
    return outline;
}

TEST(Coverage, PolygonsAgreeWithSampling) {
    Random random(21);
    for (int round = 0; round < 12; ++round) {
        const auto outline = random_polygon(random, {0.75, 0.5}, 0.45);
        // An edge of 32 samples a pixel is known to about a row of them.
        expect_coverage(
            cover_polygon(kFrame, outline),
            [&](Point p) { return inside_polygon(outline, p); },
            0.03);
        if (HasFatalFailure()) FAIL() << "round " << round;
    }
}

TEST(Coverage, PolygonsThatLeaveThePictureAreCutAtItsBorders) {
    Random random(22);
    const Point corners[] = {{0, 0.5}, {1.5, 0.5}, {0.7, 0}, {0.7, 1}, {0, 0}, {1.5, 1}};
    for (const Point centre : corners) {
        const auto outline = random_polygon(random, centre, 1.1);
        expect_coverage(
            cover_polygon(kFrame, outline),
            [&](Point p) { return inside_polygon(outline, p); },
            0.03);
        if (HasFatalFailure()) FAIL() << "about " << centre.x << ", " << centre.y;
    }
}

TEST(Coverage, APolygonsCoverageSumsToItsArea) {
    Random random(23);
    for (int round = 0; round < 50; ++round) {
        const auto outline = random_polygon(random, {0.75, 0.5}, 0.45);
        double area = 0;
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const Point a = outline[i];
            const Point b = outline[(i + 1) % outline.size()];
            area += (a.x * b.y - b.x * a.y) / 2;
        }
        double sum = 0;
        for (const float c : cover_polygon(kFrame, outline).coverage) sum += c;
        EXPECT_NEAR(sum, std::fabs(area) * kFrame.height * kFrame.height, 1e-3);
    }
}

TEST(Coverage, ARectangleOnPixelBordersIsExact) {
    const Point outline[] = {{0.25, 0.25}, {0.5, 0.25}, {0.5, 0.75}, {0.25, 0.75}};
    const Mask mask = cover_polygon(kFrame, outline);
    for (int y = 0; y < kFrame.height; ++y)
        for (int x = 0; x < kFrame.width; ++x)
            EXPECT_EQ(mask.at(x, y), x >= 8 && x < 16 && y >= 8 && y < 24 ? 1 : 0);
}

TEST(Coverage, NothingOutsideOfThePictureIsCovered) {
    const Point outline[] = {{2, 2}, {3, 2}, {2.5, 3}};
    EXPECT_TRUE(cover_polygon(kFrame, outline).empty());
    EXPECT_TRUE(cover_disc(kFrame, {-2, -2}, 0.5).empty());
}

TEST(Coverage, FewerThanThreeCornersCoverNothing) {
    const Point line[] = {{0.1, 0.1}, {0.9, 0.9}};
    EXPECT_TRUE(cover_polygon(kFrame, line).empty());
}

TEST(Coverage, DiscsAgreeWithSampling) {
    Random random(24);
    for (int round = 0; round < 12; ++round) {
        const Point centre{random.between(0, 1.5), random.between(0, 1)};
        const double radius = random.between(2.0, 14.0) / kFrame.height;
        expect_coverage(
            cover_disc(kFrame, centre, radius),
            [&](Point p) { return length(p - centre) <= radius; },
            0.05 + 0.03);
        if (HasFatalFailure()) FAIL() << "round " << round << " radius " << radius;
    }
}

TEST(Coverage, EllipsesAgreeWithSampling) {
    const Point centre{0.7, 0.5};
    const double angle = 0.6;
    expect_coverage(
        cover_ellipse(kFrame, centre, 0.4, 0.2, angle),
        [&](Point p) {
            const Point d = turned(p - centre, -angle);
            return d.x * d.x / 0.16 + d.y * d.y / 0.04 <= 1;
        },
        0.04);
}

TEST(Coverage, StrokesAgreeWithSampling) {
    const std::vector<Point> points{{0.2, 0.2}, {1.2, 0.4}, {0.6, 0.9}};
    const std::vector<double> radii{0.08, 0.08, 0.08};
    const auto inside = [&](Point p) {
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            const Point d = points[i + 1] - points[i];
            const Point q = p - points[i];
            const double t =
                std::clamp((q.x * d.x + q.y * d.y) / (d.x * d.x + d.y * d.y), 0.0, 1.0);
            if (length(q - d * t) <= 0.08) return true;
        }
        return false;
    };
    // Where two segments meet at an angle the larger coverage stands for their union: at
    // worst, in the inner corner, half of either is half of it instead of three quarters.
    expect_coverage(cover_stroke(kFrame, points, radii), inside, 0.25);
}

TEST(Coverage, AStraightStrokeIsACapsule) {
    const Point a{0.3, 0.25};
    const Point b{1.1, 0.7};
    const std::vector<Point> points{a, (a + b) * 0.5, b};
    const std::vector<double> radii{0.09, 0.09, 0.09};
    expect_coverage(
        cover_stroke(kFrame, points, radii),
        [&](Point p) {
            const Point d = b - a;
            const Point q = p - a;
            const double t =
                std::clamp((q.x * d.x + q.y * d.y) / (d.x * d.x + d.y * d.y), 0.0, 1.0);
            return length(q - d * t) <= 0.09;
        },
        0.08);
}

TEST(Coverage, ATaperIsWideAtOneEndAndThinAtTheOther) {
    const std::vector<Point> points{{0.2, 0.5}, {1.3, 0.5}};
    const std::vector<double> radii{0.2, 0.02};
    const Mask mask = cover_stroke(kFrame, points, radii);
    const auto thickness = [&](int x) {
        double sum = 0;
        for (int y = 0; y < kFrame.height; ++y) sum += mask.at(x, y);
        return sum;
    };
    EXPECT_NEAR(thickness(7), 2 * 0.2 * kFrame.height, 1.0);
    EXPECT_NEAR(thickness(41), 2 * 0.02 * kFrame.height, 1.0);
}

TEST(Coverage, AHairCoversInProportionToItsWidth) {
    const Frame wide{60, 40};
    const std::vector<Point> points{{0.25, 0.5}, {1.25, 0.5}};
    const auto ink = [&](double radius) {
        const std::vector<double> radii{radius, radius};
        double sum = 0;
        for (const float c : cover_stroke(wide, points, radii).coverage) sum += c;
        return sum;
    };
    const double pixel = 1.0 / wide.height;
    EXPECT_NEAR(ink(0.1 * pixel) / ink(0.2 * pixel), 0.5, 0.1);
}

TEST(Coverage, SofteningKeepsTheAmount) {
    const Mask disc = cover_disc(kFrame, {0.75, 0.5}, 0.2);
    const Mask soft = soften(kFrame, disc, 0.05);
    double before = 0;
    double after = 0;
    float highest = 0;
    for (const float c : disc.coverage) before += c;
    for (const float c : soft.coverage) {
        after += c;
        highest = std::max(highest, c);
    }
    EXPECT_NEAR(after, before, 0.01 * before);
    EXPECT_LE(highest, 1);
}

TEST(Coverage, SofteningSpreadsAsTheGaussianOfItsRadius) {
    // One covered pixel becomes the blur's own kernel.
    const Frame large{120, 120};
    Mask point{60, 60, 1, 1, {1.0F}};
    const double radius = 5.0 / large.height;
    const Mask soft = soften(large, point, radius);
    double sum = 0;
    double variance = 0;
    for (int y = 0; y < 120; ++y) {
        for (int x = 0; x < 120; ++x) {
            const double weight = soft.at(x, y);
            sum += weight;
            variance += weight * (x - 60) * (x - 60);
        }
    }
    EXPECT_NEAR(sum, 1, 1e-3);
    // Box widths are whole pixels, so the deviation is met to about half a pixel.
    EXPECT_NEAR(std::sqrt(variance / sum), 5, 0.6);
}

TEST(Coverage, SofteningNothingIsNothing) {
    EXPECT_TRUE(soften(kFrame, Mask{}, 0.1).empty());
}

TEST(Coverage, WithoutKeepsWhatTheOtherLeavesFree) {
    const Mask disc = cover_disc(kFrame, {0.7, 0.5}, 0.3);
    const Mask other = cover_disc(kFrame, {0.9, 0.6}, 0.25);
    const Mask rest = without(disc, other);
    for (int y = 0; y < kFrame.height; ++y)
        for (int x = 0; x < kFrame.width; ++x)
            EXPECT_NEAR(rest.at(x, y), disc.at(x, y) * (1 - other.at(x, y)), 1e-6);
}

TEST(Coverage, SmoothWaysPassThroughTheirPoints) {
    const std::vector<Point> points{{0.1, 0.1}, {0.5, 0.3}, {0.9, 0.2}, {0.6, 0.8}};
    const auto path = smooth_path(points, 5);
    const auto outline = smooth_outline(points, 5);
    ASSERT_EQ(path.size(), 16U);
    ASSERT_EQ(outline.size(), 20U);
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_LT(length(path[5 * i] - points[i]), 1e-12);
        EXPECT_LT(length(outline[5 * i] - points[i]), 1e-12);
    }
    EXPECT_TRUE(smooth_path({}, 5).empty());
}

}  // namespace
}  // namespace haarmony::gallery
