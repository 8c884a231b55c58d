#include "engine/image/resample.h"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <tuple>

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

TEST_P(AreaAverageOfSize, FillsWhatIsTransparentWithTheMeanOfWhatIsPainted) {
    const auto [width, height] = GetParam();
    const Pixels picture = noise(width, height, 4, 12);
    const auto planes = average(picture);
    double alpha_sum = 0;
    std::array<double, 3> mean{};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const double alpha = picture.at(x, y, 3) / 255.0;
            alpha_sum += alpha;
            for (int c = 0; c < 3; ++c) mean[c] += alpha * picture.at(x, y, c) / 255.0;
        }
    }
    if (alpha_sum > 0) {
        for (double& value : mean) value /= alpha_sum;
    }
    for_some_cells(picture, [&](int row, int column, int cell) {
        for (int c = 0; c < 3; ++c) {
            const double expected =
                magnified_mean(picture, row, column, [&](int x, int y) {
                    const double alpha = picture.at(x, y, 3) / 255.0;
                    return alpha * picture.at(x, y, c) / 255.0 + (1 - alpha) * mean[c];
                });
            ASSERT_NEAR((*planes)[c][cell], expected, 1e-7)
                << "cell " << row << ", " << column;
        }
    });
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
    const auto planes = average(flat(3, 2, {200, 100, 50, 0}));
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

}  // namespace
}  // namespace haarmony::image
