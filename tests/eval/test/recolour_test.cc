#include "tests/eval/recolour.h"

#include <gtest/gtest.h>

#include "tests/eval/test/generated_pictures.h"

namespace haarmony::eval {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(Recolour, AShiftIsAddedAndClamped) {
    const RgbPicture picture = flat(1, 1, 100, 250, 5);
    EXPECT_EQ(shift_colours(picture, {0.2, 0.2, -0.2}).rgb, (Bytes{151, 255, 0}));
}

TEST(Recolour, ToneIsFactorTimesPower) {
    EXPECT_EQ(tone(flat(1, 1, 255, 51, 0), 0.5, 1).rgb, (Bytes{128, 26, 0}));
    EXPECT_EQ(tone(flat(1, 1, 255, 51, 0), 1, 2).rgb, (Bytes{255, 10, 0}));
    EXPECT_EQ(tone(flat(1, 1, 200, 100, 0), 1.3, 1).rgb, (Bytes{255, 130, 0}));
}

TEST(Recolour, SaturationMovesAwayFromGrey) {
    EXPECT_EQ(saturate(flat(1, 1, 90, 120, 150), 2).rgb, (Bytes{60, 120, 180}));
    EXPECT_EQ(saturate(flat(1, 1, 90, 120, 150), 0).rgb, (Bytes{120, 120, 120}));
}

TEST(Recolour, FiveLevelsAreQuartersOfTheRange) {
    EXPECT_EQ(posterize(flat(1, 1, 31, 33, 200), 5).rgb, (Bytes{0, 64, 191}));
}

TEST(Recolour, GreyIsLumaInEveryChannel) {
    EXPECT_EQ(to_grey(flat(1, 1, 255, 0, 0)).rgb, (Bytes{76, 76, 76}));
    const RgbPicture grey = to_grey(gradient(9, 9));
    for (std::size_t i = 0; i < grey.rgb.size(); i += 3) {
        EXPECT_EQ(grey.rgb[i], grey.rgb[i + 1]);
        EXPECT_EQ(grey.rgb[i], grey.rgb[i + 2]);
    }
}

}  // namespace
}  // namespace haarmony::eval
