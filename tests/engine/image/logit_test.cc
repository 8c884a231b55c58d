#include "engine/image/logit.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace haarmony::image {
namespace {

LogitRows rows_of(int features,
                  const std::vector<std::vector<double>>& rows,
                  const std::vector<std::uint8_t>& outcomes) {
    LogitRows result{features, {}, outcomes};
    for (const auto& row : rows) {
        result.values.insert(result.values.end(), row.begin(), row.end());
    }
    return result;
}

// Standard normal, from bits alone: the same with every standard library.
double normal(std::mt19937_64& random) {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(random() >> 11) * 0x1p-53;
    return sum;
}

double uniform(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) * 0x1p-53;
}

// Rows whose outcomes are drawn with the probabilities of a known model.
LogitRows drawn(std::uint64_t seed,
                int count,
                double intercept,
                const std::vector<double>& weights) {
    std::mt19937_64 random(seed);
    LogitRows rows{static_cast<int>(weights.size()), {}, {}};
    for (int i = 0; i < count; ++i) {
        double eta = intercept;
        for (const double weight : weights) {
            rows.values.push_back(normal(random));
            eta += weight * rows.values.back();
        }
        rows.outcomes.push_back(uniform(random) < 1 / (1 + std::exp(-eta)) ? 1 : 0);
    }
    return rows;
}

// What is maximised, written down from its definition.
double penalized(const LogitRows& rows,
                 const LogitOptions& options,
                 double intercept,
                 const std::vector<double>& weights) {
    double sum = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        double eta = intercept;
        for (int k = 0; k < rows.features; ++k) {
            eta += weights[k] * rows.values[i * rows.features + k];
        }
        const double p = std::exp(eta) / (1 + std::exp(eta));
        sum += std::log(rows.outcomes[i] == 1 ? p : 1 - p);
    }
    // The part along the direction, then what is left of each weight.
    double dot = 0;
    double square = 0;
    for (std::size_t k = 0; k < options.direction.size(); ++k) {
        dot += weights[k] * options.direction[k];
        square += options.direction[k] * options.direction[k];
    }
    double along = 0;
    double across = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
        const double part =
            options.direction.empty() ? 0 : dot / square * options.direction[k];
        along += part * part;
        across += (weights[k] - part) * (weights[k] - part);
    }
    return sum - options.ridge / 2 * (across + along / 1000);
}

// The gradient of penalized() by differences; its error is about 1e-8 of the curvature.
std::vector<double> gradient_at(const LogitRows& rows,
                                const LogitOptions& options,
                                const LogitFit& fit) {
    constexpr double kStep = 1e-5;
    std::vector<double> gradient;
    for (int k = -1; k < rows.features; ++k) {
        std::array<double, 2> value{};
        for (const int side : {0, 1}) {
            double intercept = fit.intercept;
            std::vector<double> weights = fit.weights;
            (k < 0 ? intercept : weights[k]) += side == 0 ? -kStep : kStep;
            value[side] = penalized(rows, options, intercept, weights);
        }
        gradient.push_back((value[1] - value[0]) / (2 * kStep));
    }
    return gradient;
}

