#include "engine/curve/fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "engine/curve/bspline.h"

namespace haarmony::curve {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::Pointwise;

constexpr double kPi = std::numbers::pi;

Points rows(std::initializer_list<std::vector<double>> list) {
    Points points(list.size(), int(list.begin()->size()));
    std::size_t i = 0;
    for (const std::vector<double>& row : list)
        std::ranges::copy(row, points[i++].begin());
    return points;
}

Points random_points(std::size_t count, int dimension, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-100, 100);
    Points points(count, dimension);
    for (double& number : points.numbers()) number = unit(random);
    return points;
}

bool all_finite(const CurveFit& fit) {
    return std::ranges::all_of(fit.control.numbers(),
                               [](double v) { return std::isfinite(v); }) &&
           std::isfinite(fit.max_error) && std::isfinite(fit.rms_error);
}

// A loop with a wiggle, `count` samples in x, y and more dimensions that follow.
Points wiggle(std::size_t count, int dimension, double turns = 1) {
    Points points(count, dimension);
    for (std::size_t i = 0; i < count; ++i) {
        const double a = 2 * kPi * turns * double(i) / double(count);
        const double radius = 100 + 20 * std::sin(3 * a);
        const std::array<double, 3> row{
            radius * std::cos(a), radius * std::sin(a), 5 + std::cos(2 * a)};
        for (std::size_t axis = 0; axis < std::size_t(dimension); ++axis)
            points[i][axis] = row[axis % 3];
    }
    return points;
}

TEST(Fit, OfSamplesOfACurveAtTheirParametersIsThatCurve) {
    for (const Ends ends : {Ends::kOpen, Ends::kClosed}) {
        for (const int dimension : {1, 2, 5, 8}) {
            const int level = 5;
            const Points control =
                random_points(control_count(level, ends), dimension, unsigned(dimension));
            std::vector<double> parameters;
            Points samples(700, dimension);
            for (std::size_t i = 0; i < samples.size(); ++i) {
                parameters.push_back(double(i) / 699);
                std::ranges::copy(point_at(control, ends, parameters.back()),
                                  samples[i].begin());
            }
            FitOptions options;
            options.ends = ends;
            options.parameters = parameters;
            const CurveFit found = fit_within(samples, 1e-7, options);
            EXPECT_EQ(found.level, level);
            EXPECT_LE(found.max_error, 1e-7);
            EXPECT_THAT(found.control.numbers(),
                        Pointwise(DoubleNear(1e-9), control.numbers()));
        }
    }
}

TEST(Fit, ReportsTheErrorsOfItsSamples) {
    const Points samples = wiggle(300, 3, 0.9);
    for (const Spacing spacing : {Spacing::kChordLength, Spacing::kCentripetal}) {
        FitOptions options;
        options.spacing = spacing;
        const CurveFit found = fit(samples, 3, options);
        double worst = 0;
        double sum = 0;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const std::vector<double> on =
                point_at(found.control, Ends::kOpen, found.parameters[i]);
            const double error = std::hypot(on[0] - samples[i][0], on[1] - samples[i][1]);
            worst = std::max(worst, error);
            sum += error * error;
        }
        EXPECT_NEAR(found.max_error, worst, 1e-10);
        EXPECT_NEAR(found.rms_error, std::sqrt(sum / 300), 1e-10);
        EXPECT_GT(found.max_error, 0.01);
    }
}

TEST(Fit, TakesTheSmallestLevelThatMeetsTheTolerance) {
    const Points samples = wiggle(2000, 2, 0.95);
    for (const double tolerance : {10.0, 1.0, 0.1, 0.01}) {
        const CurveFit found = fit_within(samples, tolerance, {});
        EXPECT_LE(found.max_error, tolerance);
        EXPECT_EQ(found.control.size(), control_count(found.level, Ends::kOpen));
        ASSERT_GT(found.level, 0);
        for (int lower = 0; lower < found.level; ++lower)
            EXPECT_GT(fit(samples, lower, {}).max_error, tolerance) << lower;
    }
}

