#include "engine/image/resample.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>
#include <tuple>

#include "engine/image/area_kernel.h"
#include "engine/image/mask.h"
#include "tests/engine/image/pictures.h"

namespace haarmony::image {
namespace {

std::unique_ptr<ColorPlanes> average(const Pixels& picture) {
    auto planes = std::make_unique<ColorPlanes>();
    area_average(picture.view(), *planes);
    return planes;
}

// The mean over one cell from the definition: the picture magnified 128 times, each cell
// then width * height of these small squares, `sample` looked up for every one of them.
template <typename Sample>
double magnified_mean(const Pixels& picture, int row, int column, const Sample& sample) {
    double sum = 0;
    for (int t = 0; t < picture.height; ++t) {
        const int y = (row * picture.height + t) / kSide;
        for (int s = 0; s < picture.width; ++s) {
            sum += sample((column * picture.width + s) / kSide, y);
        }
    }
    return sum / (double(picture.width) * picture.height);
}

class AreaAverageOfSize : public testing::TestWithParam<std::tuple<int, int>> {};

// Every cell of a small picture, a spread of cells of a larger one.
template <typename Check>
void for_some_cells(const Pixels& picture, const Check& check) {
    const int step = 1 + picture.width * picture.height / 40;
    for (int cell = 0; cell < kCoefficientCount; cell += step) {
        check(cell / kSide, cell % kSide, cell);
    }
}

TEST_P(AreaAverageOfSize, IsTheMeanOfTheMagnifiedPicture) {
    const auto [width, height] = GetParam();
    for (const int channels : {1, 3}) {
        const Pixels picture = noise(width, height, channels, 11);
        const auto planes = average(picture);
        for_some_cells(picture, [&](int row, int column, int cell) {
            for (int c = 0; c < kChannels; ++c) {
                const double expected =
                    magnified_mean(picture, row, column, [&](int x, int y) {
                        return picture.at(x, y, channels == 1 ? 0 : c) / 255.0;
                    });
                // Half a unit in the last place of a float below 1, and of the oracle's sum.
                ASSERT_NEAR((*planes)[c][cell], expected, 6e-8)
                    << channels << " channels, cell " << row << ", " << column;
            }
        });
    }
}

TEST_P(AreaAverageOfSize, IgnoresAVeilOverAllOfThePicture) {
    const auto [width, height] = GetParam();
    const Pixels rgb = noise(width, height, 3, 18);
    for (const int alpha : {1, 77, 254}) {
        Pixels veiled = flat(width, height, {0, 0, 0, static_cast<std::uint8_t>(alpha)});
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                for (int c = 0; c < 3; ++c) veiled.at(x, y, c) = rgb.at(x, y, c);
            }
        }
        const auto planes = std::make_unique<ColorPlanes>();
        EXPECT_EQ(area_average(veiled.view(), *planes), nullptr) << alpha;
        EXPECT_EQ(*planes, *average(rgb)) << alpha;
    }
}

TEST_P(AreaAverageOfSize, OfOneColorHasEqualCellsWhateverTheAlpha) {
    const auto [width, height] = GetParam();
    const Pixels rgb = flat(width, height, {7, 133, 251});
    Pixels rgba = noise(width, height, 4, 13);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < 3; ++c) rgba.at(x, y, c) = rgb.at(x, y, c);
        }
    }
    rgba.at(0, 0, 3) = 1;
    const auto from_rgb = average(rgb);
    const auto from_rgba = average(rgba);
    for (int c = 0; c < kChannels; ++c) {
        const float expected = static_cast<float>(rgb.at(0, 0, c) / 255.0);
        const std::set<float> opaque((*from_rgb)[c].begin(), (*from_rgb)[c].end());
        const std::set<float> veiled((*from_rgba)[c].begin(), (*from_rgba)[c].end());
        EXPECT_EQ(opaque, std::set<float>{expected});
        EXPECT_EQ(veiled, std::set<float>{expected});
    }
}

