#include "tests/eval/distortions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <set>

#include "tests/eval/test/generated_pictures.h"

namespace haarmony::eval {
namespace {

const std::uint8_t* pixel(const RgbPicture& picture, int x, int y) {
    return picture.rgb.data() + (static_cast<std::size_t>(y) * picture.width + x) * 3;
}

TEST(Distortions, ACropIsTheMiddleOfThePicture) {
    const RgbPicture picture = gradient(40, 30);
    const RgbPicture middle = crop(picture, 0.2);
    ASSERT_EQ(middle.width, 24);
    ASSERT_EQ(middle.height, 18);
    for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(pixel(middle, 0, 0)[c], pixel(picture, 8, 6)[c]);
        EXPECT_EQ(pixel(middle, 23, 17)[c], pixel(picture, 31, 23)[c]);
    }
}

TEST(Distortions, AFrameSurroundsAnUnchangedPicture) {
    const RgbPicture picture = gradient(40, 30);
    const RgbPicture framed = frame(picture, 0.1, 0.2, 255);
    ASSERT_EQ(framed.width, 48);
    ASSERT_EQ(framed.height, 42);
    for (int y = 0; y < 42; ++y) {
        for (int x = 0; x < 48; ++x) {
            const bool inside = x >= 4 && x < 44 && y >= 6 && y < 36;
            const int expected = inside ? pixel(picture, x - 4, y - 6)[2] : 255;
            ASSERT_EQ(pixel(framed, x, y)[2], expected) << x << ' ' << y;
        }
    }
}

TEST(Distortions, ALetterboxHasBarsAboveAndBelowOnly) {
    Random random(1);
    const QueryPicture query =
        distortion("letterbox").apply(flat(20, 20, 90, 90, 90), random);
    ASSERT_EQ(query.width, 20);
    ASSERT_EQ(query.height, 24);
    EXPECT_EQ(query.view().row(1)[0], 0);
    EXPECT_EQ(query.view().row(2)[0], 90);
    EXPECT_EQ(query.view().row(21)[57], 90);
    EXPECT_EQ(query.view().row(22)[57], 0);
}

TEST(Distortions, ACaptionCoversTheLowestPartWithWhiteAndWords) {
    Random random(1);
    const RgbPicture picture = flat(100, 100, 90, 90, 90);
    const RgbPicture captioned = caption(picture, 0.15, random);
    std::set<int> below;
    for (int y = 0; y < 100; ++y) {
        for (int x = 0; x < 100; ++x) {
            if (y < 85) {
                ASSERT_EQ(pixel(captioned, x, y)[0], 90);
            } else {
                below.insert(pixel(captioned, x, y)[0]);
            }
        }
    }
    EXPECT_EQ(below, (std::set<int>{32, 255}));
}

TEST(Distortions, MirrorSwapsLeftAndRight) {
    const RgbPicture picture = gradient(7, 5);
    EXPECT_EQ(pixel(mirror(picture), 6, 2)[1], pixel(picture, 0, 2)[1]);
    EXPECT_EQ(pixel(mirror(picture), 0, 4)[2], pixel(picture, 6, 4)[2]);
    EXPECT_EQ(mirror(mirror(picture)).rgb, picture.rgb);
}

TEST(Distortions, AQuarterTurnBringsTheLeftEdgeUp) {
    const RgbPicture picture = gradient(7, 5);
    const RgbPicture turned = turn(picture);
    ASSERT_EQ(turned.width, 5);
    ASSERT_EQ(turned.height, 7);
    for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(pixel(turned, 4, 0)[c], pixel(picture, 0, 0)[c]);
        EXPECT_EQ(pixel(turned, 0, 0)[c], pixel(picture, 0, 4)[c]);
    }
    EXPECT_EQ(turn(turn(turn(turned))).rgb, picture.rgb);
}

TEST(Distortions, JpegKeepsTheSizeAndRoughlyTheColours) {
    const RgbPicture picture = generated_picture(0);
    const RgbPicture compressed = compress(picture, 10);
    ASSERT_EQ(compressed.width, picture.width);
    ASSERT_EQ(compressed.height, picture.height);
    EXPECT_NE(compressed.rgb, picture.rgb);
    double sum = 0;
    for (std::size_t i = 0; i < picture.rgb.size(); ++i)
        sum += std::abs(picture.rgb[i] - compressed.rgb[i]);
    EXPECT_LT(sum / static_cast<double>(picture.rgb.size()), 25);
}

TEST(Distortions, WhatIsTransparentTakesTheMeanOfTheRest) {
    const QueryPicture picture{
        4, 1, 4, {10, 20, 30, 255, 90, 60, 50, 255, 7, 7, 7, 0, 200, 0, 0, 0}};
    EXPECT_EQ(
        fill_with_mean(picture).rgb,
        (std::vector<std::uint8_t>{10, 20, 30, 90, 60, 50, 50, 40, 40, 50, 40, 40}));
    EXPECT_EQ(fill_with_mean({1, 1, 4, {9, 9, 9, 0}}).rgb,
              (std::vector<std::uint8_t>{0, 0, 0}));
}

TEST(Distortions, AColourShiftHasTheLengthAskedFor) {
    const RgbPicture grey = flat(1, 1, 128, 128, 128);
    for (int seed = 0; seed < 20; ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        const RgbPicture shifted = random_colour_shift(grey, 0.2, random);
        double square = 0;
        for (int c = 0; c < 3; ++c) square += std::pow(shifted.rgb[c] - 128.0, 2);
        // Each channel is rounded by up to half a level.
        EXPECT_NEAR(std::sqrt(square) / 255, 0.2, 0.004) << seed;
    }
}

TEST(Distortions, EveryRowHasANameOfItsOwnAndDependsOnItsRandomNumbersOnly) {
    const RgbPicture picture = generated_picture(3);
    std::set<std::string> names;
    for (const Distortion& row : distortions()) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        Random a(5);
        Random b(5);
        const QueryPicture first = row.apply(picture, a);
        EXPECT_EQ(first.pixels, row.apply(picture, b).pixels) << row.name;
        EXPECT_EQ(first.pixels.size(),
                  static_cast<std::size_t>(first.width) * first.height * first.channels)
            << row.name;
        EXPECT_EQ(&distortion(row.name), &row);
        EXPECT_EQ(first.pixels == picture.rgb, row.name == "identity") << row.name;
    }
}

}  // namespace
}  // namespace haarmony::eval
