#include "engine/image/autocrop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "tests/engine/image/pictures.h"

namespace haarmony::image {
namespace {

struct Border {
    int left = 0;
    int top = 0;
    int right = 0;
    int bottom = 0;
};

// A picture of noise in a border of one colour.
Pixels framed(const Pixels& content,
              const Border& border,
              const std::vector<std::uint8_t>& color) {
    Pixels picture = flat(content.width + border.left + border.right,
                          content.height + border.top + border.bottom,
                          color);
    for (int y = 0; y < content.height; ++y) {
        for (int x = 0; x < content.width; ++x) {
            for (int c = 0; c < content.channels; ++c) {
                picture.at(x + border.left, y + border.top, c) = content.at(x, y, c);
            }
        }
    }
    return picture;
}

CropBox box_of(const Pixels& content, const Border& border) {
    return {border.left, border.top, content.width, content.height};
}

const std::vector<Border>& borders() {
    static const std::vector<Border> all = {{20, 15, 20, 15},
                                            {0, 30, 0, 30},
                                            {40, 0, 40, 0},
                                            {7, 0, 0, 0},
                                            {0, 1, 0, 0},
                                            {0, 0, 33, 0},
                                            {0, 0, 0, 12},
                                            {1, 2, 3, 60}};
    return all;
}

TEST(ContentBox, IsTheContentWhateverItsBorders) {
    for (const int channels : {1, 3, 4}) {
        const Pixels content = noise(100, 80, channels, 1);
        for (const Border& border : borders()) {
            for (const int level : {0, 128, 255}) {
                std::vector<std::uint8_t> color(channels,
                                                static_cast<std::uint8_t>(level));
                if (channels == 4) color[3] = 255;
                EXPECT_EQ(content_box(framed(content, border, color).view()),
                          box_of(content, border))
                    << channels << " channels, level " << level << ", left "
                    << border.left << ", top " << border.top;
            }
        }
    }
}

TEST(ContentBox, TakesEachSideByItsOwnColor) {
    const Pixels content = noise(100, 80, 3, 2);
    const Pixels bars = framed(content, {0, 10, 0, 0}, {0, 0, 0});
    const Pixels page = framed(bars, {15, 0, 0, 0}, {255, 255, 255});
    const Pixels both = framed(page, {0, 0, 0, 20}, {200, 30, 30});
    // The white bar ends above the red one: it is found within the rows that are left, and
    // so is the black one only where the white one does not disturb it.
    EXPECT_EQ(content_box(both.view())->height + content_box(both.view())->y, 90);
    EXPECT_EQ(content_box(both.view())->x, 15);
}

TEST(ContentBox, DoesNotMindTheNoiseOfCompression) {
    const Pixels content = noise(100, 80, 3, 3);
    Pixels picture = framed(content, {20, 15, 10, 5}, {240, 240, 240});
    std::mt19937 random(4);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const bool inside = x >= 20 && x < 120 && y >= 15 && y < 95;
            for (int c = 0; c < 3 && !inside; ++c) {
                picture.at(x, y, c) = static_cast<std::uint8_t>(234 + random() % 13);
            }
        }
    }
    EXPECT_EQ(content_box(picture.view()), (CropBox{20, 15, 100, 80}));
}

TEST(ContentBox, TakesWhatIsTransparentForBorderWhateverItsColor) {
    const Pixels content = framed(noise(100, 80, 3, 5), {}, {0, 0, 0});
    Pixels picture = noise(140, 110, 4, 6);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const bool inside = x >= 20 && x < 120 && y >= 15 && y < 95;
            picture.at(x, y, 3) = inside ? 255 : 0;
            for (int c = 0; c < 3 && inside; ++c) {
                picture.at(x, y, c) = content.at(x - 20, y - 15, c);
            }
        }
    }
    EXPECT_EQ(content_box(picture.view()), (CropBox{20, 15, 100, 80}));
}

TEST(ContentBox, IsNothingWithoutBorders) {
    EXPECT_EQ(content_box(noise(100, 80, 3, 7).view()), std::nullopt);
    EXPECT_EQ(content_box(noise(1, 1, 3, 8).view()), std::nullopt);
}

TEST(ContentBox, OfAFlatPictureIsNothing) {
    for (const auto& [width, height] : {std::pair(1, 1), {2, 9}, {100, 80}}) {
        EXPECT_EQ(content_box(flat(width, height, {9, 99, 199}).view()), std::nullopt);
        EXPECT_EQ(content_box(flat(width, height, {9, 99, 199, 0}).view()), std::nullopt);
    }
}

// A sky grows lighter line by line until it meets the ground.
TEST(ContentBox, LeavesASkyThatChangesSlowly) {
    Pixels picture = noise(100, 200, 3, 9);
    for (int y = 0; y < 100; ++y) {
        for (int x = 0; x < 100; ++x) {
            for (int c = 0; c < 3; ++c) {
                picture.at(x, y, c) =
                    static_cast<std::uint8_t>(120 + y / 4 * (c + 1) / 2);
            }
        }
    }
    EXPECT_EQ(content_box(picture.view()), std::nullopt);
}

// Content that begins with a few pixels only: the peak of a mountain, not a frame.
TEST(ContentBox, LeavesAPlainSkyAboveAPeak) {
    Pixels picture = flat(200, 200, {90, 120, 220});
    for (int y = 60; y < 200; ++y) {
        for (int x = std::max(0, 160 - y); x < std::min(200, 40 + y); ++x) {
            for (int c = 0; c < 3; ++c) picture.at(x, y, c) = 40;
        }
    }
    EXPECT_EQ(content_box(picture.view()), std::nullopt);
}

TEST(ContentBox, TakesNoMoreThanNineTwentiethsOfASide) {
    const Pixels content = noise(200, 111, 3, 10);
    EXPECT_EQ(content_box(framed(content, {0, 89, 0, 0}, {0, 0, 0}).view()),
              (CropBox{0, 89, 200, 111}));
    EXPECT_EQ(
        content_box(framed(noise(200, 109, 3, 11), {0, 91, 0, 0}, {0, 0, 0}).view()),
        std::nullopt);
}

TEST(Cropped, ShowsTheSamePixels) {
    const Pixels picture = noise(30, 20, 3, 12);
    const ImageView part = cropped(picture.view(), {4, 5, 7, 8});
    EXPECT_EQ(part.width, 7);
    EXPECT_EQ(part.height, 8);
    for (int y = 0; y < part.height; ++y) {
        for (int x = 0; x < part.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                ASSERT_EQ(part.row(y)[x * 3 + c], picture.at(x + 4, y + 5, c));
            }
        }
    }
}

}  // namespace
}  // namespace haarmony::image