TEST(Logit, FindsTheModelThatTheOutcomesWereDrawnFrom) {
    const std::vector<double> truth{1.5, -0.7, 0.0};
    const LogitRows rows = drawn(1, 20'000, -1.0, truth);
    const LogitFit fit = fit_logit(rows, {.ridge = 1e-6});
    ASSERT_TRUE(fit.converged);
    EXPECT_NEAR(fit.intercept, -1.0, 0.08);
    for (int k = 0; k < 3; ++k) {
        ASSERT_GT(fit.standard_errors[k], 0);
        EXPECT_LT(fit.standard_errors[k], 0.04);
        EXPECT_NEAR(fit.weights[k], truth[k], 4 * fit.standard_errors[k]) << k;
    }
    EXPECT_GT(fit.log_likelihood, fit.null_log_likelihood);
}

TEST(Logit, GradientIsZeroAtTheOptimum) {
    for (const std::uint64_t seed : {2, 3, 4}) {
        const LogitRows rows = drawn(seed, 300, 0.5, {2.0, -1.0, 0.3, 0.1});
        const LogitOptions options{.ridge = 2, .direction = {1.0, 0.0, -1.0, 0.5}};
        const LogitFit fit = fit_logit(rows, options);
        ASSERT_TRUE(fit.converged);
        for (const double slope : gradient_at(rows, options, fit)) {
            EXPECT_NEAR(slope, 0, 1e-5) << seed;
        }
    }
}

TEST(Logit, AgreesWithASearchOfThePlane) {
    const LogitRows rows = rows_of(1, {{0}, {1}, {2}, {3}, {4}}, {0, 0, 1, 0, 1});
    const LogitOptions options{.ridge = 0.5};
    const LogitFit fit = fit_logit(rows, options);

    // Ever finer grids around the best point: no derivative, no matrix.
    double intercept = 0;
    double weight = 0;
    for (double width = 8; width > 1e-7; width /= 2) {
        double best = -INFINITY;
        const double center_i = intercept;
        const double center_w = weight;
        for (int i = -8; i <= 8; ++i) {
            for (int j = -8; j <= 8; ++j) {
                const double at_i = center_i + i * width / 4;
                const double at_w = center_w + j * width / 4;
                const double value = penalized(rows, options, at_i, {at_w});
                if (value > best) {
                    best = value;
                    intercept = at_i;
                    weight = at_w;
                }
            }
        }
    }
    EXPECT_NEAR(fit.intercept, intercept, 1e-5);
    EXPECT_NEAR(fit.weights[0], weight, 1e-5);
}

TEST(Logit, NullModelIsTheShareOfMatches) {
    const LogitRows rows = rows_of(1, {{0}, {0}, {0}, {0}}, {1, 0, 0, 0});
    const LogitFit fit = fit_logit(rows, {});
    EXPECT_NEAR(fit.intercept, std::log(1.0 / 3.0), 1e-9);
    EXPECT_EQ(fit.weights[0], 0);
    EXPECT_NEAR(fit.log_likelihood, std::log(0.25) + 3 * std::log(0.75), 1e-12);
    EXPECT_NEAR(fit.null_log_likelihood, fit.log_likelihood, 1e-12);
}

TEST(Logit, PerfectSeparationStaysFinite) {
    const LogitRows rows = rows_of(1, {{-2000}, {-1000}, {1000}, {2000}}, {0, 0, 1, 1});
    for (const double ridge : {1e-9, 1e-3, 1.0, 1e3}) {
        const LogitOptions options{.ridge = ridge};
        const LogitFit fit = fit_logit(rows, options);
        ASSERT_TRUE(fit.converged) << ridge;
        EXPECT_TRUE(std::isfinite(fit.intercept));
        EXPECT_GT(fit.weights[0], 0);
        EXPECT_TRUE(std::isfinite(fit.weights[0]));
        EXPECT_TRUE(std::isfinite(fit.standard_errors[0]));
        EXPECT_NEAR(fit.intercept, 0, 1e-3);  // by symmetry
    }
}

TEST(Logit, ZeroAndRepeatedColumnsAreNoTrouble) {
    const LogitRows plain = drawn(5, 400, 0.0, {1.2});
    LogitRows wide{3, {}, plain.outcomes};  // the feature twice, and one never used
    for (const double value : plain.values) {
        wide.values.insert(wide.values.end(), {value, value, 0.0});
    }
    // Two equal weights w pay half the ridge that one weight 2 w pays.
    const LogitFit one = fit_logit(plain, {.ridge = 1});
    const LogitFit three = fit_logit(wide, {.ridge = 2});
    ASSERT_TRUE(three.converged);
    EXPECT_NEAR(three.weights[0], three.weights[1], 1e-9);
    EXPECT_NEAR(three.weights[0] + three.weights[1], one.weights[0], 1e-7);
    EXPECT_EQ(three.weights[2], 0);  // nothing but the ridge says anything about it
    EXPECT_NEAR(three.log_likelihood, one.log_likelihood, 1e-7);
}

TEST(Logit, ManyMoreMismatchesThanMatches) {
    std::mt19937_64 random(6);
    LogitRows rows{2, {}, {}};
    for (int i = 0; i < 8585; ++i) {
        const bool match = i < 85;
        rows.values.push_back(normal(random) + (match ? 2.0 : 0.0));
        rows.values.push_back(normal(random));
        rows.outcomes.push_back(match ? 1 : 0);
    }
    const LogitOptions options{.ridge = 1e-3};
    const LogitFit fit = fit_logit(rows, options);
    ASSERT_TRUE(fit.converged);
    EXPECT_LT(fit.iterations, 20);
    // Normals one unit wide and two apart: the weight is 2, the intercept log(85 / 8500)
    // less half the square of the difference.
    EXPECT_NEAR(fit.weights[0], 2.0, 0.4);
    EXPECT_NEAR(fit.intercept, std::log(0.01) - 2.0, 0.5);
    EXPECT_NEAR(fit.weights[1], 0.0, 0.3);
    for (const double slope : gradient_at(rows, options, fit))
        EXPECT_NEAR(slope, 0, 1e-5);
}

TEST(Logit, AStrongRidgeKeepsTheDirectionAndLeavesItsLength) {
    const LogitRows rows = drawn(7, 2000, 0.0, {2.0, 1.0});
    const LogitFit fit = fit_logit(rows, {.ridge = 1e7, .direction = {30.0, 15.0}});
    ASSERT_TRUE(fit.converged);
    EXPECT_NEAR(fit.weights[0], 2 * fit.weights[1], 1e-3);
    EXPECT_GT(fit.weights[0], 0);
    // A ridge of 1e7 / 1000 still weighs on the length; one of 10 does not.
    const LogitFit free = fit_logit(rows, {.ridge = 10, .direction = {30.0, 15.0}});
    EXPECT_NEAR(free.weights[0], 2.0, 0.3);
    EXPECT_NEAR(free.weights[1], 1.0, 0.15);
}

TEST(Logit, AColumnNeverUsedFollowsTheDirection) {
    LogitRows rows{2, {}, {}};
    const LogitRows plain = drawn(14, 400, 0.0, {1.2});
    for (const double value : plain.values) {
        rows.values.insert(rows.values.end(), {value, 0.0});
    }
    rows.outcomes = plain.outcomes;
    const LogitFit fit = fit_logit(rows, {.ridge = 0.1, .direction = {2.0, 1.0}});
    ASSERT_TRUE(fit.converged);
    EXPECT_NEAR(fit.weights[1], fit.weights[0] / 2, 0.01);
    EXPECT_NEAR(fit.weights[0], 1.2, 0.3);
}

TEST(Logit, StopsAfterTheIterationsItMayTake) {
    const LogitRows rows = drawn(8, 200, 0.0, {2.0});
    const LogitFit fit = fit_logit(rows, {.ridge = 1e-3, .max_iterations = 1});
    EXPECT_EQ(fit.iterations, 1);
    EXPECT_FALSE(fit.converged);
}

TEST(Logit, BoundsHoldAndTheRestIsFittedAnew) {
    for (const std::uint64_t seed : {9, 10, 11, 12}) {
        const LogitRows rows = drawn(seed, 500, 0.3, {1.0, -0.8, 0.05, -0.05});
        const LogitOptions options{
            .ridge = 0.1, .direction = {1, 1, 1, 1}, .lower = {0, 0, 0, 0}};
        const LogitFit fit = fit_logit(rows, options);
        ASSERT_TRUE(fit.converged) << seed;

        // Optimal under the bounds: where a weight is free the slope is zero, where it is
        // held the objective would only grow on the forbidden side.
        const std::vector<double> slopes = gradient_at(rows, options, fit);
        EXPECT_NEAR(slopes[0], 0, 1e-5);
        for (int k = 0; k < 4; ++k) {
            EXPECT_GE(fit.weights[k], 0);
            if (fit.at_bound[k]) {
                EXPECT_EQ(fit.weights[k], 0);
                EXPECT_LT(slopes[k + 1], 0);
                EXPECT_EQ(fit.standard_errors[k], 0);
            } else {
                EXPECT_NEAR(slopes[k + 1], 0, 1e-5) << seed << ' ' << k;
            }
        }
        EXPECT_TRUE(fit.at_bound[1]) << seed;
        EXPECT_FALSE(fit.at_bound[0]) << seed;
    }
}

TEST(Logit, BoundsThatDoNotBindChangeNothing) {
    const LogitRows rows = drawn(13, 500, 0.3, {1.0, 0.8});
    const LogitFit free = fit_logit(rows, {});
    const LogitFit bounded = fit_logit(rows, {.lower = {0, 0}});
    for (int k = 0; k < 2; ++k) EXPECT_NEAR(free.weights[k], bounded.weights[k], 1e-9);
}

TEST(Logit, TheLogisticFunctionDoesNotOverflow) {
    EXPECT_EQ(logistic(0), 0.5);
    EXPECT_EQ(logistic(1e6), 1);
    EXPECT_EQ(logistic(-1e6), 0);
    EXPECT_DOUBLE_EQ(logistic(2) + logistic(-2), 1);
}

}  // namespace
}  // namespace haarmony::image
