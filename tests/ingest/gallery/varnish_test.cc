#include "ingest/gallery/varnish.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace haarmony::gallery {
namespace {

constexpr Varnish kNone{.bloom = 0, .vignette = 0, .grain = 0};

TEST(Varnish, DisplayValuesFollowTheSrgbCurve) {
    // Below the shoulder, where highlights begin to roll off.
    constexpr int kSteps = 700;
    Canvas canvas(kSteps, 1);
    for (int x = 0; x < kSteps; ++x) {
        const double light = x / 1000.0;
        canvas.set(x, 0, {light, light, light});
    }
    const auto bytes = to_bytes(kNone, canvas);
    for (int x = 0; x < kSteps; ++x) {
        const double light = x / 1000.0;
        const double value =
            light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
        EXPECT_NEAR(bytes[static_cast<std::size_t>(x) * 3], 255 * value, 0.6) << light;
    }
}

TEST(Varnish, BrighterLightIsNeverDarker) {
    Canvas canvas(1000, 1);
    for (int x = 0; x < 1000; ++x) canvas.set(x, 0, {x / 100.0, 0, 0});
    const auto bytes = to_bytes(kNone, canvas);
    for (std::size_t x = 1; x < 1000; ++x)
        ASSERT_GE(bytes[3 * x], bytes[3 * (x - 1)]) << "at " << x;
    EXPECT_EQ(bytes[3 * 999], 255);
}

TEST(Varnish, WithoutCoatsTheCanvasStaysAsItIs) {
    Canvas canvas(8, 8);
    canvas.cover([](Point p) { return Color{p.x, p.y, 3}; });
    const Canvas before = canvas;
    apply(kNone, canvas);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) EXPECT_EQ(canvas.at(x, y).r, before.at(x, y).r);
}

TEST(Varnish, BloomSpillsLightOverItsSurroundings) {
    Canvas canvas(64, 64);
    canvas.disc({0.5, 0.5}, 0.1, {9, 9, 9});
    apply({.bloom = 0.5, .vignette = 0, .grain = 0}, canvas);
    EXPECT_GT(canvas.at(32, 23).g, 0.01);
    EXPECT_LT(canvas.at(0, 0).g, 1e-6);
}

TEST(Varnish, VignetteDarkensTheCornersOnly) {
    Canvas canvas(33, 33);
    canvas.cover([](Point) { return Color{1, 1, 1}; });
    apply({.bloom = 0, .vignette = 0.3, .grain = 0}, canvas);
    EXPECT_NEAR(canvas.at(16, 16).r, 1, 1e-6);
    EXPECT_NEAR(canvas.at(0, 0).r, 0.72, 0.02);
}

TEST(Varnish, GrainHasNoBias) {
    Canvas canvas(200, 200);
    canvas.cover([](Point) { return Color{0.2, 0.2, 0.2}; });
    const auto plain = to_bytes(kNone, canvas);
    const auto grainy =
        to_bytes({.bloom = 0, .vignette = 0, .grain = 0.02, .seed = 5}, canvas);
    double sum = 0;
    int differing = 0;
    for (std::size_t i = 0; i < plain.size(); ++i) {
        sum += grainy[i] - plain[i];
        differing += grainy[i] != plain[i] ? 1 : 0;
    }
    // Rounding alone may shift the mean by half a step.
    EXPECT_LT(std::fabs(sum / static_cast<double>(plain.size())), 0.6);
    EXPECT_GT(differing, static_cast<int>(plain.size() / 2));
}

}  // namespace
}  // namespace haarmony::gallery
