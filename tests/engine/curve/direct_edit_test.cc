#include "engine/curve/direct_edit.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/engine/curve/dense_spline.h"

namespace haarmony::curve {
namespace {

constexpr std::array kFrames = {Frame::kFixed, Frame::kNormalized, Frame::kUnnormalized};
constexpr std::array kEnds = {Ends::kOpen, Ends::kClosed};
constexpr std::array<double, 2> kDelta = {60, -25};
constexpr std::array<double, 8> kPlaces = {0, 0.001, 0.125, 0.3, 0.5, 0.7123, 0.9, 1};

// The row Phi^level(u), turned into its pseudo-inverse and multiplied by kDelta.
Points dense_pull(int level, Ends ends, double u) {
    Points pull(dense::points_of(level, ends), 2);
    double square = 0;
    for (std::size_t i = 0; i < pull.size(); ++i) {
        const double value = dense::basis(level, ends, i, u);
        square += value * value;
    }
    for (std::size_t i = 0; i < pull.size(); ++i) {
        for (std::size_t d = 0; d < 2; ++d) {
            pull[i][d] = dense::basis(level, ends, i, u) * kDelta[d] / square;
        }
    }
    return pull;
}

// delta C^n by (3.7), (3.5) and (3.6), with projections instead of A and B.
Points dense_change(int n, Ends ends, double level, double u) {
    const int j = int(std::floor(level));
    const double t = level - j;
    const Points broad = dense_pull(j, ends, u);
    if (t == 0) return dense::refine(broad, ends, n);
    const Points narrow = dense_pull(j + 1, ends, u);
    const Points back = dense::refine(dense::project(narrow, ends, j), ends, j + 1);
    const Points none(narrow.size(), 2);
    const double g = t * t;
    Points change = dense::sum(none, 1 - g, dense::refine(broad, ends, j + 1));
    change = dense::sum(change, g, back);
    change = dense::sum(change, g / t, dense::sum(narrow, -1, back));
    return dense::refine(change, ends, n);
}

// f^level(u).
std::vector<double> dense_smoothed(const Points& control,
                                   Ends ends,
                                   double level,
                                   double u) {
    const int j = int(std::floor(level));
    std::vector<double> place = dense::point(dense::project(control, ends, j), ends, u);
    if (level == j) return place;
    const std::vector<double> finer =
        dense::point(dense::project(control, ends, j + 1), ends, u);
    for (std::size_t d = 0; d < place.size(); ++d) {
        place[d] += (level - j) * (finer[d] - place[d]);
    }
    return place;
}

TEST(DirectEdit, InThePagesAxesAgreesWithFullMatrices) {
    for (const Ends ends : kEnds) {
        const Points control = dense::random_curve(3, ends, 2, 1);
        const MultiresCurve curve = decompose(control, ends);
        for (const double level : {0.0, 0.4, 1.0, 1.5, 2.0, 2.8, 3.0}) {
            for (const double u : kPlaces) {
                const Points change = dense_change(3, ends, level, u);
                const auto edited =
                    drag_point(curve, {level, u, kDelta, Drag::kSmooth, Frame::kFixed});
                ASSERT_TRUE(edited) << edited.error().message;
                EXPECT_LT(
                    dense::distance(edited->control, dense::sum(control, 1, change)),
                    1e-8)
                    << int(ends) << " level " << level << " u " << u;
                const std::vector<double> moved = dense::point(change, ends, u);
                for (std::size_t d = 0; d < 2; ++d) {
                    EXPECT_NEAR(edited->moved[d], moved[d], 1e-8);
                    EXPECT_NEAR(
                        overshoot(RealLevel(level), ends, u) * kDelta[d], moved[d], 1e-8);
                }

                // The full curve goes all the way: the same change, rescaled.
                const auto full =
                    drag_point(curve, {level, u, kDelta, Drag::kFull, Frame::kFixed});
                ASSERT_TRUE(full);
                EXPECT_LT(
                    dense::distance(full->control,
                                    dense::sum(control, kDelta[0] / moved[0], change)),
                    1e-8)
                    << int(ends) << " level " << level << " u " << u;
            }
        }
    }
}

TEST(DirectEdit, MovesTheSmoothedCurveByDelta) {
    for (const Ends ends : kEnds) {
        const Points control = dense::random_curve(4, ends, 2, 2);
        const MultiresCurve curve = decompose(control, ends);
        for (const double level : {0.0, 0.7, 2.0, 2.5, 4.0}) {
            for (const double u : kPlaces) {
                const auto edited =
                    drag_point(curve, {level, u, kDelta, Drag::kSmooth, Frame::kFixed});
                ASSERT_TRUE(edited);
                const auto before = dense_smoothed(control, ends, level, u);
                const auto after = dense_smoothed(edited->control, ends, level, u);
                EXPECT_NEAR(after[0] - before[0], kDelta[0], 1e-8);
                EXPECT_NEAR(after[1] - before[1], kDelta[1], 1e-8);
            }
        }
    }
}

TEST(DirectEdit, OvershootsBetweenLevelsOnly) {
    for (const Ends ends : kEnds) {
        for (const double u : kPlaces) {
            for (int level = 0; level <= 5; ++level) {
                EXPECT_NEAR(overshoot(RealLevel(level), ends, u), 1, 1e-14);
            }
            // 1 + t (1 - t) b: what the half tells, the quarter must tell as well.
            const double half = overshoot(RealLevel(3.5), ends, u) - 1;
            const double quarter = overshoot(RealLevel(3.25), ends, u) - 1;
            EXPECT_NEAR(quarter, half * 3 / 4, 1e-14) << u;
        }
        EXPECT_GT(overshoot(RealLevel(3.5), ends, 0.5), 1.01);
    }
}

TEST(DirectEdit, OvershootsByNoMoreThanAnEighth) {
    for (const Ends ends : kEnds) {
        for (int level = 0; level <= 6; ++level) {
            for (int i = 0; i <= 400; ++i) {
                const double b =
                    4 * (overshoot(RealLevel(level + 0.5), ends, i / 400.0) - 1);
                EXPECT_GE(b, -0.01) << int(ends) << " " << level << " " << i;
                EXPECT_LE(b, ends == Ends::kOpen ? 0.31 : 0.5 + 1e-12)
                    << int(ends) << " " << level << " " << i;
            }
        }
    }
}

TEST(DirectEdit, OfTheFullCurveArrivesInEveryFrame) {
    for (const Ends ends : kEnds) {
        const Points control = dense::random_curve(5, ends, 3, 3);
        const MultiresCurve curve = decompose(control, ends);
        const std::array<double, 3> delta = {80, 45, -3};
        for (const Frame frame : kFrames) {
            for (const double level : {0.0, 0.5, 1.0, 2.3, 3.0, 4.9, 5.0}) {
                for (const double u : kPlaces) {
                    const auto edited =
                        drag_point(curve, {level, u, delta, Drag::kFull, frame});
                    ASSERT_TRUE(edited);
                    const auto before = dense::point(control, ends, u);
                    const auto after = dense::point(edited->control, ends, u);
                    for (std::size_t d = 0; d < 3; ++d) {
                        EXPECT_NEAR(after[d] - before[d], delta[d], 1e-8)
                            << int(ends) << int(frame) << " " << level << " " << u;
                        EXPECT_NEAR(edited->moved[d], delta[d], 1e-8);
                    }
                }
            }
        }
    }
}

// Pulls so far that details turn over and steps towards the goal miss it.
TEST(DirectEdit, OfTheFullCurveArrivesHoweverFarItIsPulled) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        const Points control = dense::random_curve(4, Ends::kOpen, 2, seed);
        const MultiresCurve curve = decompose(control, Ends::kOpen);
        for (const Frame frame : kFrames) {
            for (const double pull : {300.0, -3000.0, 30000.0}) {
                const std::array<double, 2> delta = {pull, -pull / 3};
                const auto edited =
                    drag_point(curve, {0.5, 0.4, delta, Drag::kFull, frame});
                ASSERT_TRUE(edited);
                const auto before = dense::point(control, Ends::kOpen, 0.4);
                const auto after = dense::point(edited->control, Ends::kOpen, 0.4);
                const double size = coordinate_size(edited->control);
                EXPECT_NEAR(after[0] - before[0], delta[0], 1e-11 * size)
                    << seed << " " << int(frame) << " " << pull;
                EXPECT_NEAR(after[1] - before[1], delta[1], 1e-11 * size)
                    << seed << " " << int(frame) << " " << pull;
            }
        }
    }
}

