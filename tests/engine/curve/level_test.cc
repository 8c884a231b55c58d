#include "engine/curve/level.h"

#include <gtest/gtest.h>

namespace haarmony::curve {
namespace {

TEST(Level, OfAnOpenCurveHasThreePointsMoreThanSegments) {
    EXPECT_EQ(control_count(0, Ends::kOpen), 4U);
    EXPECT_EQ(control_count(8, Ends::kOpen), 259U);
    EXPECT_EQ(level_of(4, Ends::kOpen), 0);
    EXPECT_EQ(level_of(1027, Ends::kOpen), 10);
}

TEST(Level, OfAClosedCurveHasAsManyPointsAsSegments) {
    EXPECT_EQ(control_count(0, Ends::kClosed), 1U);
    EXPECT_EQ(control_count(8, Ends::kClosed), 256U);
    EXPECT_EQ(level_of(1024, Ends::kClosed), 10);
}

TEST(Level, OtherCountsAreOfNoLevel) {
    for (const std::size_t count : {0U, 1U, 2U, 3U, 6U, 258U, 260U})
        EXPECT_EQ(level_of(count, Ends::kOpen), std::nullopt) << count;
    for (const std::size_t count : {0U, 3U, 259U})
        EXPECT_EQ(level_of(count, Ends::kClosed), std::nullopt) << count;
}

TEST(Level, TheLargestIsTheLastOne) {
    EXPECT_EQ(level_of(control_count(kMostLevel, Ends::kOpen), Ends::kOpen), kMostLevel);
    EXPECT_EQ(level_of(control_count(kMostLevel + 1, Ends::kOpen), Ends::kOpen),
              std::nullopt);
}

}  // namespace
}  // namespace haarmony::curve
