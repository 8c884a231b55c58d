#include "ingest/shrink.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/ingest/samples.h"

namespace haarmony::ingest {
namespace {

ImageView view_of(const Raster& raster) {
    return {raster.pixels.data(),
            raster.width,
            raster.height,
            raster.channels,
            static_cast<std::ptrdiff_t>(raster.row_bytes())};
}

Raster noise(int width, int height, int channels) {
    std::mt19937 random(static_cast<unsigned>(width * 1000 + height * 10 + channels));
    Raster raster(width, height, channels);
    for (std::uint8_t& sample : raster.pixels)
        sample = static_cast<std::uint8_t>(random());
    return raster;
}

// The definition: the integral over the covered rectangle, pixel by pixel, in doubles.
double integral(const Raster& picture, int x, int y, int c, int width, int height) {
    const double left = double(x) * picture.width / width;
    const double right = double(x + 1) * picture.width / width;
    const double top = double(y) * picture.height / height;
    const double bottom = double(y + 1) * picture.height / height;
    double sum = 0;
    for (int v = 0; v < picture.height; ++v) {
        const double tall = std::min<double>(bottom, v + 1) - std::max<double>(top, v);
        if (tall <= 0) continue;
        for (int u = 0; u < picture.width; ++u) {
            const double wide =
                std::min<double>(right, u + 1) - std::max<double>(left, u);
            if (wide <= 0) continue;
            const std::uint8_t* pixel = picture.row(v) + u * picture.channels;
            double value = pixel[c];
            if (picture.channels == 4) {
                value = value * pixel[3] / 255.0 + (255 - pixel[3]);
            }
            sum += tall * wide * value;
        }
    }
    return sum / ((right - left) * (bottom - top));
}

TEST(Shrink, IsTheIntegralOverWhatAPixelCovers) {
    struct Case {
        int from_width, from_height, to_width, to_height;
    };
    for (const Case& size : {Case{37, 23, 10, 7},
                             Case{37, 23, 36, 22},
                             Case{64, 64, 16, 16},
                             Case{5, 3, 5, 3},
                             Case{9, 1, 4, 1},
                             Case{1, 9, 1, 1},
                             Case{100, 40, 1, 1},
                             Case{400, 5, 300, 3}}) {
        for (const int channels : {1, 3, 4}) {
            const Raster picture = noise(size.from_width, size.from_height, channels);
            const Raster small = shrink(view_of(picture), size.to_width, size.to_height);
            ASSERT_EQ(small.channels, channels == 1 ? 1 : 3);
            for (int y = 0; y < small.height; ++y) {
                for (int x = 0; x < small.width; ++x) {
                    for (int c = 0; c < small.channels; ++c) {
                        const double exact =
                            integral(picture, x, y, c, size.to_width, size.to_height);
                        // Half a step for rounding, a hundredth for single precision.
                        EXPECT_NEAR(small.row(y)[x * small.channels + c], exact, 0.51);
                    }
                }
            }
        }
    }
}

TEST(Shrink, FlatPicturesStayFlat) {
    for (const int value : {0, 1, 127, 254, 255}) {
        const std::uint8_t level = static_cast<std::uint8_t>(value);
        const Raster picture = flat_picture(301, 211, {level, level, level});
        const Raster small = shrink(view_of(picture), 77, 53);
        EXPECT_EQ(largest_difference(small, flat_picture(77, 53, {level, level, level})),
                  0);
    }
}

TEST(Shrink, RowsMayBeFartherApartThanTheyAreWide) {
    const Raster wide = noise(20, 6, 3);
    ImageView left = view_of(wide);
    left.width = 8;
    Raster packed(8, 6, 3);
    for (int y = 0; y < 6; ++y) std::copy_n(wide.row(y), 24, packed.row(y));
    EXPECT_EQ(largest_difference(shrink(left, 3, 2), shrink(view_of(packed), 3, 2)), 0);
}

}  // namespace
}  // namespace haarmony::ingest
