#include "engine/video/panorama.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "engine/video/display.h"
#include "tests/engine/video/failing_clip.h"
#include "tests/engine/video/linked_clip.h"
#include "tests/engine/video/plain_clip.h"

namespace haarmony::video {
namespace {

using testing::plain_clip;
using testing::random_clip;
using testing::RawClip;

constexpr double kPi = std::numbers::pi;

Picture view_of(const TimeTree& clip, const PanoramaView& view) {
    Result<Picture> picture = draw_panorama(clip, {0, 0}, view);
    EXPECT_TRUE(picture.has_value());
    return *std::move(picture);
}

RawClip opaque(RawClip raw) {
    for (Picture& frame : raw.frames) {
        for (Rgba& pixel : frame.pixels) pixel.a = 255;
    }
    return raw;
}

// Grey waves of whole periods around the panorama.
RawClip waves(int width, int height, int periods, double phase) {
    RawClip raw{{width, height, {25, 1}}, {Picture(width, height)}};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const double angle = 2 * kPi * periods * (x + 0.5) / width + phase;
            const auto grey =
                static_cast<std::uint8_t>(std::lround(127 + 100 * std::cos(angle)));
            raw.frames[0].at(x, y) = {grey, grey, grey, 255};
        }
    }
    return raw;
}

TEST(Panorama, WholeTurnsGiveTheSameBytes) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> yaws(-500, 500), pitches(-40, 40);
    std::uniform_real_distribution<double> fovs(5, 140);
    const auto clip = plain_clip(random_clip(50, 20, 1, 1));
    for (int round = 0; round < 60; ++round) {
        PanoramaView view{yaws(random), pitches(random), fovs(random), 31, 17};
        const Picture picture = view_of(*clip, view);
        const double yaw = view.yaw;
        for (const double turns : {-720, -360, 360, 3600}) {
            view.yaw = yaw + turns;
            EXPECT_EQ(view_of(*clip, view), picture) << yaw << " and " << view.yaw;
        }
    }
}

TEST(Panorama, JustBelowAWholeTurnIsTheWholeTurn) {
    const auto clip = plain_clip(random_clip(50, 20, 1, 2));
    const Picture ahead = view_of(*clip, {0, 0, 60, 20, 20});
    for (const double yaw : {-1e-12, 1e-12, 360.0, std::nextafter(360.0, 0.0), -0.0}) {
        EXPECT_EQ(view_of(*clip, {yaw, 0, 60, 20, 20}), ahead) << yaw;
    }
}

TEST(Panorama, VerticalsStayVertical) {
    // Colours that depend on x alone: so does what is seen of them, at any pitch.
    RawClip raw = opaque(random_clip(96, 40, 1, 3));
    for (int y = 1; y < 40; ++y) {
        for (int x = 0; x < 96; ++x) raw.frames[0].at(x, y) = raw.frames[0].at(x, 0);
    }
    const auto clip = plain_clip(raw);
    for (const double pitch : {-35.0, 0.0, 12.0, 60.0}) {
        for (const double fov : {20.0, 90.0, 140.0}) {
            const Picture picture = view_of(*clip, {33, pitch, fov, 64, 48});
            int seen = 0;
            for (std::int32_t x = 0; x < 64; ++x) {
                Rgba column = kClear;
                for (std::int32_t y = 0; y < 48; ++y) {
                    const Rgba pixel = picture.at(x, y);
                    if (pixel == kClear) continue;
                    if (column != kClear) {
                        ASSERT_EQ(pixel, column) << x << "," << y;
                    }
                    column = pixel;
                    ++seen;
                }
            }
            EXPECT_TRUE(seen > 0 || pitch == 60) << pitch << " " << fov;
        }
    }
}