TEST_P(AreaAverageOfSize, OfGreyHasEqualPlanesInEveryForm) {
    const auto [width, height] = GetParam();
    const Pixels grey = noise(width, height, 1, 14);
    Pixels rgb = flat(width, height, {0, 0, 0});
    Pixels rgba = flat(width, height, {0, 0, 0, 255});
    Pixels veiled = noise(width, height, 4, 15);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < 3; ++c) {
                rgb.at(x, y, c) = grey.at(x, y, 0);
                rgba.at(x, y, c) = grey.at(x, y, 0);
                veiled.at(x, y, c) = grey.at(x, y, 0);
            }
        }
    }
    const auto planes = average(grey);
    EXPECT_EQ(*average(rgb), *planes);
    EXPECT_EQ(*average(rgba), *planes);
    EXPECT_EQ((*planes)[1], (*planes)[0]);
    EXPECT_EQ((*planes)[2], (*planes)[0]);
    const auto filled = average(veiled);
    EXPECT_EQ((*filled)[1], (*filled)[0]);
    EXPECT_EQ((*filled)[2], (*filled)[0]);
}

TEST_P(AreaAverageOfSize, OfAnOpaquePictureIgnoresTheAlphaChannel) {
    const auto [width, height] = GetParam();
    const Pixels rgb = noise(width, height, 3, 16);
    Pixels rgba = flat(width, height, {0, 0, 0, 255});
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < 3; ++c) rgba.at(x, y, c) = rgb.at(x, y, c);
        }
    }
    EXPECT_EQ(*average(rgba), *average(rgb));
}

INSTANTIATE_TEST_SUITE_P(Sizes,
                         AreaAverageOfSize,
                         testing::Values(std::tuple(1, 1),
                                         std::tuple(1, 9),
                                         std::tuple(300, 1),
                                         std::tuple(5, 3),
                                         std::tuple(127, 129),
                                         std::tuple(128, 128),
                                         std::tuple(256, 128),
                                         std::tuple(333, 200)));

// Cells from the definition, with nothing filled in: the mean colour of what is painted, and
// how much of the cell is, the most opaque cell being 1.
class AreaAverageOfPainted : public testing::TestWithParam<std::tuple<int, int>> {};

TEST_P(AreaAverageOfPainted, ExtendsTheMeansOfWhatIsPainted) {
    const auto [width, height] = GetParam();
    Pixels picture = noise(width, height, 4, 12);
    for (std::size_t i = 3; i < picture.bytes.size(); i += 12) picture.bytes[i] = 0;
    const auto expected_cover = std::make_unique<Plane>();
    const auto expected = std::make_unique<ColorPlanes>();
    for (int i = 0; i < kCoefficientCount; ++i) {
        const auto alpha = [&](int x, int y) { return picture.at(x, y, 3) / 255.0; };
        const double cover = magnified_mean(picture, i / kSide, i % kSide, alpha);
        (*expected_cover)[i] = static_cast<float>(cover);
        if (cover == 0) continue;
        for (int c = 0; c < 3; ++c) {
            const double color =
                magnified_mean(picture, i / kSide, i % kSide, [&](int x, int y) {
                    return alpha(x, y) * picture.at(x, y, c) / 255.0;
                });
            (*expected)[c][i] = static_cast<float>(color / cover);
        }
    }
    const auto planes = std::make_unique<ColorPlanes>();
    const std::unique_ptr<Plane> cover = area_average(picture.view(), *planes);
    const float most = std::ranges::max(*expected_cover);
    if (most == 0) {
        ASSERT_NE(cover, nullptr);
        EXPECT_EQ(*cover, *expected_cover);
        return;
    }
    for (float& value : *expected_cover) value /= most;
    if (cover == nullptr) {
        EXPECT_EQ(std::ranges::min(*expected_cover), 1.0F);
        return;
    }
    extend_painted(*expected_cover, *expected);
    for (int i = 0; i < kCoefficientCount; ++i) {
        ASSERT_NEAR((*cover)[i], (*expected_cover)[i], 1e-6) << i;
        for (int c = 0; c < 3; ++c) {
            // Rounded to float before and after it is extended.
            ASSERT_NEAR((*planes)[c][i], (*expected)[c][i], 1e-6) << "cell " << i;
        }
    }
}

