#include "engine/curve/character.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/engine/curve/dense_spline.h"

namespace haarmony::curve {
namespace {

constexpr std::array kFrames = {Frame::kFixed, Frame::kNormalized, Frame::kUnnormalized};
constexpr std::array kEnds = {Ends::kOpen, Ends::kClosed};

Points given(const MultiresCurve& sweep,
             const LocalDetails& character,
             int from_level,
             double strength) {
    const auto result = give_character(sweep, character, from_level, strength);
    EXPECT_TRUE(result) << result.error().message;
    return result ? *result : Points();
}

TEST(Character, OfTheCurveItselfChangesNothing) {
    for (const Ends ends : kEnds) {
        const Points control = dense::random_curve(5, ends, 3, 1);
        const MultiresCurve curve = decompose(control, ends);
        for (const Frame frame : kFrames) {
            const LocalDetails own = character_of(control, ends, frame);
            for (int level = 0; level <= 5; ++level) {
                EXPECT_LT(dense::distance(given(curve, own, level, 1), control), 1e-9)
                    << int(ends) << int(frame) << " " << level;
            }
        }
    }
}

TEST(Character, InThePagesAxesIsWhatTheSweepOfTheOtherLeaves) {
    for (const Ends ends : kEnds) {
        const Points calm = dense::random_curve(3, ends, 2, 2);
        const Points lively = dense::random_curve(4, ends, 2, 3);
        for (const double strength : {1.0, 0.0, -0.5, 2.0}) {
            for (int level = 0; level <= 3; ++level) {
                const Points swept =
                    dense::refine(dense::project(calm, ends, level), ends, 4);
                const Points left = dense::sum(
                    lively,
                    -1,
                    dense::refine(dense::project(lively, ends, level), ends, 4));
                EXPECT_LT(dense::distance(given(decompose(calm, ends),
                                                character_of(lively, ends, Frame::kFixed),
                                                level,
                                                strength),
                                          dense::sum(swept, strength, left)),
                          1e-8)
                    << int(ends) << " level " << level << " strength " << strength;
            }
        }
    }
}

TEST(Character, OfStrengthZeroIsTheSweepAlone) {
    const Points control = dense::random_curve(4, Ends::kOpen, 2, 4);
    const Points other = dense::random_curve(5, Ends::kOpen, 2, 5);
    for (const Frame frame : kFrames) {
        const Points swept =
            dense::refine(dense::project(control, Ends::kOpen, 2), Ends::kOpen, 5);
        EXPECT_LT(dense::distance(given(decompose(control, Ends::kOpen),
                                        character_of(other, Ends::kOpen, frame),
                                        2,
                                        0),
                                  swept),
                  1e-8)
            << int(frame);
    }
}

TEST(Character, TurnsWithTheSweepExceptInThePagesAxes) {
    const Points control = dense::random_curve(5, Ends::kOpen, 2, 6);
    const Points other = dense::random_curve(5, Ends::kOpen, 2, 7);
    const auto turned = [](const Points& points) {
        Points result = points;
        for (std::size_t i = 0; i < points.size(); ++i) {
            result[i][0] = -points[i][1];
            result[i][1] = points[i][0];
        }
        return result;
    };
    const MultiresCurve lying = decompose(control, Ends::kOpen);
    const MultiresCurve standing = decompose(turned(control), Ends::kOpen);
    for (const Frame frame : kFrames) {
        const LocalDetails character = character_of(other, Ends::kOpen, frame);
        const double apart = dense::distance(given(standing, character, 2, 1),
                                             turned(given(lying, character, 2, 1)));
        if (frame == Frame::kFixed) {
            EXPECT_GT(apart, 1);
        } else {
            EXPECT_LT(apart, 1e-8) << int(frame);
        }
    }
}

TEST(Character, GivesTheResultItsLevel) {
    const MultiresCurve curve =
        decompose(dense::random_curve(5, Ends::kOpen, 2, 8), Ends::kOpen);
    const auto level_with = [&](int character_level, int from_level) {
        const Points other = dense::random_curve(character_level, Ends::kOpen, 2, 9);
        return level_of(given(curve,
                              character_of(other, Ends::kOpen, Frame::kNormalized),
                              from_level,
                              1)
                            .size(),
                        Ends::kOpen);
    };
    EXPECT_EQ(level_with(7, 2), 7);
    EXPECT_EQ(level_with(5, 5), 5);
    EXPECT_EQ(level_with(3, 2), 3);
    EXPECT_EQ(level_with(3, 4), 4);  // nothing left to give: the sweep
}

TEST(Character, LeavesDimensionsAloneThatItDoesNotHave) {
    const Points thick = dense::random_curve(4, Ends::kOpen, 3, 10);
    const Points planar = dense::random_curve(4, Ends::kOpen, 2, 11);
    const Points longer = dense::random_curve(6, Ends::kOpen, 2, 12);
    const MultiresCurve curve = decompose(thick, Ends::kOpen);
    for (const Frame frame : kFrames) {
        const Points same =
            given(curve, character_of(planar, Ends::kOpen, frame), 1, 0.5);
        for (std::size_t i = 0; i < thick.size(); ++i) {
            EXPECT_NEAR(same[i][2], thick[i][2], 1e-9) << int(frame);
        }
        const Points finer =
            given(curve, character_of(longer, Ends::kOpen, frame), 1, 0.5);
        const Points refined = dense::refine(thick, Ends::kOpen, 6);
        for (std::size_t i = 0; i < refined.size(); ++i) {
            EXPECT_NEAR(finer[i][2], refined[i][2], 1e-8) << int(frame);
        }
    }
}

TEST(Character, DropsDimensionsThatTheCurveDoesNotHave) {
    const Points control = dense::random_curve(4, Ends::kOpen, 2, 13);
    const Points planar = dense::random_curve(4, Ends::kOpen, 2, 14);
    Points thick(planar.size(), 3);
    for (std::size_t i = 0; i < planar.size(); ++i) {
        std::ranges::copy(planar[i], thick[i].begin());
        thick[i][2] = double(i);
    }
    const MultiresCurve curve = decompose(control, Ends::kOpen);
    for (const Frame frame : kFrames) {
        EXPECT_LT(
            dense::distance(given(curve, character_of(thick, Ends::kOpen, frame), 1, 1),
                            given(curve, character_of(planar, Ends::kOpen, frame), 1, 1)),
            1e-12);
    }
}

// x alone would be turned into y.
TEST(Character, OfOneDimensionGoesAlongTheCurve) {
    const Points control = dense::random_curve(3, Ends::kOpen, 2, 15);
    const Points line = dense::random_curve(3, Ends::kOpen, 1, 16);
    Points planar(line.size(), 2);
    for (std::size_t i = 0; i < line.size(); ++i) planar[i][0] = line[i][0];
    const MultiresCurve curve = decompose(control, Ends::kOpen);
    LocalDetails along = character_of(line, Ends::kOpen, Frame::kFixed);
    LocalDetails with_zeros = character_of(planar, Ends::kOpen, Frame::kFixed);
    along.frame = with_zeros.frame = Frame::kNormalized;
    EXPECT_LT(dense::distance(given(curve, along, 1, 1), given(curve, with_zeros, 1, 1)),
              1e-9);
    // In the page's axes y is a dimension that it does not have.
    along.frame = Frame::kFixed;
    const Points kept = given(curve, along, 1, 1);
    for (std::size_t i = 0; i < control.size(); ++i) {
        EXPECT_NEAR(kept[i][1], control[i][1], 1e-9);
    }
}

TEST(Character, OfAnOpenStrokeFitsAClosedCurve) {
    const Points control = dense::random_curve(6, Ends::kClosed, 2, 17);
    const Points stroke = dense::random_curve(6, Ends::kOpen, 2, 18);
    const MultiresCurve curve = decompose(control, Ends::kClosed);
    const Points result =
        given(curve, character_of(stroke, Ends::kOpen, Frame::kFixed), 3, 1);
    EXPECT_EQ(level_of(result.size(), Ends::kClosed), 6);
    const MultiresCurve taken = decompose(result, Ends::kClosed);
    const MultiresCurve source = decompose(stroke, Ends::kOpen);
    for (int level = 3; level < 6; ++level) {
        EXPECT_LT(dense::distance(taken.details[level], source.details[level]), 1e-9);
    }
    EXPECT_LT(dense::distance(reconstruct(taken, 3), reconstruct(curve, 3)), 1e-9);
}

TEST(Character, ErrorsNameWhatIsWrong) {
    const Points control = dense::random_curve(3, Ends::kOpen, 2, 19);
    const MultiresCurve curve = decompose(control, Ends::kOpen);
    const LocalDetails own = character_of(control, Ends::kOpen, Frame::kFixed);
    for (const int level : {-1, 4}) {
        const auto result = give_character(curve, own, level, 1);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::kInvalidArgument);
        EXPECT_EQ(result.error().param, "from_level");
        EXPECT_EQ(result.error().message,
                  "from_level " + std::to_string(level) + " is outside 0..3");
    }
    for (const double strength :
         {std::nan(""), std::numeric_limits<double>::infinity()}) {
        const auto result = give_character(curve, own, 1, strength);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().param, "strength");
        EXPECT_EQ(result.error().message,
                  "strength " + std::to_string(strength) + " is not finite");
    }
    const auto result = give_character(curve, own, 0, -1e308);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().param, "strength");
    EXPECT_EQ(result.error().message,
              "strength -1e+308 takes the curve beyond the largest number");
}

}  // namespace
}  // namespace haarmony::curve
