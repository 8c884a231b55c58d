#include "engine/curve/bspline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "tests/engine/curve/dense_spline.h"

namespace haarmony::curve {
namespace {

constexpr Ends kBothEnds[] = {Ends::kOpen, Ends::kClosed};

// Control points of one level, given by hand.
Points points_of(std::initializer_list<std::array<double, 2>> rows) {
    Points points(rows.size(), 2);
    std::size_t i = 0;
    for (const auto& row : rows) std::ranges::copy(row, points[i++].begin());
    return points;
}

std::array<double, 4> bernstein(double t) {
    const double s = 1 - t;
    return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

// Length of a polyline through many points of the curve: below the length, by 1 / n^2 but
// where it turns within a step.
double polyline_length(const Points& control,
                       Ends ends,
                       double from,
                       double to,
                       int pieces) {
    double sum = 0;
    auto last = point_at(control, ends, from);
    for (int i = 1; i <= pieces; ++i) {
        const auto next = point_at(control, ends, from + (to - from) * i / pieces);
        sum += std::hypot(next[0] - last[0], next[1] - last[1]);
        last = next;
    }
    return sum;
}

TEST(Bspline, BasisIsThatOfTheRecursion) {
    for (const Ends ends : kBothEnds) {
        for (int level = 0; level <= 6; ++level) {
            const std::size_t count = control_count(level, ends);
            for (const double u :
                 {0.0, 1e-9, 0.1, 0.125, 0.25, 1 / 3.0, 0.5, 0.77, 0.9375, 1.0}) {
                const BasisAt at = basis_at(level, ends, u);
                std::vector<double> all(count);
                for (std::size_t i = 0; i < 4; ++i)
                    all[(at.first + i) % count] += at.value[i];
                for (std::size_t i = 0; i < count; ++i)
                    EXPECT_NEAR(all[i], dense::basis(level, ends, i, u), 1e-14)
                        << int(ends) << ", level " << level << ", u " << u << ": " << i;
            }
        }
    }
}

TEST(Bspline, PointsAndSlopesAreThoseOfTheRecursion) {
    for (const Ends ends : kBothEnds) {
        for (int level = 0; level <= 5; ++level) {
            const Points control = dense::random_curve(level, ends, 3, unsigned(level));
            for (const double u : {0.0, 0.07, 0.31, 0.5, 0.83, 1.0}) {
                const auto point = point_at(control, ends, u);
                const auto slope = slope_at(control, ends, u);
                const auto expected = dense::point(control, ends, u);
                const auto expected_slope = dense::slope(control, ends, u);
                ASSERT_EQ(point.size(), 3U);
                for (std::size_t d = 0; d < 3; ++d) {
                    EXPECT_NEAR(point[d], expected[d], 1e-11) << level << ", " << u;
                    EXPECT_NEAR(slope[d], expected_slope[d], 1e-8) << level << ", " << u;
                }
            }
        }
    }
}

// Within a segment the slope is a parabola, of which a central difference is exact.
TEST(Bspline, BendIsTheSlopeOfTheSlope) {
    for (const Ends ends : kBothEnds) {
        for (int level = 0; level <= 5; ++level) {
            const Points control =
                dense::random_curve(level, ends, 2, unsigned(level + 20));
            const double step = std::ldexp(1, -level - 4);
            for (double u = 1.5 * step; u < 1; u += std::ldexp(1, -level)) {
                const auto bend = bend_at(control, ends, u);
                const auto before = slope_at(control, ends, u - step);
                const auto after = slope_at(control, ends, u + step);
                for (std::size_t d = 0; d < 2; ++d)
                    EXPECT_NEAR(
                        bend[d], (after[d] - before[d]) / (2 * step), 1e-7 * step * 1e5)
                        << level << ", " << u;
            }
        }
    }
}

TEST(Bspline, PeaksAreWhereNoOtherPointOfTheBasisIsLarger) {
    for (const Ends ends : kBothEnds) {
        for (int level = 0; level <= 4; ++level) {
            for (std::size_t i = 0; i < control_count(level, ends); ++i) {
                // The one function of a closed level 0 is constant.
                const double peak = peak_of_basis(level, ends, i);
                const double most = dense::basis(level, ends, i, peak);
                for (int k = 0; k <= 512; ++k)
                    EXPECT_LE(dense::basis(level, ends, i, k / 512.0), most + 1e-14)
                        << int(ends) << ", level " << level << ": " << i << " at " << k;
            }
        }
    }
    EXPECT_NEAR(peak_of_basis(0, Ends::kOpen, 1), 1 / 3.0, 1e-15);
    EXPECT_EQ(peak_of_basis(3, Ends::kClosed, 3), 0.375);
}

TEST(Bspline, BezierPointsDrawTheSameCurve) {
    for (const Ends ends : kBothEnds) {
        for (int level = 0; level <= 5; ++level) {
            const Points control =
                dense::random_curve(level, ends, 3, unsigned(level + 30));
            const Points bezier = bezier_points(control, ends);
            const std::size_t segments = segment_count(level);
            ASSERT_EQ(bezier.size(), 3 * segments + 1);
            for (std::size_t s = 0; s < segments; ++s) {
                for (const double t : {0.0, 0.2, 0.5, 0.9, 1.0}) {
                    const auto weights = bernstein(t);
                    const auto expected =
                        dense::point(control, ends, (double(s) + t) / double(segments));
                    for (std::size_t d = 0; d < 3; ++d) {
                        double sum = 0;
                        for (std::size_t i = 0; i < 4; ++i)
                            sum += weights[i] * bezier[3 * s + i][d];
                        EXPECT_NEAR(sum, expected[d], 1e-11)
                            << level << ", " << s << ", " << t;
                    }
                }
            }
        }
    }
}

TEST(Bspline, LengthIsThatOfALongPolyline) {
    for (const Ends ends : kBothEnds) {
        for (int level = 0; level <= 4; ++level) {
            const Points control =
                dense::random_curve(level, ends, 3, unsigned(level + 40));
            for (const auto& [from, to] :
                 {std::pair(0.0, 1.0), std::pair(0.13, 0.71), std::pair(0.5, 0.5)}) {
                const double coarse = polyline_length(control, ends, from, to, 8000);
                const double fine = polyline_length(control, ends, from, to, 16000);
                const double expected = fine + (fine - coarse) / 3;
                EXPECT_NEAR(
                    length(control, ends, from, to), expected, 1e-7 * expected + 1e-9)
                    << int(ends) << ", " << level << ": " << from << ".." << to;
            }
        }
    }
}

TEST(Bspline, LengthOfALineThatTurnsBackCountsBothWays) {
    // x goes 0, 1, 1, 0 as 3t(1-t): there and back over 3/4.
    const Points control = points_of({{0, 0}, {1, 0}, {1, 0}, {0, 0}});
    EXPECT_NEAR(length(control, Ends::kOpen, 0, 1), 1.5, 1.5e-6);
    // A cusp at an odd place: x' = 3 - 12 t + 10.5 t^2 changes its sign twice.
    const Points zigzag = points_of({{0, 0}, {1, 0}, {0, 0}, {0.5, 0}});
    EXPECT_NEAR(length(zigzag, Ends::kOpen, 0, 1),
                polyline_length(zigzag, Ends::kOpen, 0, 1, 8000),
                1e-6);
}

TEST(Bspline, PointsThatAreAllAlikeHaveNoLength) {
    const Points control = points_of({{3, 4}, {3, 4}, {3, 4}, {3, 4}});
    EXPECT_EQ(length(control, Ends::kOpen, 0, 1), 0);
    EXPECT_EQ(nearest(control, Ends::kOpen, 9, 9), 0);
}

TEST(Bspline, NearestIsNoFartherThanAnySample) {
    for (const Ends ends : kBothEnds) {
        for (int level = 0; level <= 4; ++level) {
            const Points control =
                dense::random_curve(level, ends, 2, unsigned(level + 60));
            std::vector<std::vector<double>> samples;
            for (int i = 0; i <= 1000; ++i)
                samples.push_back(dense::point(control, ends, i / 1000.0));
            for (int k = 0; k < 12; ++k) {
                const double x = 17.0 * k - 90;
                const double y = 60 - 11.0 * k * (k % 3);
                const auto distance = [&](const std::vector<double>& point) {
                    return std::hypot(point[0] - x, point[1] - y);
                };
                const double found =
                    distance(dense::point(control, ends, nearest(control, ends, x, y)));
                for (std::size_t i = 0; i < samples.size(); ++i)
                    ASSERT_LE(found, distance(samples[i]) + 1e-9)
                        << int(ends) << ", " << level << ", " << k << ", " << i;
            }
        }
    }
}

TEST(Bspline, NearestOfAPointOfTheCurveIsItsParameter) {
    const Points control = dense::random_curve(6, Ends::kOpen, 2, 70);
    for (const double u : {0.0, 0.015625, 0.3, 0.501, 0.99, 1.0}) {
        const auto point = point_at(control, Ends::kOpen, u);
        EXPECT_NEAR(nearest(control, Ends::kOpen, point[0], point[1]), u, 1e-9);
    }
}

TEST(Bspline, OfEqualDistancesTheFirstIsNearest) {
    // An arch, seen from its axis above: both feet are as far.
    const Points arch = points_of({{-1, 0}, {-1, 1}, {1, 1}, {1, 0}});
    EXPECT_EQ(nearest(arch, Ends::kOpen, 0, -50), 0);
    // Once around: the middle sees the four corners of a square alike.
    const Points square = points_of({{1, 0}, {0, 1}, {-1, 0}, {0, -1}});
    const double u = nearest(square, Ends::kClosed, 0, 0);
    EXPECT_NEAR(u, 0.125, 1e-9);
}

// Touching of the fifth order: the zeros cannot be told apart, and must still end.
TEST(Bspline, NearestEndsWhereZerosCrowd) {
    const Points line = points_of({{0, 0}, {0, 0}, {0, 0}, {1, 0}});  // x = t^3
    EXPECT_NEAR(nearest(line, Ends::kOpen, 0, 0), 0, 1e-2);
    EXPECT_NEAR(nearest(line, Ends::kOpen, 0.5, 0), std::cbrt(0.5), 1e-9);
}

}  // namespace
}  // namespace haarmony::curve