TEST(Panorama, AViewShowsWhatLiesInItsDirections) {
    // The waves seen at a column are those at the angle that it looks in.
    const int periods = 6;
    const auto clip = plain_clip(waves(1024, 16, periods, 0));
    for (const double yaw : {0.0, 90.0, 200.0, 355.0}) {
        for (const double fov : {30.0, 100.0}) {
            const Picture picture = view_of(*clip, {yaw, 0, fov, 200, 1});
            const double focal = 100 / std::tan(fov / 2 * kPi / 180);
            for (std::int32_t x = 0; x < 200; ++x) {
                const double angle = yaw * kPi / 180 + std::atan((x + 0.5 - 100) / focal);
                // Averaging over a pixel lowers the waves a little.
                ASSERT_NEAR(
                    picture.at(x, 0).r, 127 + 100 * std::cos(periods * angle), 2.5)
                    << yaw << " " << fov << " at " << x;
            }
        }
    }
}

TEST(Panorama, TheSeamIsInvisible) {
    // Turning the panorama by a part is looking that much further round, the seam or not.
    RawClip raw = opaque(random_clip(64, 32, 1, 4));
    const auto clip = plain_clip(raw);
    RawClip turned = raw;
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 64; ++x) {
            turned.frames[0].at(x, y) = raw.frames[0].at((x + 32) % 64, y);
        }
    }
    const auto turned_clip = plain_clip(turned);
    for (const double fov : {10.0, 45.0, 120.0}) {
        for (const std::int32_t width : {9, 40, 150}) {
            EXPECT_EQ(view_of(*turned_clip, {180, 5, fov, width, 20}),
                      view_of(*clip, {0, 5, fov, width, 20}));
        }
    }
}

TEST(Panorama, TheSeamIsInvisibleWhereWidthsAreNoPowersOfTwo) {
    // Smooth all round: no step at the seam is larger than elsewhere, at any level.
    const auto clip = plain_clip(waves(100, 12, 1, 0.7));
    for (const std::int32_t width : {5, 17, 60, 300}) {
        const Picture picture = view_of(*clip, {0, 0, 120, width, 1});
        const double step = 100 * (120 * kPi / 180) / width;
        for (std::int32_t x = 1; x < width; ++x) {
            EXPECT_LE(std::abs(picture.at(x, 0).r - picture.at(x - 1, 0).r),
                      2.2 * step + 2)
                << width << " at " << x;
        }
    }
}

TEST(Panorama, FromFarAwayDetailIsAveraged) {
    // Lines of one pixel, black and white: seen from where eight fall on a pixel, grey.
    RawClip raw{{512, 512, {25, 1}}, {Picture(512, 512)}};
    for (int y = 0; y < 512; ++y) {
        for (int x = 0; x < 512; ++x) {
            const auto grey = static_cast<std::uint8_t>(x % 2 == 0 ? 0 : 200);
            raw.frames[0].at(x, y) = {grey, grey, grey, 255};
        }
    }
    const auto clip = plain_clip(raw);
    const Picture picture = view_of(*clip, {10, 0, 90, 20, 20});
    for (const Rgba& pixel : picture.pixels) EXPECT_EQ(pixel, (Rgba{100, 100, 100, 255}));
}

TEST(Panorama, AboveAndBelowItIsClear) {
    // 360 degrees are 64 pixels, so 16 up and down reach atan(16 / (64 / 2 pi)).
    const auto clip = plain_clip(opaque(random_clip(64, 32, 1, 5)));
    const Picture picture = view_of(*clip, {0, 0, 90, 101, 301});
    const double focal = 50.5;
    const double reach = 16 / (64 / (2 * kPi)) * focal;  // in pixels of the middle column
    for (std::int32_t y = 0; y < 301; ++y) {
        const double away = std::abs(y + 0.5 - 150.5);
        if (std::abs(away - reach) < 0.01) continue;
        EXPECT_EQ(picture.at(50, y).a, away < reach ? 255 : 0) << y;
    }
    const Picture up = view_of(*clip, {0, 75, 20, 10, 10});
    for (const Rgba& pixel : up.pixels) EXPECT_EQ(pixel, kClear);
}

