#include "engine/curve/multires_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/curve/bspline_filters.h"
#include "tests/engine/curve/dense_spline.h"
#include "tests/engine/curve/gauss.h"

namespace haarmony::curve {
namespace {

constexpr Ends kBothEnds[] = {Ends::kOpen, Ends::kClosed};

double size_of(const Points& points) {
    double most = 0;
    for (const double number : points.numbers()) most = std::max(most, std::abs(number));
    return most;
}

// Row i of the result is row (i + by) modulo the count.
Points rotated(const Points& points, std::size_t by) {
    Points result(points.size(), points.dimension());
    for (std::size_t i = 0; i < points.size(); ++i)
        std::ranges::copy(points[(i + by) % points.size()], result[i].begin());
    return result;
}

Points reversed(const Points& points) {
    Points result(points.size(), points.dimension());
    for (std::size_t i = 0; i < points.size(); ++i)
        std::ranges::copy(points[points.size() - 1 - i], result[i].begin());
    return result;
}

// The least squares projection to a coarser level by its definition: basis functions by
// recursion, inner products by Gauss quadrature on the finer segments, elimination.
Points projected(const Points& control, Ends ends, int fine, int coarse) {
    const std::size_t points = control_count(coarse, ends);
    const auto dimension = std::size_t(control.dimension());
    // <Phi | Phi> and, beside it, <Phi | f>.
    dense::Matrix equations(points, std::vector<double>(points + dimension));
    const std::size_t segments = segment_count(fine);
    struct Value {
        std::size_t index;
        double value;
    };
    // The only functions that are not 0 on a segment are four in a row.
    const auto values_at = [&](int level, double u) {
        const std::size_t count = control_count(level, ends);
        const auto segment = std::size_t(u * double(segment_count(level)));
        std::vector<Value> values;
        for (std::size_t i = 0; i < std::min(count, std::size_t{4}); ++i) {
            const std::size_t index =
                (segment + i + (ends == Ends::kOpen ? 0 : count - 1)) % count;
            values.push_back({index, dense::basis(level, ends, index, u)});
        }
        return values;
    };
    for (std::size_t s = 0; s < segments; ++s) {
        for (std::size_t k = 0; k < 4; ++k) {
            const double u = (double(s) + 0.5 + 0.5 * kGaussPlace[k]) / double(segments);
            const double weight = kGaussWeight[k] / (2 * double(segments));
            const std::vector<Value> coarse_values = values_at(coarse, u);
            std::vector<double> at(dimension);
            for (const Value& value : values_at(fine, u))
                for (std::size_t d = 0; d < dimension; ++d)
                    at[d] += value.value * control[value.index][d];
            for (const Value& a : coarse_values) {
                for (const Value& b : coarse_values)
                    equations[a.index][b.index] += weight * a.value * b.value;
                for (std::size_t d = 0; d < dimension; ++d)
                    equations[a.index][points + d] += weight * a.value * at[d];
            }
        }
    }
    for (std::size_t c = 0; c < points; ++c) {
        for (std::size_t r = 0; r < points; ++r) {
            const double factor = r == c ? 0 : equations[r][c] / equations[c][c];
            if (factor == 0) continue;
            for (std::size_t k = c; k < points + dimension; ++k)
                equations[r][k] -= factor * equations[c][k];
        }
    }
    Points result(points, control.dimension());
    for (std::size_t r = 0; r < points; ++r)
        for (std::size_t d = 0; d < dimension; ++d)
            result[r][d] = equations[r][points + d] / equations[r][r];
    return result;
}

TEST(MultiresCurve, EveryLevelIsTheDenseProjection) {
    for (const Ends ends : kBothEnds) {
        for (int level = 1; level <= 8; ++level) {
            const Points control = dense::random_curve(level, ends, 2, unsigned(level));
            const MultiresCurve curve = decompose(control, ends);
            ASSERT_EQ(curve.level(), level);
            for (int j = 0; j < level; ++j)
                EXPECT_LT(dense::distance(reconstruct(curve, j),
                                          projected(control, ends, level, j)),
                          1e-13 * size_of(control))
                    << int(ends) << ": " << j << " of " << level;
        }
    }
}

TEST(MultiresCurve, DetailsAreWhatTheProjectionLeaves) {
    for (const Ends ends : kBothEnds) {
        for (int level = 1; level <= 6; ++level) {
            const Points control =
                dense::random_curve(level, ends, 3, unsigned(level + 50));
            const AnalysisStep step = analyze(control, ends);
            ASSERT_EQ(step.detail.size(), segment_count(level - 1));
            const Points sweep =
                dense::refine(dense::project(control, ends, level - 1), ends, level);
            const Points rest = dense::sum(control, -1, sweep);
            Points of_details(control.size(), control.dimension());
            for (std::size_t k = 0; k < step.detail.size(); ++k) {
                const Filter wavelet = wavelet_column(level, ends, k);
                for (std::size_t i = 0; i < std::size_t(wavelet.count); ++i)
                    for (std::size_t d = 0; d < 3; ++d)
                        of_details[(wavelet.first + i) % control.size()][d] +=
                            wavelet.value[i] * step.detail[k][d];
            }
            EXPECT_LT(dense::distance(of_details, rest), 1e-11)
                << int(ends) << ", " << level;
        }
    }
}

TEST(MultiresCurve, ReconstructsWhatItDecomposed) {
    for (const Ends ends : kBothEnds) {
        for (int level = 0; level <= 14; ++level) {
            const int dimension = level % kMostDimensions + 1;
            const Points control =
                dense::random_curve(level, ends, dimension, unsigned(level));
            const Points again = reconstruct(decompose(control, ends));
            EXPECT_LT(dense::distance(again, control), 1e-13 * size_of(control))
                << int(ends) << ", " << level;
        }
    }
}

// Beyond what dense matrices can do: what is left is orthogonal to every coarser function.
TEST(MultiresCurve, DetailsOfLongCurvesAreOrthogonalToTheSweep) {
    for (const Ends ends : kBothEnds) {
        for (const int level : {9, 10, 13}) {
            const Points control = dense::random_curve(level, ends, 1, unsigned(level));
            const AnalysisStep step = analyze(control, ends);
            const Points rest =
                synthesize(Points(step.coarse.size(), 1), step.detail, ends);
            const std::size_t count = control.size();
            double worst = 0;
            for (std::size_t c = 0; c < step.coarse.size(); ++c) {
                const Filter coarse = refinement_column(level, ends, c);
                double inner = 0;
                for (std::size_t i = 0; i < std::size_t(coarse.count); ++i) {
                    const GramRow gram =
                        gram_row(level, ends, (coarse.first + i) % count);
                    for (std::size_t k = 0; k < std::size_t(gram.count); ++k)
                        inner += coarse.value[i] * gram.value[k] *
                                 rest[(gram.first + k) % count][0];
                }
                worst = std::max(worst, std::abs(inner));
            }
            EXPECT_LT(worst * std::ldexp(1, level), 1e-13 * size_of(control))
                << int(ends) << ", " << level;
        }
    }
}

TEST(MultiresCurve, IsLinear) {
    for (const Ends ends : kBothEnds) {
        const Points a = dense::random_curve(9, ends, 2, 1);
        const Points b = dense::random_curve(9, ends, 2, 2);
        const MultiresCurve of_sum = decompose(dense::sum(a, -3, b), ends);
        const MultiresCurve of_a = decompose(a, ends);
        const MultiresCurve of_b = decompose(b, ends);
        EXPECT_LT(
            dense::distance(of_sum.coarse, dense::sum(of_a.coarse, -3, of_b.coarse)),
            1e-10);
        for (std::size_t j = 0; j < 9; ++j)
            EXPECT_LT(dense::distance(of_sum.details[j],
                                      dense::sum(of_a.details[j], -3, of_b.details[j])),
                      1e-10)
                << j;
    }
}

TEST(MultiresCurve, ReversedItHasReversedDetails) {
    for (int level = 1; level <= 10; ++level) {
        const Points control = dense::random_curve(level, Ends::kOpen, 2, 7);
        const MultiresCurve curve = decompose(control, Ends::kOpen);
        const MultiresCurve back = decompose(reversed(control), Ends::kOpen);
        EXPECT_LT(dense::distance(back.coarse, reversed(curve.coarse)), 1e-11) << level;
        for (std::size_t j = 0; j < std::size_t(level); ++j)
            EXPECT_LT(dense::distance(back.details[j], reversed(curve.details[j])), 1e-11)
                << level << ", " << j;
    }
}

TEST(MultiresCurve, ClosedItDoesNotMatterWhereItBegins) {
    for (int level = 1; level <= 10; ++level) {
        const Points control = dense::random_curve(level, Ends::kClosed, 2, 8);
        const AnalysisStep step = analyze(control, Ends::kClosed);
        for (std::size_t by = 1; by < segment_count(level - 1); by *= 3) {
            const AnalysisStep turned = analyze(rotated(control, 2 * by), Ends::kClosed);
            EXPECT_LT(dense::distance(turned.coarse, rotated(step.coarse, by)), 1e-11)
                << level << ", " << by;
            EXPECT_LT(dense::distance(turned.detail, rotated(step.detail, by)), 1e-11)
                << level << ", " << by;
        }
    }
}

TEST(MultiresCurve, ACoarseCurveHasNoDetails) {
    for (const Ends ends : kBothEnds) {
        for (int level = 1; level <= 10; ++level) {
            Points control = dense::random_curve(level - 1, ends, 2, 9);
            const Points finer = synthesize(control, {}, ends);
            const AnalysisStep step = analyze(finer, ends);
            EXPECT_LT(size_of(step.detail), 1e-13 * size_of(control)) << level;
            EXPECT_LT(dense::distance(step.coarse, control), 1e-13 * size_of(control))
                << level;
        }
    }
}

TEST(MultiresCurve, StepsAndWholeAgreeExactly) {
    for (const Ends ends : kBothEnds) {
        const Points control = dense::random_curve(7, ends, 2, 10);
        const MultiresCurve curve = decompose(control, ends);
        Points sweep = control;
        for (std::size_t j = 7; j-- > 0;) {
            const AnalysisStep step = analyze(sweep, ends);
            EXPECT_EQ(step.detail, curve.details[j]) << j;
            sweep = step.coarse;
        }
        EXPECT_EQ(sweep, curve.coarse);
        for (std::size_t j = 0; j < 7; ++j) {
            sweep = synthesize(sweep, curve.details[j], ends);
            EXPECT_EQ(sweep, reconstruct(curve, int(j) + 1)) << j;
        }
    }
}

// From the reference with exact rational arithmetic: level 1 by hand. The jump of (0, 0, 1,
// 0, 0) is 2, that of the wavelet (1, -2, 3, -2, 1) * sqrt 7 is 16 sqrt 7.
TEST(MultiresCurve, FirstLevelByHand) {
    Points control(5, 1);
    control[2][0] = 1;
    const AnalysisStep step = analyze(control, Ends::kOpen);
    EXPECT_NEAR(step.detail[0][0], 1 / (8 * std::sqrt(7)), 1e-16);
    const double coarse[] = {-0.125, 0.625, 0.625, -0.125};
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(step.coarse[i][0], coarse[i], 1e-15) << i;
}

}  // namespace
}  // namespace haarmony::curve
