#include "engine/curve/portion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/engine/curve/dense_spline.h"

namespace haarmony::curve {
namespace {

constexpr std::array kEnds = {Ends::kOpen, Ends::kClosed};
constexpr std::array<double, 7> kPlaces = {0, 0.06, 0.25, 0.3, 0.5, 0.8123, 1};

// Lengths of the segments of f^n, as many short lines each.
std::vector<double> sampled_lengths(const Points& control, Ends ends, int level) {
    constexpr int kLines = 400;
    const double segments = std::ldexp(1, level);
    std::vector<double> lengths;
    for (double segment = 0; segment < segments; ++segment) {
        double sum = 0;
        std::vector<double> last = dense::point(control, ends, segment / segments);
        for (int i = 1; i <= kLines; ++i) {
            const std::vector<double> next =
                dense::point(control, ends, (segment + double(i) / kLines) / segments);
            sum += std::hypot(next[0] - last[0], next[1] - last[1]);
            last = next;
        }
        lengths.push_back(sum);
    }
    return lengths;
}

// The segments in whose middle some function is not 0 that is not 0 at u either.
double sampled_portion(const std::vector<double>& lengths,
                       Ends ends,
                       int level,
                       double u) {
    double sum = 0;
    for (std::size_t segment = 0; segment < lengths.size(); ++segment) {
        const double middle = (double(segment) + 0.5) / double(lengths.size());
        bool moves = false;
        for (std::size_t i = 0; i < dense::points_of(level, ends); ++i) {
            moves = moves || (dense::basis(level, ends, i, u) > 1e-12 &&
                              dense::basis(level, ends, i, middle) > 0);
        }
        if (moves) sum += lengths[segment];
    }
    return sum;
}

TEST(Portion, LengthsAgreeWithSampling) {
    for (const Ends ends : kEnds) {
        const Points control = dense::random_curve(4, ends, 3, 1);
        const std::vector<double> lengths = sampled_lengths(control, ends, 4);
        const PortionLengths portions(control, ends);
        EXPECT_EQ(portions.level(), 4);
        for (int level = 0; level <= 4; ++level) {
            for (const double u : kPlaces) {
                const double expected = sampled_portion(lengths, ends, level, u);
                // The quadrature's error is largest where the curve turns back on itself.
                EXPECT_NEAR(portions.affected(level, u), expected, 1e-3 * expected)
                    << int(ends) << " level " << level << " u " << u;
            }
        }
        EXPECT_EQ(portions.total(), portions.affected(0, 0.3));
    }
}

TEST(Portion, OnAKnotOnlyThreeFunctionsCount) {
    const Points control = dense::random_curve(5, Ends::kOpen, 2, 2);
    const PortionLengths portions(control, Ends::kOpen);
    EXPECT_LT(portions.affected(4, 0.5), portions.affected(4, 0.5 + 1e-3));
    EXPECT_LT(portions.affected(4, 0.5), portions.affected(4, 0.5 - 1e-3));
    EXPECT_LT(portions.affected(4, 0), portions.affected(4, 1e-3));
    EXPECT_LT(portions.affected(4, 1), portions.affected(4, 1 - 1e-3));
}

TEST(Portion, LevelForIsTheInverseOfTheLength) {
    for (const Ends ends : kEnds) {
        const PortionLengths portions(dense::random_curve(6, ends, 2, 3), ends);
        for (const double u : kPlaces) {
            for (int level = 0; level < portions.level(); ++level) {
                const double wide = portions.affected(level, u);
                const double narrow = portions.affected(level + 1, u);
                ASSERT_GE(wide, narrow);
                if (wide == narrow) continue;
                if (wide < portions.affected(0, u)) {
                    EXPECT_EQ(portions.level_for(u, wide), level);
                }
                EXPECT_NEAR(portions.level_for(u, 0.75 * wide + 0.25 * narrow),
                            level + 0.25,
                            1e-9)
                    << int(ends) << " u " << u << " level " << level;
            }
        }
    }
}

TEST(Portion, LongerThanTheCurveMeansItsCoarsestLevel) {
    const PortionLengths portions(dense::random_curve(5, Ends::kOpen, 2, 4), Ends::kOpen);
    // Levels 0 to 2 all move the whole curve here: the tie goes to the coarsest.
    EXPECT_EQ(portions.affected(2, 0.4), portions.total());
    EXPECT_EQ(portions.level_for(0.4, portions.total()), 0);
    EXPECT_EQ(portions.level_for(0.4, portions.total() * (1 - 1e-14)), 0);
    EXPECT_EQ(portions.level_for(0.4, 5 * portions.total()), 0);
    EXPECT_NEAR(portions.level_for(0.4, portions.total() * (1 - 1e-6)), 2, 1e-3);
}

TEST(Portion, ShorterThanTheFinestMeansTheFinestLevel) {
    const PortionLengths portions(dense::random_curve(5, Ends::kOpen, 2, 5), Ends::kOpen);
    const double least = portions.affected(5, 0.4);
    EXPECT_EQ(portions.level_for(0.4, least), 5);
    EXPECT_EQ(portions.level_for(0.4, least / 100), 5);
    EXPECT_LT(portions.level_for(0.4, least * 1.001), 5);
}

TEST(Portion, OfACurveThatIsAPointHasOneLevel) {
    Points standing(control_count(3, Ends::kOpen), 2);
    for (double& number : standing.numbers()) number = 7;
    const PortionLengths portions(standing, Ends::kOpen);
    EXPECT_EQ(portions.total(), 0);
    EXPECT_EQ(portions.level_for(0.5, 1), 0);
}

TEST(Portion, OfAControlPointIsCentredOnThePeakOfItsLevel) {
    int agree = 0;
    for (const Ends ends : kEnds) {
        const Points control = dense::random_curve(6, ends, 2, 6);
        const PortionLengths portions(control, ends);
        for (std::size_t index = 0; index < 40; ++index) {
            for (const double share : {0.5, 0.2, 0.1}) {
                const double wanted = share * portions.total();
                const auto level = portions.level_for_control(index, wanted);
                ASSERT_TRUE(level);
                const int fine = int(std::ceil(*level));
                ASSERT_LT(index, control_count(fine, ends)) << *level;
                // The peak of the dense basis function, found by looking.
                Points one(dense::points_of(fine, ends), 1);
                one[index][0] = 1;
                const double own = portions.level_for(dense::peak(one, ends), wanted);
                if (int(std::ceil(own)) == fine) {
                    ++agree;
                    EXPECT_NEAR(*level, own, 1e-3) << index << " " << share;
                } else {
                    EXPECT_GE(*level, fine - 1) << index << " " << share;
                }
            }
        }
    }
    EXPECT_GT(agree, 100);
}

TEST(Portion, OfAControlPointThatNoLevelHasIsNone) {
    const PortionLengths portions(dense::random_curve(3, Ends::kOpen, 2, 7), Ends::kOpen);
    EXPECT_TRUE(portions.level_for_control(10, 1));
    EXPECT_FALSE(portions.level_for_control(11, 1));
}

}  // namespace
}  // namespace haarmony::curve
