// What foreign files become, against pictures computed by other means.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string_view>
#include <utility>

#include "tests/engine/video/tree_pixels.h"
#include "tests/ingest/video/clips.h"
#include "tests/ingest/video/gif_file.h"

namespace haarmony::ingest {
namespace {

using namespace testing;
using ::testing::Each;
using ::testing::ElementsAre;

// Moving rectangles with holes, each disposed of in another way.
Gif sample_gif() {
    Gif gif = {20, 14, {}};
    const std::array<Disposal, 3> disposals = {
        Disposal::kLeave, Disposal::kClear, Disposal::kRestore};
    for (int i = 0; i < 9; ++i) {
        GifFrame frame;
        frame.box = i == 0 ? video::PixelBox{0, 0, 20, 14}
                           : video::PixelBox{i, i % 5, 9, 7 + i % 2};
        for (int p = 0; p < frame.box.width * frame.box.height; ++p) {
            frame.indices.push_back(
                static_cast<std::uint8_t>(p % 3 == i % 3 ? 0 : (p * 5 + i) % 128));
        }
        frame.disposal = disposals[static_cast<std::size_t>(i % 3)];
        gif.frames.push_back(frame);
    }
    return gif;
}

TEST(GifSource, DrawsAndDisposesAsTheDefinitionSays) {
    const Gif gif = sample_gif();
    const auto shown = decode_here(write_gif(gif));
    ASSERT_TRUE(shown) << shown.error().message;
    EXPECT_EQ(shown->format, (video::FrameFormat{20, 14, {10, 1}}));
    EXPECT_EQ(shown->pictures, draw_gif(gif));
}

TEST(GifSource, TheRateIsTheAverageAndEveryFrameIsOne) {
    Gif gif = sample_gif();
    for (std::size_t i = 0; i < gif.frames.size(); ++i) {
        gif.frames[i].delay_cs = i == 4 ? 60 : 5;
    }
    const auto shown = decode_in_child(write_gif(gif));
    ASSERT_TRUE(shown) << shown.error().message;
    EXPECT_EQ(shown->pictures.size(), 9U);
    EXPECT_EQ(shown->format.rate, (video::FrameRate{9, 1})) << "9 frames in one second";
    EXPECT_EQ(shown->times_us[4], 200'000);
    EXPECT_EQ(shown->times_us[5], 800'000);
}

TEST(WebpSource, ShowsAnimationsAsTheyWereMade) {
    const Clip clip = moving_clip({40, 30, {10, 1}}, 5, Alpha::kRandom);
    const Bytes file = animated_webp(clip, {100, 100, 300, 100, 400});
    const auto shown = decode_in_child(file);
    ASSERT_TRUE(shown) << shown.error().message;
    EXPECT_EQ(shown->pictures, clip.pictures);
    EXPECT_EQ(shown->format.rate, (video::FrameRate{5, 1})) << "5 frames in one second";
    EXPECT_THAT(shown->times_us, ElementsAre(0, 100'000, 200'000, 500'000, 600'000));
}

TEST(WebpSource, AnimationsWithoutDurationsShowTenFramesASecond) {
    const Clip clip = moving_clip({40, 30, {10, 1}}, 1, Alpha::kOpaque);
    const auto shown = decode_here(animated_webp(clip, {0}));
    ASSERT_TRUE(shown) << shown.error().message;
    EXPECT_EQ(shown->pictures, clip.pictures);
    EXPECT_EQ(shown->format.rate, (video::FrameRate{10, 1}));
}

// BT.601 and BT.709 by their definition (the weights of red and blue), limited range.
video::Rgba rgb_of(const Yuv& color, double red, double blue) {
    const double y = (color.y - 16) / 219.0;
    const double pr = (color.v - 128) / 112.0 * (1 - red);
    const double pb = (color.u - 128) / 112.0 * (1 - blue);
    const double green = 1 - red - blue;
    const auto byte = [](double value) {
        return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
    };
    return {byte(y + pr), byte(y - (red * pr + blue * pb) / green), byte(y + pb), 255};
}

TEST(Colours, AreBt601InSmallAndBt709InLargePictures) {
    const std::vector<Yuv> colors = {{16, 128, 128},
                                     {235, 128, 128},
                                     {81, 90, 200},
                                     {145, 54, 34},
                                     {60, 220, 110},
                                     {180, 100, 150}};
    for (const int height : {718, 720}) {
        const auto shown = decode_here(y4m_of(2, height, colors));
        ASSERT_TRUE(shown) << shown.error().message;
        EXPECT_EQ(shown->format, (video::FrameFormat{2, height, {24'000, 1001}}));
        ASSERT_EQ(shown->pictures.size(), colors.size());
        for (std::size_t i = 0; i < colors.size(); ++i) {
            video::Picture expected(2, height);
            const video::Rgba color = height < 720 ? rgb_of(colors[i], 0.299, 0.114)
                                                   : rgb_of(colors[i], 0.2126, 0.0722);
            std::fill(expected.pixels.begin(), expected.pixels.end(), color);
            EXPECT_LE(largest_difference(shown->pictures[i], expected), 1)
                << "height " << height << " colour " << i;
        }
    }
}

TEST(StillSource, IsAClipOfOneFrame) {
    const Clip clip = moving_clip({21, 17, {25, 1}}, 1, Alpha::kRandom);
    // Without its animation chunks an APNG is a PNG.
    Bytes still;
    const Bytes apng = write_film(clip, Container::kApng);
    for (std::size_t at = 8, next = 0; at < apng.size(); at = next) {
        next = at + 12 + (std::size_t{apng[at + 2]} << 8 | apng[at + 3]);
        const std::string_view type(reinterpret_cast<const char*>(&apng[at + 4]), 4);
        if (still.empty()) still.assign(apng.begin(), apng.begin() + 8);
        if (type == "acTL" || type == "fcTL") continue;
        still.insert(still.end(),
                     apng.begin() + static_cast<std::ptrdiff_t>(at),
                     apng.begin() + static_cast<std::ptrdiff_t>(next));
    }
    const auto shown = decode_here(still);
    ASSERT_TRUE(shown) << shown.error().message;
    EXPECT_EQ(shown->pictures, clip.pictures);
}

// The matrix of a film of one track, in its tkhd box.
void set_matrix(Bytes& film, const std::array<int, 4>& abcd) {
    constexpr std::string_view kBox = "tkhd";
    const auto box = std::search(film.begin(), film.end(), kBox.begin(), kBox.end());
    ASSERT_NE(box, film.end());
    const auto matrix = box + 4 + 40;
    const std::array<std::ptrdiff_t, 4> places = {0, 4, 12, 16};
    for (std::size_t i = 0; i < 4; ++i) {
        const std::uint8_t high = abcd[i] < 0 ? 0xff : 0;
        const auto low = static_cast<std::uint8_t>(abcd[i]);
        const std::array<std::uint8_t, 4> fixed = {high, low, 0, 0};
        std::copy(fixed.begin(), fixed.end(), matrix + places[i]);
    }
}

TEST(Mp4Source, IsTurnedAsItsDisplayMatrixSays) {
    const Clip clip = moving_clip({32, 20, {25, 1}}, 2, Alpha::kOpaque);
    const Bytes film = write_film(clip, Container::kMp4);
    const auto upright = decode_here(film);
    ASSERT_TRUE(upright) << upright.error().message;
    // (x, y) of the file's picture is found where the turned one must show it.
    struct Case {
        std::array<int, 4> matrix;
        int width;
        std::array<int, 2> (*place)(int x, int y);
    };
    const std::array<Case, 5> cases = {{
        {{1, 0, 0, 1},
         32,
         [](int x, int y) {
             return std::array{x, y};
         }},
        {{0, 1, -1, 0},
         20,
         [](int x, int y) {
             return std::array{19 - y, x};
         }},
        {{-1, 0, 0, -1},
         32,
         [](int x, int y) {
             return std::array{31 - x, 19 - y};
         }},
        {{0, -1, 1, 0},
         20,
         [](int x, int y) {
             return std::array{y, 31 - x};
         }},
        {{-1, 0, 0, 1},
         32,
         [](int x, int y) {
             return std::array{31 - x, y};
         }},
    }};
    for (const Case& turned : cases) {
        Bytes file = film;
        set_matrix(file, turned.matrix);
        const auto shown = decode_here(file);
        ASSERT_TRUE(shown) << shown.error().message;
        ASSERT_EQ(shown->format.width, turned.width);
        ASSERT_EQ(shown->pictures.size(), 2U);
        for (int y = 0; y < 20; ++y) {
            for (int x = 0; x < 32; ++x) {
                const auto [u, v] = turned.place(x, y);
                ASSERT_EQ(shown->pictures[1].at(u, v), upright->pictures[1].at(x, y))
                    << x << ", " << y;
            }
        }
    }
}

TEST(KeyFrames, AreThoseOfTheFilmWithTheirTimes) {
    // One key frame in two seconds: every second frame at one a second.
    const Clip clip = moving_clip({64, 48, {1, 1}}, 7, Alpha::kOpaque);
    const Bytes film = write_film(clip, Container::kMp4);
    const auto all = decode_here(film);
    VideoSourceOptions options;
    options.frames = VideoFrames::kKey;
    const auto keys = decode_in_child(film, options);
    ASSERT_TRUE(all) << all.error().message;
    ASSERT_TRUE(keys) << keys.error().message;
    EXPECT_THAT(keys->times_us, ElementsAre(0, 2'000'000, 4'000'000, 6'000'000));
    ASSERT_EQ(all->pictures.size(), 7U);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(keys->pictures[i], all->pictures[2 * i]) << i;
    }
}

TEST(VideoSource, APictureMayBeMovedAwayBeforeTheNext) {
    const Clip clip = moving_clip({40, 30, {10, 1}}, 3, Alpha::kRandom);
    const auto pictures = open_video(write_film(clip, Container::kApng), {});
    ASSERT_TRUE(pictures) << pictures.error().message;
    TimedPicture shown;
    for (const video::Picture& picture : clip.pictures) {
        const auto more = (*pictures)->next(shown);
        ASSERT_TRUE(more && *more);
        const video::Picture moved = std::move(shown.picture);
        EXPECT_EQ(moved, picture);
    }
}

TEST(PictureFrameSource, HandsOnEveryPictureAsATree) {
    const Clip clip = moving_clip({40, 30, {10, 1}}, 3, Alpha::kRandom);
    auto pictures = open_video(write_film(clip, Container::kApng), {});
    ASSERT_TRUE(pictures) << pictures.error().message;
    PictureFrameSource source(std::move(pictures).value());
    EXPECT_EQ(source.format(), clip.format);
    video::SourceFrame frame;
    for (const video::Picture& picture : clip.pictures) {
        const auto more = source.next(frame);
        ASSERT_TRUE(more && *more);
        EXPECT_EQ(frame.repeats, 1);
        EXPECT_EQ(video::testing::picture_of(frame.tree, clip.format), picture);
    }
    const auto more = source.next(frame);
    ASSERT_TRUE(more);
    EXPECT_FALSE(*more);
}

}  // namespace
}  // namespace haarmony::ingest