TEST(Fit, WhoseToleranceNoLevelMeetsReportsItsError) {
    // Noise, sampled more densely than the finest level can follow.
    const Points samples = random_points(20'000, 2, 3);
    FitOptions options;
    options.rounds = 0;
    const CurveFit found = fit_within(samples, 1e-3, options);
    EXPECT_EQ(found.level, kMostFitLevel);
    EXPECT_GT(found.max_error, 1e-3);
}

TEST(Fit, MovingTheParametersHelps) {
    // Speed changes abruptly along the stroke: chord length is a poor guess at sharp bends.
    const Points samples = rows({{0, 0},
                                 {1, 4},
                                 {2, 7},
                                 {3, 8},
                                 {3.5, 6},
                                 {3.6, 3},
                                 {4, 1},
                                 {6, 0},
                                 {9, 1},
                                 {12, 5},
                                 {13, 9},
                                 {12, 12}});
    FitOptions still;
    still.rounds = 0;
    const double before = fit(samples, 1, still).max_error;
    const double after = fit(samples, 1, {}).max_error;
    EXPECT_LT(after, 0.8 * before);
}

TEST(Fit, ParametersStayInOrder) {
    const CurveFit found = fit(random_points(400, 2, 4), 4, {});
    EXPECT_EQ(found.parameters.front(), 0);
    EXPECT_EQ(found.parameters.back(), 1);
    EXPECT_TRUE(std::ranges::is_sorted(found.parameters));
}

TEST(Fit, PinnedEndsAreTheFirstAndLastSampleExactly) {
    const Points samples = random_points(200, 3, 5);
    FitOptions options;
    options.pin_ends = true;
    for (const int level : {0, 3, 9}) {
        const CurveFit found = fit(samples, level, options);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            EXPECT_EQ(found.control[0][axis], samples[0][axis]);
            EXPECT_EQ(found.control[found.control.size() - 1][axis], samples[199][axis]);
        }
    }
}

TEST(Fit, OfTwoSamplesIsTheLineBetweenThem) {
    const Points samples = rows({{1, 2, 10}, {5, -6, 30}});
    EXPECT_EQ(fit_within(samples, 1e-9, {}).level, 0);
    for (const int level : {0, 1, 4, 12}) {
        const CurveFit found = fit(samples, level, {});
        EXPECT_LE(found.max_error, 1e-9) << level;
        for (const double u : {0.0, 0.3, 0.5, 1.0}) {
            const std::vector<double> on = point_at(found.control, Ends::kOpen, u);
            EXPECT_NEAR(on[0], 1 + 4 * u, 1e-6) << level;
            EXPECT_NEAR(on[1], 2 - 8 * u, 1e-6) << level;
            EXPECT_NEAR(on[2], 10 + 20 * u, 1e-6) << level;
        }
    }
}

TEST(Fit, OfAStrokeOfNoLengthIsItsPoint) {
    for (const Ends ends : {Ends::kOpen, Ends::kClosed}) {
        const Points samples = rows({{3, 4}, {3, 4}, {3, 4}});
        FitOptions options;
        options.ends = ends;
        const CurveFit found = fit_within(samples, 0, options);
        EXPECT_EQ(found.max_error, 0);
        EXPECT_EQ(found.level, ends == Ends::kClosed ? kLeastClosedFitLevel : 0);
        for (std::size_t i = 0; i < found.control.size(); ++i)
            EXPECT_THAT(found.control[i], ElementsAre(3, 4));
    }
}

TEST(Fit, FewAndRepeatedSamplesStayWithinTheirBoxOrNearIt) {
    std::mt19937 random(6);
    for (std::size_t count = 2; count <= 12; ++count) {
        for (const Ends ends : {Ends::kOpen, Ends::kClosed}) {
            Points samples = random_points(count, 2, unsigned(count));
            for (std::size_t i = 1; i < count; ++i) {
                if (random() % 3 == 0)
                    std::ranges::copy(samples[i - 1], samples[i].begin());
            }
            for (const int level : {0, 2, 3, 6, 12}) {
                FitOptions options;
                options.ends = ends;
                const CurveFit found = fit(samples, level, options);
                ASSERT_TRUE(all_finite(found)) << count << " at " << level;
                for (const double number : found.control.numbers())
                    EXPECT_LE(std::fabs(number), 2000) << count << " at " << level;
            }
        }
    }
}