TEST(Panorama, PitchUpShowsWhatIsAbove) {
    RawClip raw = opaque(random_clip(64, 32, 1, 6));
    for (int i = 0; i < 64 * 32; ++i) {
        const auto grey = static_cast<std::uint8_t>(i < 64 * 16 ? 250 : 10);
        raw.frames[0].pixels[static_cast<std::size_t>(i)] = {grey, grey, grey, 255};
    }
    const auto clip = plain_clip(raw);
    EXPECT_EQ(view_of(*clip, {0, 20, 10, 3, 3}).at(1, 1).r, 250);
    EXPECT_EQ(view_of(*clip, {0, -20, 10, 3, 3}).at(1, 1).r, 10);
}

TEST(Panorama, YawGrowsToTheRight) {
    RawClip raw = opaque(random_clip(64, 32, 1, 7));
    for (int i = 0; i < 64 * 32; ++i) {
        const auto grey = static_cast<std::uint8_t>(i % 64);
        raw.frames[0].pixels[static_cast<std::size_t>(i)] = {grey, grey, grey, 255};
    }
    const auto clip = plain_clip(raw);
    EXPECT_NEAR(view_of(*clip, {90, 0, 2, 1, 1}).at(0, 0).r, 16, 1);
    const Picture wide = view_of(*clip, {90, 0, 60, 9, 1});
    for (std::int32_t x = 1; x < 9; ++x) EXPECT_GT(wide.at(x, 0).r, wide.at(x - 1, 0).r);
}

TEST(Panorama, HoldsForTheSmallestClips) {
    for (const auto& [width, height] : {std::array{1, 1}, {1, 9}, {3, 2}}) {
        RawClip raw{{width, height, {25, 1}}, {Picture(width, height)}};
        raw.frames[0].pixels.assign(raw.frames[0].pixels.size(), Rgba{4, 5, 6, 255});
        const auto clip = plain_clip(raw);
        for (const double fov : {1.0, 150.0}) {
            for (const std::int32_t side : {1, 7, 100}) {
                const Picture picture = view_of(*clip, {77, 0, fov, side, 1});
                for (const Rgba& pixel : picture.pixels) {
                    EXPECT_EQ(pixel, (Rgba{4, 5, 6, 255}));
                }
            }
        }
    }
}

TEST(Panorama, NamesWhatItRefuses) {
    const auto clip = plain_clip(random_clip(8, 4, 1, 8));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    const std::vector<std::pair<PanoramaView, std::string>> bad = {
        {{nan, 0, 90, 8, 8}, "yaw"},
        {{inf, 0, 90, 8, 8}, "yaw"},
        {{0, 75.5, 90, 8, 8}, "pitch"},
        {{0, nan, 90, 8, 8}, "pitch"},
        {{0, 0, 0, 8, 8}, "fov"},
        {{0, 0, 180, 8, 8}, "fov"},
        {{0, 0, 90, 0, 8}, "width"},
        {{0, 0, 90, kLargestView + 1, 8}, "width"},
        {{0, 0, 90, 8, -1}, "height"},
        {{0, 0, 90, 8, kLargestView + 1}, "height"},
    };
    for (const auto& [view, name] : bad) {
        const Result<Picture> picture = draw_panorama(*clip, {0, 0}, view);
        ASSERT_FALSE(picture.has_value()) << name;
        EXPECT_EQ(picture.error().code, ErrorCode::kInvalidArgument);
        EXPECT_EQ(picture.error().param, name);
        EXPECT_EQ(picture.error().message.find(name + " is "), 0U);
    }
}

TEST(Panorama, PassesOnWhatTheStorageMeets) {
    const auto clip = testing::linked_clip(testing::moving_clip(20, 13, 4, 9));
    EXPECT_TRUE(testing::passes_on_every_failure(*clip, [](const TimeTree& failing) {
        return draw_panorama(failing, {2, 1}, {10, 0, 60, 30, 20});
    }));
}

}  // namespace
}  // namespace haarmony::video
