#include "engine/curve/path_samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace haarmony::curve {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

SvgSubpath first_of(std::string_view text) {
    return parse_svg_path(text).value().front();
}

// Distance of a point from a polyline, closed or not, by looking at every chord.
double distance_to(const Points& polyline, bool closed, double x, double y) {
    double nearest = std::hypot(polyline[0][0] - x, polyline[0][1] - y);
    const std::size_t chords = polyline.size() - (closed ? 0 : 1);
    for (std::size_t i = 0; i < chords; ++i) {
        const auto a = polyline[i], b = polyline[(i + 1) % polyline.size()];
        const double dx = b[0] - a[0], dy = b[1] - a[1];
        const double square = dx * dx + dy * dy;
        double t = square > 0 ? ((x - a[0]) * dx + (y - a[1]) * dy) / square : 0;
        t = std::clamp(t, 0.0, 1.0);
        nearest = std::min(nearest, std::hypot(a[0] + t * dx - x, a[1] + t * dy - y));
    }
    return nearest;
}

double worst_distance(const SvgSubpath& path, const Points& polyline) {
    double worst = 0;
    for (std::size_t i = 0; i + 3 < path.bezier.size(); i += 3) {
        for (double t = 0; t <= 1; t += 1.0 / 128) {
            const double s = 1 - t;
            double p[2];
            for (std::size_t axis = 0; axis < 2; ++axis) {
                p[axis] = s * s * s * path.bezier[i][axis] +
                          3 * s * s * t * path.bezier[i + 1][axis] +
                          3 * s * t * t * path.bezier[i + 2][axis] +
                          t * t * t * path.bezier[i + 3][axis];
            }
            worst = std::max(worst, distance_to(polyline, path.closed, p[0], p[1]));
        }
    }
    return worst;
}

TEST(PathSamples, NoPointOfThePathIsFurtherThanTheDeviation) {
    std::mt19937 random(2);
    std::uniform_int_distribution<int> coordinate(-100, 100);
    for (int round = 0; round < 8; ++round) {
        std::string text = "M0 0";
        for (int segment = 0; segment < 2; ++segment) {
            text += 'C';
            for (int i = 0; i < 6; ++i) text += " " + std::to_string(coordinate(random));
        }
        if (round % 2 == 1) text += 'z';
        const SvgSubpath path = first_of(text);
        for (const double deviation : {0.3, 0.01}) {
            const PathSamples samples = sample_path(path, deviation).value();
            EXPECT_LE(worst_distance(path, samples.points), deviation) << text;
        }
    }
}

TEST(PathSamples, NeighboursAreNearToEachOther) {
    const SvgSubpath path = first_of("M0 0L100 0L100 1L100 100");
    const PathSamples samples = sample_path(path, 10).value();
    for (std::size_t i = 1; i < samples.points.size(); ++i) {
        const auto a = samples.points[i - 1], b = samples.points[i];
        EXPECT_LE(std::hypot(b[0] - a[0], b[1] - a[1]), 200.0 / 512 + 1e-12) << i;
    }
    EXPECT_THAT(samples.points[samples.points.size() - 1], ElementsAre(100, 100));
}

TEST(PathSamples, CornersAreTheJointsThatTurn) {
    // The second joint goes straight on, the third turns by 90 degrees.
    const SvgSubpath path = first_of("M0 0L10 0L20 0L20 10");
    const PathSamples samples = sample_path(path, 1).value();
    ASSERT_EQ(samples.corners.size(), 1U);
    EXPECT_THAT(samples.points[samples.corners[0]], ElementsAre(20, 0));
}

TEST(PathSamples, CornersAreFoundAcrossSegmentsOfNoLength) {
    const PathSamples samples =
        sample_path(first_of("M0 0L10 0l0 0l0 0C10 0 10 5 10 10"), 1).value();
    ASSERT_EQ(samples.corners.size(), 1U);
    EXPECT_THAT(samples.points[samples.corners[0]], ElementsAre(10, 0));
}

TEST(PathSamples, OfAClosedPathDoNotRepeatTheStartAndItMayBeACorner) {
    const PathSamples square = sample_path(first_of("M0 0H8V8H0Z"), 1).value();
    EXPECT_EQ(square.corners.size(), 4U);
    EXPECT_EQ(square.corners[0], 0U);
    EXPECT_THAT(square.points[0], ElementsAre(0, 0));
    const auto last = square.points[square.points.size() - 1];
    EXPECT_GT(std::hypot(last[0], last[1]), 0);
    const PathSamples circle =
        sample_path(first_of("M10 0A10 10 0 0 1 -10 0A10 10 0 0 1 10 0z"), 1e-3).value();
    EXPECT_THAT(circle.corners, IsEmpty());
}

TEST(PathSamples, OfAPointAreThatPoint) {
    EXPECT_THAT(sample_path(first_of("M4 5Z"), 1).value().points.numbers(),
                ElementsAre(4, 5));
    EXPECT_THAT(sample_path(first_of("M4 5h0"), 1).value().points.numbers(),
                ElementsAre(4, 5, 4, 5));
}

TEST(PathSamples, ADeviationThatTakesTooManyIsRefused) {
    const Result<PathSamples> result =
        sample_path(first_of("M0 0C0 1e9 1e9 1e9 1e9 0"), 1e-9);
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().code, ErrorCode::kTooLarge);
    EXPECT_EQ(result.error().param, "d");
    EXPECT_THAT(result.error().message,
                testing::HasSubstr("1e-09 takes more than 4000000 samples"));
}

}  // namespace
}  // namespace haarmony::curve