TEST(DirectEdit, OfTheSmoothedCurveTellsHowFarTheFullOneMoved) {
    const Points control = dense::random_curve(5, Ends::kOpen, 2, 4);
    const MultiresCurve curve = decompose(control, Ends::kOpen);
    for (const Frame frame : kFrames) {
        const auto edited = drag_point(curve, {2.5, 0.3, kDelta, Drag::kSmooth, frame});
        ASSERT_TRUE(edited);
        const auto before = dense::point(control, Ends::kOpen, 0.3);
        const auto after = dense::point(edited->control, Ends::kOpen, 0.3);
        for (std::size_t d = 0; d < 2; ++d) {
            EXPECT_NEAR(edited->moved[d], after[d] - before[d], 1e-9) << int(frame);
        }
    }
}

TEST(DirectEdit, ErrorsNameWhatIsWrong) {
    const MultiresCurve curve =
        decompose(dense::random_curve(3, Ends::kOpen, 2, 5), Ends::kOpen);
    const auto failure = [&](const PointEdit& edit) {
        const auto edited = drag_point(curve, edit);
        EXPECT_FALSE(edited);
        EXPECT_EQ(edited.error().code, ErrorCode::kInvalidArgument);
        return edited.error();
    };
    for (const double u : {-0.25, 1.25}) {
        const Error error = failure({1, u, kDelta, Drag::kSmooth, Frame::kFixed});
        EXPECT_EQ(error.param, "u");
        EXPECT_EQ(error.message, "u " + std::to_string(u) + " is outside 0..1");
    }
    EXPECT_EQ(failure({1, std::nan(""), kDelta, Drag::kFull, Frame::kFixed}).param, "u");
    EXPECT_EQ(failure({4, 0.5, kDelta, Drag::kFull, Frame::kFixed}).param, "level");
    const std::array<double, 1> short_delta = {1};
    EXPECT_EQ(failure({1, 0.5, short_delta, Drag::kFull, Frame::kFixed}).param, "delta");
    const std::array<double, 2> endless = {-std::numeric_limits<double>::infinity(), 0};
    EXPECT_EQ(failure({1, 0.5, endless, Drag::kFull, Frame::kFixed}).param, "delta");
    const std::array<double, 2> huge = {1e308, -1.7e308};
    for (const Frame frame : kFrames) {
        for (const Drag drag : {Drag::kSmooth, Drag::kFull}) {
            EXPECT_EQ(failure({0.5, 0.4, huge, drag, frame}).message,
                      "delta -1.7e+308 takes the curve beyond the largest number");
        }
    }
}

}  // namespace
}  // namespace haarmony::curve