// Small: the oracle magnifies them for each of the 16,384 cells.
INSTANTIATE_TEST_SUITE_P(Sizes,
                         AreaAverageOfPainted,
                         testing::Values(std::tuple(1, 1),
                                         std::tuple(1, 9),
                                         std::tuple(150, 1),
                                         std::tuple(5, 3),
                                         std::tuple(13, 11)));

TEST(AreaAverage, OfTwoByTwoPixelsIsFourQuarters) {
    Pixels picture = flat(2, 2, {0});
    picture.at(1, 0, 0) = 51;
    picture.at(0, 1, 0) = 102;
    picture.at(1, 1, 0) = 255;
    const auto planes = average(picture);
    for (int i = 0; i < kSide; ++i) {
        for (int j = 0; j < kSide; ++j) {
            const float expected =
                static_cast<float>(picture.at(j / 64, i / 64, 0) / 255.0);
            ASSERT_EQ((*planes)[0][i * kSide + j], expected) << i << ", " << j;
        }
    }
}

TEST(AreaAverage, OfNothingPaintedIsBlack) {
    const Pixels picture = flat(3, 2, {200, 100, 50, 0});
    const auto planes = std::make_unique<ColorPlanes>();
    const std::unique_ptr<Plane> cover = area_average(picture.view(), *planes);
    ASSERT_NE(cover, nullptr);
    EXPECT_EQ(std::set<float>(cover->begin(), cover->end()), std::set<float>{0.0F});
    for (const Plane& plane : *planes) {
        EXPECT_EQ(std::set<float>(plane.begin(), plane.end()), std::set<float>{0.0F});
    }
}

TEST(AreaAverage, RespectsTheRowStride) {
    const Pixels whole = noise(40, 30, 3, 17);
    Pixels part = flat(25, 30, {0, 0, 0});
    for (int y = 0; y < part.height; ++y) {
        for (int x = 0; x < part.width; ++x) {
            for (int c = 0; c < 3; ++c) part.at(x, y, c) = whole.at(x, y, c);
        }
    }
    ImageView window = whole.view();
    window.width = part.width;
    ColorPlanes* planes = new ColorPlanes;
    const std::unique_ptr<ColorPlanes> owner(planes);
    area_average(window, *planes);
    EXPECT_EQ(*planes, *average(part));
}

// The largest sums there are: a row stride of 0 makes one row of bytes a tall picture.
TEST(AreaAverage, OfTheLargestPictureDoesNotOverflow) {
    for (const int channels : {1, 4}) {
        const std::vector<std::uint8_t> row(std::size_t{kMaxPictureSide} * channels, 255);
        const ImageView tall{row.data(), 600, kMaxPictureSide, channels, 0};
        const ImageView wide{row.data(), kMaxPictureSide, 600, channels, 0};
        for (const ImageView& view : {tall, wide}) {
            const auto planes = std::make_unique<ColorPlanes>();
            area_average(view, *planes);
            for (const Plane& plane : *planes) {
                EXPECT_EQ(std::set<float>(plane.begin(), plane.end()),
                          std::set<float>{1.0F});
            }
        }
    }
}

// Pictures whose sums do not fit AreaSums are added up by other code.
TEST(AreaAverage, OfARowRepeatedIsThatOfTheRowHoweverTall) {
    constexpr int kHeight = 20000;
    for (const int channels : {1, 3}) {
        const Pixels row = noise(600, 1, channels, 18);
        ImageView tall = row.view();
        tall.height = kHeight;
        tall.row_stride = 0;
        ASSERT_FALSE(AreaSums::fits(tall));
        const auto planes = std::make_unique<ColorPlanes>();
        area_average(tall, *planes);
        EXPECT_EQ(*planes, *average(row)) << channels << " channels";
    }
}

}  // namespace
}  // namespace haarmony::image
