#include "engine/curve/draw_segment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/curve/bspline.h"
#include "tests/engine/curve/drawn_strokes.h"

namespace haarmony::curve {
namespace {

std::vector<SegmentLevel> levels_of(const Points& control, Ends ends) {
    return error_bounds(decompose(control, ends));
}

double start_of(SegmentName s) {
    return double(s.index) / double(segment_count(s.level));
}
double width_of(SegmentName s) { return 1 / double(segment_count(s.level)); }

// The largest distance at equal u, by samples.
double sampled_error(const Points& control, Ends ends, const DrawnSegments& drawn) {
    double largest = 0;
    for (std::size_t i = 0; i < drawn.names.size(); ++i) {
        constexpr int kSamples = 200;
        for (int k = 0; k <= kSamples; ++k) {
            const double t = double(k) / kSamples;
            const double u = start_of(drawn.names[i]) + t * width_of(drawn.names[i]);
            const std::vector<double> p = point_at(control, ends, u);
            const std::vector<double> q = bernstein_sum(drawn.bezier, 4 * i, t);
            double sum2 = 0;
            for (std::size_t d = 0; d < std::min<std::size_t>(2, p.size()); ++d) {
                sum2 += (p[d] - q[d]) * (p[d] - q[d]);
            }
            largest = std::max(largest, std::sqrt(sum2));
        }
    }
    return largest;
}

void expect_covered_once(const std::vector<SegmentName>& names) {
    double u = 0;
    for (const SegmentName name : names) {
        EXPECT_EQ(start_of(name), u);
        u += width_of(name);
    }
    EXPECT_EQ(u, 1);
}

class DrawSegment : public testing::TestWithParam<Ends> {
  protected:
    Points control_ =
        drawn_stroke({.level = 7, .ends = GetParam(), .noise = 1, .seed = 5});
    std::vector<SegmentLevel> levels_ = levels_of(control_, GetParam());
};

TEST_P(DrawSegment, OutputsTheCoarsestSegmentsWhoseBoundIsBelowTheTolerance) {
    for (const double tolerance : {0.3, 2.0, 10.0, 1000.0}) {
        const DrawnSegments drawn = draw_segments(levels_, tolerance, {});
        expect_covered_once(drawn.names);
        for (const SegmentName s : drawn.names) {
            EXPECT_LT(levels_[std::size_t(s.level)].bound[s.index], tolerance);
            if (s.level > 0) {
                EXPECT_GE(levels_[std::size_t(s.level - 1)].bound[s.index / 2],
                          tolerance * (1 - 1e-9));
            }
        }
    }
}

TEST_P(DrawSegment, StaysWithinTheBoundAndTheTolerance) {
    for (const double tolerance : {0.3, 2.0, 10.0, 1000.0}) {
        const DrawnSegments drawn = draw_segments(levels_, tolerance, {});
        EXPECT_LE(sampled_error(control_, GetParam(), drawn), drawn.bound + 1e-9);
        EXPECT_LT(drawn.bound, tolerance);
        const DrawnSegments joined =
            draw_joined_segments(levels_, GetParam(), tolerance, {});
        expect_covered_once(joined.names);
        EXPECT_LE(sampled_error(control_, GetParam(), joined), joined.bound + 1e-9);
        EXPECT_LT(joined.bound, tolerance);
    }
}

TEST_P(DrawSegment, JoinedSegmentsMeetInEveryDimension) {
    const Points control =
        drawn_stroke({.level = 7, .ends = GetParam(), .dimension = 4, .noise = 1});
    const DrawnSegments drawn =
        draw_joined_segments(levels_of(control, GetParam()), GetParam(), 2, {});
    const std::size_t count = drawn.names.size();
    ASSERT_GT(count, 4U);
    ASSERT_LT(count, 128U);
    for (std::size_t i = 0; i < (GetParam() == Ends::kOpen ? count - 1 : count); ++i) {
        EXPECT_TRUE(std::ranges::equal(drawn.bezier[4 * i + 3],
                                       drawn.bezier[4 * ((i + 1) % count)]))
            << i;
    }
}

TEST_P(DrawSegment, ATinyToleranceGivesTheCurveItself) {
    const DrawnSegments drawn = draw_segments(levels_, 1e-9, {});
    EXPECT_EQ(drawn.names.size(), 128U);
    EXPECT_EQ(drawn.bound, 0);
    EXPECT_EQ(drawn.bezier, four_rows_each(levels_.back().bezier));
    EXPECT_EQ(draw_joined_segments(levels_, GetParam(), 1e-9, {}).bezier, drawn.bezier);
}

TEST_P(DrawSegment, AVastToleranceGivesOneSegment) {
    EXPECT_EQ(draw_segments(levels_, 1e6, {}).names, (std::vector{SegmentName{0, 0}}));
    EXPECT_EQ(draw_joined_segments(levels_, GetParam(), 1e6, {}).names,
              (std::vector{SegmentName{0, 0}}));
}

TEST_P(DrawSegment, ACurveOfLevelZeroIsItsOwnSegment) {
    const Points control = drawn_stroke({.level = 0, .ends = GetParam()});
    EXPECT_EQ(draw_segments(levels_of(control, GetParam()), 1e-3, {}).names.size(), 1U);
}

TEST_P(DrawSegment, NoneGoesAcrossATurn) {
    const std::vector<std::size_t> turns{0, 37, 38, 96};
    for (const double tolerance : {2.0, 1e6}) {
        for (const bool joined : {false, true}) {
            const DrawnSegments drawn =
                joined ? draw_joined_segments(levels_, GetParam(), tolerance, turns)
                       : draw_segments(levels_, tolerance, turns);
            expect_covered_once(drawn.names);
            for (const SegmentName s : drawn.names)
                for (const std::size_t turn : turns)
                    EXPECT_FALSE(start_of(s) < double(turn) / 128 &&
                                 double(turn) / 128 < start_of(s) + width_of(s))
                        << turn;
            EXPECT_LE(sampled_error(control_, GetParam(), drawn), drawn.bound + 1e-9);
            EXPECT_LT(drawn.bound, tolerance);
        }
    }
}

TEST_P(DrawSegment, JoinedSegmentsTurnOnTheCurveItself) {
    const std::vector<std::size_t> turns{0, 37, 96};
    const DrawnSegments drawn = draw_joined_segments(levels_, GetParam(), 20, turns);
    std::size_t met = 0;
    for (std::size_t i = 0; i < drawn.names.size(); ++i) {
        const auto knot = std::size_t(std::lround(128 * start_of(drawn.names[i])));
        if (!std::ranges::binary_search(turns, knot)) continue;
        ++met;
        const auto curve = levels_.back().bezier[3 * knot];
        EXPECT_TRUE(std::ranges::equal(drawn.bezier[4 * i], curve)) << knot;
        if (i == 0 && GetParam() == Ends::kOpen) continue;
        const std::size_t before = (i == 0 ? drawn.names.size() : i) - 1;
        EXPECT_TRUE(std::ranges::equal(drawn.bezier[4 * before + 3], curve)) << knot;
    }
    EXPECT_EQ(met, turns.size());
    EXPECT_LT(drawn.names.size(), 128U);
}

INSTANTIATE_TEST_SUITE_P(Both,
                         DrawSegment,
                         testing::Values(Ends::kOpen, Ends::kClosed),
                         [](const auto& ends) {
                             return ends.param == Ends::kOpen ? "Open" : "Closed";
                         });

// A curve of one dimension on which averaging the ends, as printed, goes beyond the tolerance.
constexpr std::array kCounterexample = {0.6848317048057464,
                                        1.5761546597127123,
                                        1.5552310608879256,
                                        0.9375287108988546,
                                        1.4576898956901014,
                                        -1.3425513787310202,
                                        0.8605478190651955,
                                        -1.0935217100895176,
                                        0.6007014712915315,
                                        -0.601260814196261,
                                        0.2061516361640094,
                                        1.6513160220735545,
                                        0.561175185967237,
                                        1.443820598147249,
                                        1.4353935093926633,
                                        1.6580332508262112,
                                        0.8003957818533418,
                                        -0.7612909124981044,
                                        -1.3950997859330552};
constexpr double kTolerance = 0.3894104618791255;

TEST(DrawJoinedSegments, KeepTheToleranceWhereAveragingDoesNot) {
    Points control(kCounterexample.size(), 1);
    std::ranges::copy(kCounterexample, control.numbers().begin());
    const std::vector<SegmentLevel> levels = levels_of(control, Ends::kOpen);

    DrawnSegments averaged = draw_segments(levels, kTolerance, {});
    EXPECT_EQ(averaged.names.size(), 10U);
    EXPECT_LT(sampled_error(control, Ends::kOpen, averaged), kTolerance);
    for (std::size_t i = 0; i + 1 < averaged.names.size(); ++i) {
        double& end = averaged.bezier[4 * i + 3][0];
        double& start = averaged.bezier[4 * i + 4][0];
        end = start = (end + start) / 2;
    }
    EXPECT_NEAR(sampled_error(control, Ends::kOpen, averaged),
                1.123445651926689 * kTolerance,
                1e-4);

    const DrawnSegments joined =
        draw_joined_segments(levels, Ends::kOpen, kTolerance, {});
    EXPECT_LT(sampled_error(control, Ends::kOpen, joined), kTolerance);
    EXPECT_GT(joined.names.size(), averaged.names.size());
}

}  // namespace
}  // namespace haarmony::curve
