#include "engine/image/area_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/engine/image/each_target.h"
#include "tests/engine/image/pictures.h"

namespace haarmony::image {
namespace {

using Sums = std::vector<std::uint32_t>;

// From the definition: each pixel cut into columns x rows parts, and every part added to the
// cell that it lies in; along one axis first, which changes no sum.
Sums by_parts(const Pixels& picture, int columns, int rows) {
    const auto length_in = [](int pixel, int cell, int cells, int length) {
        int parts = 0;
        for (int part = pixel * cells; part < (pixel + 1) * cells; ++part) {
            parts += part / length == cell ? 1 : 0;
        }
        return parts;
    };
    Sums sums;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            std::vector<std::uint64_t> cell(static_cast<std::size_t>(picture.channels));
            for (int y = row * picture.height / rows;
                 y <= ((row + 1) * picture.height - 1) / rows;
                 ++y) {
                const int tall = length_in(y, row, rows, picture.height);
                for (int x = column * picture.width / columns;
                     x <= ((column + 1) * picture.width - 1) / columns;
                     ++x) {
                    const int wide = length_in(x, column, columns, picture.width);
                    for (int c = 0; c < picture.channels; ++c) {
                        cell[static_cast<std::size_t>(c)] +=
                            std::uint64_t(tall) * wide * picture.at(x, y, c);
                    }
                }
            }
            sums.insert(sums.end(), cell.begin(), cell.end());
        }
    }
    return sums;
}

Sums by_kernel(const ImageView& picture, int columns, int rows) {
    AreaSums area(picture, columns, rows);
    Sums sums;
    for (int row = 0; row < rows; ++row) {
        const auto cells = area.row(row);
        sums.insert(sums.end(), cells.begin(), cells.end());
    }
    return sums;
}

struct Case {
    int width, height, columns, rows;
};

// One pixel, one line, smaller and larger than the grid, all three widths of cells, and runs
// of samples shorter and longer than a vector.
const std::vector<Case> kCases = {{1, 1, 1, 1},
                                  {1, 1, 128, 128},
                                  {1, 9, 128, 128},
                                  {300, 1, 128, 128},
                                  {5, 3, 7, 2},
                                  {11, 7, 3, 2},
                                  {127, 129, 128, 128},
                                  {128, 128, 128, 128},
                                  {200, 150, 128, 128},
                                  {333, 200, 128, 128},
                                  {481, 33, 128, 16},
                                  {700, 40, 128, 8},
                                  {64, 700, 9, 2},
                                  {301, 211, 257, 101},
                                  {97, 61, 96, 60}};

TEST(AreaSums, AreTheSumsOfTheParts) {
    for (const Case& size : kCases) {
        for (const int channels : {1, 3}) {
            const Pixels picture = noise(size.width, size.height, channels, 21);
            const Sums expected = by_parts(picture, size.columns, size.rows);
            for_each_target([&](const char* target) {
                ASSERT_EQ(by_kernel(picture.view(), size.columns, size.rows), expected)
                    << target << ": " << size.width << " x " << size.height << " in "
                    << size.columns << " x " << size.rows << ", " << channels
                    << " channels";
            });
        }
    }
}

TEST(AreaSums, OfWhiteAreTheAreaEvenWhereSumsAreLargest) {
    // A row stride of 0 makes one row of bytes a tall picture.
    const std::vector<std::uint8_t> row(std::size_t{3} * 65535, 255);
    for (const Case& size : {Case{65535, 128, 128, 128},
                             Case{128, 65535, 128, 128},
                             Case{120, 65535, 1, 1},
                             Case{65535, 120, 1, 1}}) {
        const ImageView view{row.data(), size.width, size.height, 3, 0};
        ASSERT_TRUE(AreaSums::fits(view));
        const Sums white(std::size_t(size.columns) * size.rows * 3,
                         255U * unsigned(size.width) * unsigned(size.height));
        for_each_target([&](const char* target) {
            ASSERT_EQ(by_kernel(view, size.columns, size.rows), white)
                << target << ": " << size.width << " x " << size.height;
        });
    }
}

TEST(AreaSums, FitUpToTheLargest31BitSum) {
    const std::uint8_t pixel = 0;
    EXPECT_TRUE(AreaSums::fits({&pixel, 8421504, 1, 1, 0}));  // 255 * 8421504 < 2^31
    EXPECT_FALSE(AreaSums::fits({&pixel, 8421505, 1, 1, 0}));
}

TEST(AreaSums, ReadNothingBesideTheirColumns) {
    const Pixels wide = noise(90, 40, 3, 22);
    ImageView left = wide.view();
    left.width = 67;
    Pixels packed = flat(67, 40, {0, 0, 0});
    for (int y = 0; y < 40; ++y) {
        std::copy_n(wide.view().row(y), 67 * 3, packed.bytes.begin() + y * 67 * 3);
    }
    for_each_target([&](const char* target) {
        ASSERT_EQ(by_kernel(left, 31, 17), by_kernel(packed.view(), 31, 17)) << target;
    });
}

TEST(AreaSums, OfRowsFromBottomToTopAreThoseOfThePictureUpsideDown) {
    const Pixels picture = noise(50, 40, 3, 24);
    Pixels turned = picture;
    for (int y = 0; y < 40; ++y) {
        std::copy_n(picture.view().row(y), 150, turned.bytes.begin() + (39 - y) * 150);
    }
    ImageView upwards = picture.view();
    upwards.pixels = picture.view().row(39);
    upwards.row_stride = -upwards.row_stride;
    for_each_target([&](const char* target) {
        ASSERT_EQ(by_kernel(upwards, 20, 9), by_kernel(turned.view(), 20, 9)) << target;
    });
}

}  // namespace
}  // namespace haarmony::image
