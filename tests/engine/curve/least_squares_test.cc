#include "engine/curve/least_squares.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace haarmony::curve {
namespace {

// The cubic B-spline over five knots by the recursion of its definition.
double recursive(const std::vector<double>& knots, std::size_t i, int degree, double u) {
    if (degree == 0) return knots[i] <= u && u < knots[i + 1] ? 1 : 0;
    const auto part = [](double above, double below) {
        return below > 0 ? above / below : 0.0;
    };
    const std::size_t d = std::size_t(degree);
    return part(u - knots[i], knots[i + d] - knots[i]) *
               recursive(knots, i, degree - 1, u) +
           part(knots[i + d + 1] - u, knots[i + d + 1] - knots[i + 1]) *
               recursive(knots, i + 1, degree - 1, u);
}

// All basis functions at u, as a dense row.
std::vector<double> dense_row(int level, Ends ends, double u) {
    const std::size_t segments = segment_count(level);
    std::vector<double> row(control_count(level, ends));
    std::vector<double> knots;
    if (ends == Ends::kOpen) {
        knots.assign(3, 0.0);
        for (std::size_t i = 0; i <= segments; ++i) knots.push_back(double(i));
        knots.insert(knots.end(), 3, double(segments));
        const double at = std::min(u * double(segments), double(segments) * (1 - 1e-16));
        for (std::size_t i = 0; i < row.size(); ++i) row[i] = recursive(knots, i, 3, at);
        return row;
    }
    // Function i peaks at i: copies of it stand at all whole numbers of turns.
    for (int k = -2; k <= 2; ++k) knots.push_back(k);
    for (std::size_t i = 0; i < segments; ++i) {
        for (int turn = -5; turn <= 5; ++turn) {
            row[i] += recursive(knots, 0, 3, (u - turn) * double(segments) - double(i));
        }
    }
    return row;
}

// Gaussian elimination with pivoting.
std::vector<double> eliminated(std::vector<std::vector<double>> a,
                               std::vector<double> b) {
    const std::size_t n = b.size();
    for (std::size_t i = 0; i < n; ++i) {
        std::size_t pivot = i;
        for (std::size_t k = i; k < n; ++k)
            if (std::fabs(a[k][i]) > std::fabs(a[pivot][i])) pivot = k;
        std::swap(a[i], a[pivot]);
        std::swap(b[i], b[pivot]);
        for (std::size_t k = i + 1; k < n; ++k) {
            const double factor = a[k][i] / a[i][i];
            for (std::size_t c = i; c < n; ++c) a[k][c] -= factor * a[i][c];
            b[k] -= factor * b[i];
        }
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t c = i + 1; c < n; ++c) b[i] -= a[i][c] * b[c];
        b[i] /= a[i][i];
    }
    return b;
}

struct Sample {
    double u;
    double value;
};

std::vector<Sample> random_samples(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Sample> samples;
    for (std::size_t i = 0; i < count; ++i)
        samples.push_back({unit(random), 2 * unit(random) - 1});
    return samples;
}

Points solved(int level, Ends ends, const std::vector<Sample>& samples) {
    LeastSquares squares(level, ends, 1);
    for (const Sample& sample : samples)
        squares.add(sample.u, std::span(&sample.value, 1), 1);
    return squares.solve({}, {});
}

TEST(LeastSquares, IsThatOfDenseNormalEquations) {
    for (const Ends ends : {Ends::kOpen, Ends::kClosed}) {
        for (int level = 0; level <= 5; ++level) {
            const std::size_t n = control_count(level, ends);
            const std::vector<Sample> samples =
                random_samples(40 * n, unsigned(level) + 1);
            std::vector<std::vector<double>> a(n, std::vector<double>(n));
            std::vector<double> b(n);
            for (const Sample& sample : samples) {
                const std::vector<double> row = dense_row(level, ends, sample.u);
                for (std::size_t i = 0; i < n; ++i) {
                    b[i] += row[i] * sample.value;
                    for (std::size_t k = 0; k < n; ++k) a[i][k] += row[i] * row[k];
                }
            }
            // The uniform curve of two wrapped points needs no more: its two functions differ.
            const std::vector<double> expected = eliminated(a, b);
            const Points control = solved(level, ends, samples);
            for (std::size_t i = 0; i < n; ++i)
                EXPECT_NEAR(control[i][0], expected[i], 1e-11)
                    << "level " << level << ", closed " << (ends == Ends::kClosed)
                    << ", point " << i;
        }
    }
}

