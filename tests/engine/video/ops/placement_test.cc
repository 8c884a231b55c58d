// Scales in lowest terms, and what is refused.
#include "engine/video/ops/placement.h"

#include <gtest/gtest.h>

#include <limits>

namespace haarmony::video {
namespace {

TEST(Scale, IsAnIntegerOverAPowerOfTwoInLowestTerms) {
    EXPECT_EQ(scale_of(1, 1).value(), (Scale{1, 1, 0}));
    EXPECT_EQ(scale_of(3, 2).value(), (Scale{3, 2, 0}));
    EXPECT_EQ(scale_of(0.5, 0.5).value(), (Scale{1, 1, 1}));
    EXPECT_EQ(scale_of(1.5, 2).value(), (Scale{3, 4, 1}));
    EXPECT_EQ(scale_of(0.375, 1).value(), (Scale{3, 8, 3}));
    EXPECT_EQ(scale_of(65'536, 1).value(), (Scale{65'536, 1, 0}));
}

TEST(Scale, OtherNumbersAreRefused) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double inf = std::numeric_limits<double>::infinity();
    for (const auto& [x, y] : {std::pair{0.0, 1.0},
                               {1.0, -1.0},
                               {nan, 1.0},
                               {1.0, inf},
                               {65'537.0, 1.0},
                               {1.0 / 3, 1.0},
                               {1.0, 1.0 / 131'072},
                               {65'536.0, 0.5}}) {
        const Result<Scale> scale = scale_of(x, y);
        ASSERT_FALSE(scale.has_value()) << x << " " << y;
        EXPECT_EQ(scale.error().param, "scale");
    }
}

TEST(PlacedBox, IsInPixelsOfTheCanvas) {
    const ClipShape clip = ClipShape::make({37, 23, {25, 1}}, 1).value();
    EXPECT_EQ(placed_box(clip, {{1, 1, 0}, 5, -3, {}}).value(),
              (CanvasBox{5, -3, 37, 23}));
    EXPECT_EQ(placed_box(clip, {{3, 2, 0}, 5, -3, 5}).value(),
              (CanvasBox{10, -6, 111, 46}));
    // 37 x 23 has 19 x 12 pixels one level up.
    EXPECT_EQ(placed_box(clip, {{3, 1, 1}, 1, 0, 0}).value(), (CanvasBox{64, 0, 57, 12}));
}

TEST(PlacedBox, NamesWhatCannotBe) {
    const ClipShape clip = ClipShape::make({37, 23, {25, 1}}, 1).value();
    const std::int64_t far = std::int64_t{1} << 40;
    const auto refused = [&](const Placement& placement, const char* param) {
        const Result<CanvasBox> box = placed_box(clip, placement);
        ASSERT_FALSE(box.has_value());
        EXPECT_EQ(box.error().param, param);
    };
    refused({{0, 1, 0}, 0, 0, {}}, "scale");
    refused({{1, 65'537, 0}, 0, 0, {}}, "scale");
    refused({{1, 1, 7}, 0, 0, {}}, "scale");
    refused({{1, 1, -1}, 0, 0, {}}, "scale");
    refused({{1, 1, 0}, 0, 0, 7}, "at_level");
    refused({{1, 1, 0}, 0, 0, -1}, "at_level");
    refused({{1, 1, 0}, far, 0, {}}, "translate");
    refused({{1, 1, 0}, 0, -far, {}}, "translate");
    refused({{1, 1, 0}, std::int64_t{1} << 30, 0, 0}, "translate");
}

}  // namespace
}  // namespace haarmony::video
