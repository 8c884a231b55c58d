#include "ingest/gallery/canvas.h"

#include <gtest/gtest.h>

#include <cmath>

namespace haarmony::gallery {
namespace {

void expect_color(const Color& actual, const Color& expected, double tolerance) {
    EXPECT_NEAR(actual.r, expected.r, tolerance);
    EXPECT_NEAR(actual.g, expected.g, tolerance);
    EXPECT_NEAR(actual.b, expected.b, tolerance);
}

TEST(Canvas, StartsBlackAndKeepsWhatIsSet) {
    Canvas canvas(3, 2);
    expect_color(canvas.at(2, 1), {0, 0, 0}, 0);
    canvas.set(2, 1, {0.5, 2, 0.25});
    expect_color(canvas.at(2, 1), {0.5, 2, 0.25}, 0);
    expect_color(canvas.at(1, 1), {0, 0, 0}, 0);
}

TEST(Canvas, FillsAreWeighedByCoverageAndOpacity) {
    Canvas canvas(4, 4);
    canvas.cover([](Point) { return Color{0, 0, 1}; });
    // The left half of column 1: 4 pixels of height, so x from 0.25 to 0.375.
    canvas.rectangle({0.25, 0}, {0.375, 1}, {1, 0, 0}, 0.5);
    expect_color(canvas.at(0, 2), {0, 0, 1}, 1e-6);
    expect_color(canvas.at(1, 2), {0.25, 0, 0.75}, 1e-6);
    expect_color(canvas.at(2, 2), {0, 0, 1}, 1e-6);
}

TEST(Canvas, GlazeDarkensOnlyWhereItCovers) {
    Canvas canvas(4, 4);
    canvas.cover([](Point) { return Color{0.8, 0.8, 0.8}; });
    const Point left[] = {{0, 0}, {0.5, 0}, {0.5, 1}, {0, 1}};
    canvas.glaze(cover_polygon(canvas.frame(), left), {0.5, 0.25, 1});
    expect_color(canvas.at(1, 1), {0.4, 0.2, 0.8}, 1e-6);
    expect_color(canvas.at(2, 1), {0.8, 0.8, 0.8}, 1e-6);
}

TEST(Canvas, GlowFadesToNothingAtItsRadius) {
    Canvas canvas(64, 64);
    canvas.glow({0.5, 0.5}, 0.25, {1, 1, 1});
    EXPECT_GT(canvas.at(32, 32).r, 0.98);
    EXPECT_GT(canvas.at(32, 32).r, canvas.at(40, 32).r);
    EXPECT_GT(canvas.at(40, 32).r, 0);
    EXPECT_EQ(canvas.at(49, 32).r, 0);
}

TEST(Canvas, SampleIsLinearBetweenPixels) {
    Canvas canvas(2, 2);
    canvas.set(0, 0, {1, 0, 0});
    canvas.set(1, 0, {0, 1, 0});
    canvas.set(0, 1, {0, 0, 1});
    canvas.set(1, 1, {1, 1, 1});
    expect_color(canvas.sample(canvas.point(0, 1)), {0, 0, 1}, 1e-6);
    expect_color(canvas.sample({0.5, 0.5}), {0.5, 0.5, 0.5}, 1e-6);
    expect_color(canvas.sample({-9, -9}), {1, 0, 0}, 1e-6);
    expect_color(canvas.sample({9, 9}), {1, 1, 1}, 1e-6);
}

TEST(Canvas, MasksBeyondThePictureDoNoHarm) {
    Canvas canvas(8, 8);
    const Mask spilt =
        soften(canvas.frame(), cover_disc(canvas.frame(), {0, 0}, 0.4), 0.2);
    ASSERT_LT(spilt.left, 0);
    canvas.fill(spilt, {1, 1, 1});
    EXPECT_GT(canvas.at(0, 0).r, 0.2);
}

}  // namespace
}  // namespace haarmony::gallery