TEST(Fit, APenThatRestsDoesNotSpoilTheRest) {
    // 200,000 samples where the pen rested; the stroke itself has 4.
    Points samples(200'003, 2);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double x = i == 0 ? 0 : i <= 200'000 ? 1 : double(i - 199'999);
        samples[i][0] = x;
        samples[i][1] = 2 * x;
    }
    FitOptions options;
    options.rounds = 0;
    const CurveFit found = fit(samples, 8, options);
    EXPECT_LE(found.max_error, 1e-3);
    for (std::size_t i = 0; i < found.control.size(); ++i) {
        EXPECT_NEAR(found.control[i][1], 2 * found.control[i][0], 1e-6) << i;
        EXPECT_GE(found.control[i][0], -0.1);
        EXPECT_LE(found.control[i][0], 3.1);
    }
}

TEST(Fit, DoesNotDependOnPlaceAndSize) {
    const Points samples = wiggle(200, 2, 0.9);
    const CurveFit found = fit(samples, 4, {});
    for (const double size : {1e-120, 1e-3, 1e150, 1e306}) {
        Points other = samples;
        for (double& number : other.numbers()) number *= size;
        const CurveFit scaled = fit(other, 4, {});
        ASSERT_TRUE(all_finite(scaled)) << size;
        EXPECT_NEAR(scaled.max_error / size, found.max_error, 1e-9) << size;
        for (std::size_t i = 0; i < found.control.size(); ++i)
            EXPECT_NEAR(scaled.control[i][0] / size, found.control[i][0], 1e-9) << size;
    }
    EXPECT_TRUE(all_finite(fit(rows({{-1.7e308, 1e308}, {1.7e308, -1e308}}), 2, {})));
    EXPECT_TRUE(all_finite(fit(rows({{0, 0}, {5e-324, 0}, {1e-310, 5e-324}}), 2, {})));
}

TEST(Fit, OfAClosedStrokeHasNoSeam) {
    // The same loop begun elsewhere gives the same curve, as far as parameters begin
    // elsewhere too: at a knot.
    const std::size_t count = 640;
    const Points samples = wiggle(count, 2);
    FitOptions options;
    options.ends = Ends::kClosed;
    const CurveFit found = fit_within(samples, 0.05, options);
    EXPECT_LE(found.max_error, 0.05);
    const std::vector<double> start = point_at(found.control, Ends::kClosed, 0);
    const std::vector<double> end = point_at(found.control, Ends::kClosed, 1);
    EXPECT_NEAR(start[0], end[0], 1e-12);
    // Half way between the last sample and the first the curve still is on the loop.
    const double a = -kPi / double(count);
    const std::vector<double> between =
        point_at(found.control, Ends::kClosed, 1 - 0.5 / double(count));
    const double radius = 100 + 20 * std::sin(3 * a);
    EXPECT_NEAR(std::hypot(between[0], between[1]), radius, 0.1);
}

TEST(Fit, OfAClosedStrokeThatRepeatsItsStartIsTheSame) {
    const Points samples = wiggle(100, 2);
    Points repeated(101, 2);
    std::ranges::copy(samples.numbers(), repeated.numbers().begin());
    std::ranges::copy(samples[0], repeated[100].begin());
    FitOptions options;
    options.ends = Ends::kClosed;
    options.rounds = 0;
    const CurveFit one = fit(samples, 4, options);
    const CurveFit other = fit(repeated, 4, options);
    EXPECT_EQ(other.parameters.back(), 1);
    for (std::size_t i = 0; i < one.control.size(); ++i)
        EXPECT_NEAR(one.control[i][0], other.control[i][0], 0.2) << i;
}

TEST(Fit, CarriesPressureThrough) {
    // A pen stroke: x, y and the thickness that pressure gave, which rises and falls.
    Points samples(500, 3);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double t = double(i) / 499;
        samples[i][0] = 300 * t;
        samples[i][1] = 40 * std::sin(6 * t);
        samples[i][2] = 1 + 7 * std::sin(kPi * t);
    }
    const CurveFit found = fit_within(samples, 0.05, {});
    ASSERT_EQ(found.control.dimension(), 3);
    for (std::size_t i = 0; i < samples.size(); i += 7) {
        const std::vector<double> on =
            point_at(found.control, Ends::kOpen, found.parameters[i]);
        EXPECT_NEAR(on[2], samples[i][2], 0.05) << i;
    }
    // Thickness decides neither parameters nor errors: the plane alone has the same ones.
    Points plane(samples.size(), 2);
    for (std::size_t i = 0; i < samples.size(); ++i)
        std::ranges::copy(samples[i].first(2), plane[i].begin());
    const CurveFit flat = fit_within(plane, 0.05, {});
    EXPECT_EQ(flat.level, found.level);
    EXPECT_EQ(flat.parameters, found.parameters);
    EXPECT_EQ(flat.max_error, found.max_error);
}

TEST(StrokeParameters, AreTheDistancesAlongTheStroke) {
    const Points samples = rows({{0, 0}, {3, 4}, {3, 4}, {3, 14}});
    EXPECT_THAT(stroke_parameters(samples, Ends::kOpen, Spacing::kChordLength),
                Pointwise(DoubleNear(1e-15), {0.0, 1.0 / 3, 1.0 / 3, 1.0}));
    const double a = std::sqrt(5.0), b = std::sqrt(10.0);
    EXPECT_THAT(stroke_parameters(samples, Ends::kOpen, Spacing::kCentripetal),
                Pointwise(DoubleNear(1e-15), {0.0, a / (a + b), a / (a + b), 1.0}));
    const Points square = rows({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    EXPECT_THAT(stroke_parameters(square, Ends::kClosed, Spacing::kChordLength),
                Pointwise(DoubleNear(1e-15), {0.0, 0.25, 0.5, 0.75}));
}

TEST(StrokeParameters, OfAStrokeOfNoLengthAreEven) {
    const Points samples = rows({{3, 4}, {3, 4}, {3, 4}});
    EXPECT_THAT(stroke_parameters(samples, Ends::kOpen, Spacing::kChordLength),
                ElementsAre(0, 0.5, 1));
    EXPECT_THAT(stroke_parameters(samples, Ends::kClosed, Spacing::kChordLength),
                Pointwise(DoubleNear(1e-15), {0.0, 1.0 / 3, 2.0 / 3}));
}

}  // namespace
}  // namespace haarmony::curve
