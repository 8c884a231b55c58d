#include "engine/curve/corner_joints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/curve/bspline.h"
#include "tests/engine/curve/drawn_strokes.h"

namespace haarmony::curve {
namespace {

Points chain_of(int level) {
    return bezier_points(drawn_stroke({.level = level, .dimension = 3}), Ends::kOpen);
}

TEST(CornerJoints, AtJointsChangeNothing) {
    const Points chain = chain_of(3);
    const CorneredChain result = split_at_corners(chain, std::array{0.75, 0.125, 0.75});
    EXPECT_EQ(result.chain, chain);
    EXPECT_EQ(result.joints, (std::vector<std::size_t>{1, 6}));
}

TEST(CornerJoints, AtTheEndsAreNone) {
    EXPECT_TRUE(split_at_corners(chain_of(2), std::array{0.0, 1.0}).joints.empty());
}

TEST(CornerJoints, WithinPiecesSplitThem) {
    const Points chain = chain_of(2);
    const std::array corners = {0.6, 0.1, 0.25, 0.7};  // in pieces 2.4, 0.4, 1, 2.8
    const CorneredChain result = split_at_corners(chain, corners);
    ASSERT_EQ(result.chain.size(), 3 * 7 + 1U);
    EXPECT_EQ(result.joints, (std::vector<std::size_t>{1, 2, 4, 5}));
    // Where the new pieces begin and end, in old ones.
    const std::array place = {0.0, 0.4, 1.0, 2.0, 2.4, 2.8, 3.0, 4.0};
    for (std::size_t piece = 0; piece < 7; ++piece) {
        for (const double t : {0.0, 0.3, 0.5, 1.0}) {
            const double at = place[piece] + t * (place[piece + 1] - place[piece]);
            const double old = std::floor(place[piece]);
            const auto want = bernstein_sum(chain, 3 * std::size_t(old), at - old);
            const auto got = bernstein_sum(result.chain, 3 * piece, t);
            for (std::size_t d = 0; d < 3; ++d) {
                EXPECT_NEAR(got[d], want[d], 1e-10) << piece << ' ' << t;
            }
        }
    }
}

TEST(CornerJoints, AHairFromAJointAreMeantThere) {
    const Points chain = chain_of(2);
    const CorneredChain result =
        split_at_corners(chain, std::array{std::nextafter(0.5, 0), 0.5});
    EXPECT_EQ(result.chain, chain);
    EXPECT_EQ(result.joints, std::vector<std::size_t>{2});
}

}  // namespace
}  // namespace haarmony::curve
