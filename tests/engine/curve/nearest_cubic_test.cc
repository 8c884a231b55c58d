#include "engine/curve/nearest_cubic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "engine/curve/bspline.h"
#include "tests/engine/curve/drawn_strokes.h"

namespace haarmony::curve {
namespace {

double by_samples(const Points& bezier, PlaneVector q) {
    double nearest2 = INFINITY;
    for (std::size_t first = 0; first < bezier.size(); first += 4) {
        for (int k = 0; k <= 400; ++k) {
            nearest2 = std::min(
                nearest2, squared(in_plane(bernstein_sum(bezier, first, k / 400.0)) - q));
        }
    }
    return std::sqrt(nearest2);
}

TEST(NearestCubic, IsTheNearestOfAllSamples) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> where(-100, 700);
    for (const double noise : {0.0, 2.0, 60.0}) {
        const Points bezier = four_rows_each(bezier_points(
            drawn_stroke({.level = 5, .noise = noise, .seed = 4}), Ends::kOpen));
        const NearestCubic nearest(cubics_of(bezier));
        const double gap = widest_gap(bezier, 400);
        for (int i = 0; i < 100; ++i) {
            const PlaneVector q{where(random), where(random)};
            const double want = by_samples(bezier, q);
            const double got = std::sqrt(nearest.find(q).distance2);
            EXPECT_LE(got, want + 1e-9) << noise << ' ' << q.x << ' ' << q.y;
            EXPECT_GE(got, want - gap) << noise << ' ' << q.x << ' ' << q.y;
        }
    }
}

// A cubic whose control points lie far apart: coarse starts miss its loop.
TEST(NearestCubic, FindsTightLoopsOfLongSegments) {
    Points bezier(4, 2);
    const double x[] = {0, 1000, -900, 100};
    const double y[] = {0, 20, 20, 0};
    for (std::size_t i = 0; i < 4; ++i) {
        bezier[i][0] = x[i];
        bezier[i][1] = y[i];
    }
    const NearestCubic nearest(cubics_of(bezier));
    for (int k = 0; k <= 1000; ++k) {
        const PlaneVector on = in_plane(bernstein_sum(bezier, 0, k / 1000.0));
        EXPECT_NEAR(std::sqrt(nearest.find(on).distance2), 0, 1e-6) << k;
    }
}

TEST(NearestCubic, WalkingAlongTheCurveStaysOnIt) {
    const Points bezier = four_rows_each(
        bezier_points(drawn_stroke({.level = 5, .noise = 0.2}), Ends::kOpen));
    const NearestCubic nearest(cubics_of(bezier));
    CubicPlace place = nearest.find(in_plane(bezier[0]));
    for (std::size_t first = 0; first < bezier.size(); first += 4) {
        for (int k = 0; k < 10; ++k) {
            const PlaneVector on = in_plane(bernstein_sum(bezier, first, k / 10.0));
            place = nearest.walk(on, place);
            // Three of Newton's steps: close, but not exact.
            EXPECT_NEAR(std::sqrt(place.distance2), 0, 0.05) << first << ' ' << k;
        }
    }
}

TEST(NearestCubic, WalkingNeverEndsFartherThanItStarted) {
    const Points bezier = four_rows_each(
        bezier_points(drawn_stroke({.level = 4, .noise = 30}), Ends::kOpen));
    const NearestCubic nearest(cubics_of(bezier));
    std::mt19937 random(2);
    std::uniform_real_distribution<double> where(0, 600);
    const CubicPlace start = nearest.find({300, 150});
    const PlaneVector point = [&] {
        // The place as a point: the only one at distance 0 from itself.
        const auto parts = cubics_of(bezier);
        double best2 = INFINITY;
        PlaneVector found;
        for (const PlaneCubic& part : parts) {
            for (int k = 0; k <= 2000; ++k) {
                const PlaneVector p = PlanePolynomial(part).value(k / 2000.0);
                if (squared(p - PlaneVector{300, 150}) < best2) {
                    best2 = squared(p - PlaneVector{300, 150});
                    found = p;
                }
            }
        }
        return found;
    }();
    for (int i = 0; i < 50; ++i) {
        const PlaneVector q{where(random), where(random)};
        const CubicPlace end = nearest.walk(q, start);
        EXPECT_LE(std::sqrt(end.distance2), norm(q - point) + 0.1) << i;
        EXPECT_GE(end.distance2, nearest.find(q).distance2 - 1e-9) << i;
    }
}

TEST(NearestCubic, OfPointsWithoutExtent) {
    Points still(4, 2);
    for (double& number : still.numbers()) number = 3;
    const NearestCubic nearest(cubics_of(still));
    EXPECT_EQ(nearest.find({6, 7}).distance2, 25);
}

}  // namespace
}  // namespace haarmony::curve