TEST(LeastSquares, AWeightIsThatManyPoints) {
    const std::vector<Sample> samples = random_samples(60, 8);
    LeastSquares weighted(2, Ends::kOpen, 1);
    LeastSquares repeated(2, Ends::kOpen, 1);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const std::span<const double> value(&samples[i].value, 1);
        weighted.add(samples[i].u, value, double(i % 4 + 1));
        for (std::size_t k = 0; k <= i % 4; ++k) repeated.add(samples[i].u, value, 1);
    }
    const Points one = weighted.solve({}, {});
    const Points other = repeated.solve({}, {});
    for (std::size_t i = 0; i < one.size(); ++i)
        EXPECT_NEAR(one[i][0], other[i][0], 1e-12);
}

TEST(LeastSquares, PinnedEndsAreFixedAndTheRestIsTheBestForThem) {
    const int level = 3;
    const std::size_t n = control_count(level, Ends::kOpen);
    const std::vector<Sample> samples = random_samples(300, 9);
    const double first = 0.25, last = -0.5;
    // The inner unknowns alone, with what the ends explain taken off the values.
    std::vector<std::vector<double>> a(n - 2, std::vector<double>(n - 2));
    std::vector<double> b(n - 2);
    LeastSquares squares(level, Ends::kOpen, 1);
    for (const Sample& sample : samples) {
        squares.add(sample.u, std::span(&sample.value, 1), 1);
        const std::vector<double> row = dense_row(level, Ends::kOpen, sample.u);
        const double rest = sample.value - row[0] * first - row[n - 1] * last;
        for (std::size_t i = 1; i + 1 < n; ++i) {
            b[i - 1] += row[i] * rest;
            for (std::size_t k = 1; k + 1 < n; ++k) a[i - 1][k - 1] += row[i] * row[k];
        }
    }
    const std::vector<double> expected = eliminated(a, b);
    const Points control = squares.solve(std::span(&first, 1), std::span(&last, 1));
    EXPECT_EQ(control[0][0], first);
    EXPECT_EQ(control[n - 1][0], last);
    for (std::size_t i = 1; i + 1 < n; ++i)
        EXPECT_NEAR(control[i][0], expected[i - 1], 1e-11) << i;
}

TEST(LeastSquares, WhatNoPointSeesIsStraight) {
    // Points near the ends of a curve of 1024 segments: between them control points are
    // linear in the means of their knots, and so is the curve in u.
    std::vector<Sample> samples;
    for (int i = 0; i <= 80; ++i) {
        const double u = i / 8192.0;
        samples.push_back({u, 1 - u});
        samples.push_back({1 - u, u});
    }
    const Points control = solved(10, Ends::kOpen, samples);
    for (std::size_t i = 3; i + 3 < control.size(); ++i)
        EXPECT_NEAR(control[i][0], 1 - (double(i) - 1) / 1024, 1e-9) << i;
}

TEST(LeastSquares, OnePointIsACurveThatStaysThere) {
    for (const Ends ends : {Ends::kOpen, Ends::kClosed}) {
        for (const int level : {0, 1, 2, 7}) {
            const Points control = solved(level, ends, {{0.3, 0.7}});
            for (const double number : control.numbers())
                EXPECT_NEAR(number, 0.7, 1e-6) << level;
        }
    }
}

// The line between the two parameters falls by 1/128 from one control point to the next.
TEST(LeastSquares, AHeavyPointDoesNotSpoilTheRest) {
    LeastSquares squares(8, Ends::kOpen, 1);
    const double heavy = 0.5, light = -0.5;
    squares.add(0.4, std::span(&heavy, 1), 1e6);
    squares.add(0.9, std::span(&light, 1), 1);
    const Points control = squares.solve({}, {});
    for (const double number : control.numbers()) {
        EXPECT_LE(number, 0.5 + 0.02);
        EXPECT_GE(number, -0.5 - 0.02);
    }
}

}  // namespace
}  // namespace haarmony::curve
