#include "tests/eval/affine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/eval/distortions.h"
#include "tests/eval/test/generated_pictures.h"

namespace haarmony::eval {
namespace {

const std::uint8_t* pixel(const RgbPicture& picture, int x, int y) {
    return picture.rgb.data() + (static_cast<std::size_t>(y) * picture.width + x) * 3;
}

int largest_difference(const RgbPicture& a, const RgbPicture& b) {
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    int largest = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i)
        largest = std::max(largest, std::abs(a.rgb[i] - b.rgb[i]));
    return largest;
}

TEST(Affine, NothingChangesWhereNothingIsAskedFor) {
    const RgbPicture picture = gradient(31, 17);
    EXPECT_EQ(enlarge(picture, 1).rgb, picture.rgb);
    EXPECT_EQ(rotate(picture, 0).rgb, picture.rgb);
    EXPECT_EQ(translate(picture, 0, 0).rgb, picture.rgb);
}

TEST(Affine, TranslationMovesRightAndDownAndPadsWithTheAverage) {
    const RgbPicture picture = gradient(24, 18);
    const RgbPicture moved = translate(picture, 5, -3);
    const auto average = average_colour(picture);
    for (int y = 0; y < 18; ++y) {
        for (int x = 0; x < 24; ++x) {
            const bool inside = x >= 5 && y + 3 < 18;
            for (int c = 0; c < 3; ++c) {
                const double expected =
                    inside ? pixel(picture, x - 5, y + 3)[c] : average[c];
                ASSERT_NEAR(pixel(moved, x, y)[c], expected, 0.5) << x << ' ' << y;
            }
        }
    }
}

TEST(Affine, HalfAPixelIsTheMeanOfNeighbours) {
    const RgbPicture moved = translate(gradient(24, 18), 0.5, 0);
    const RgbPicture picture = gradient(24, 18);
    EXPECT_NEAR(pixel(moved, 10, 4)[0],
                (pixel(picture, 9, 4)[0] + pixel(picture, 10, 4)[0]) / 2.0,
                0.5);
}

TEST(Affine, AQuarterTurnCounterClockwiseIsThreeClockwise) {
    const RgbPicture picture = gradient(16, 16);
    EXPECT_LE(largest_difference(rotate(picture, 90), turn(turn(turn(picture)))), 1);
    EXPECT_LE(largest_difference(rotate(picture, 180), turn(turn(picture))), 1);
}

TEST(Affine, CornersOfATurnedPictureAreItsAverage) {
    const RgbPicture picture = gradient(40, 40);
    const RgbPicture turned = rotate(picture, 45);
    const auto average = average_colour(picture);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel(turned, 0, 0)[c], average[c], 0.5);
}

TEST(Affine, EnlargingByTwoShowsTheMiddleHalf) {
    const RgbPicture picture = gradient(64, 48);
    const RgbPicture large = enlarge(picture, 2);
    ASSERT_EQ(large.width, 64);
    ASSERT_EQ(large.height, 48);
    // The pixel centres (2 x + 0.5, 2 y + 0.5) of the result lie between x and x + 1.
    for (const int x : {0, 13, 31}) {
        const double expected =
            0.75 * pixel(picture, 16 + x, 24)[0] + 0.25 * pixel(picture, 15 + x, 24)[0];
        EXPECT_NEAR(pixel(large, 2 * x, 24)[0], expected, 1) << x;
    }
}

TEST(Affine, TheAverageIsTakenByChannel) {
    RgbPicture picture = flat(2, 1, 10, 20, 30);
    picture.rgb[3] = 20;
    const std::array<double, 3> expected{15, 20, 30};
    EXPECT_EQ(average_colour(picture), expected);
}

}  // namespace
}  // namespace haarmony::eval
