// Pictures that tests make for themselves.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/image_view.h"

namespace haarmony::image {

struct Pixels {
    int width = 0;
    int height = 0;
    int channels = 0;
    std::vector<std::uint8_t> bytes;

    [[nodiscard]] ImageView view() const {
        return {bytes.data(), width, height, channels, std::ptrdiff_t{channels} * width};
    }
    [[nodiscard]] std::uint8_t& at(int x, int y, int channel) {
        return bytes[(std::size_t(y) * width + x) * channels + channel];
    }
    [[nodiscard]] std::uint8_t at(int x, int y, int channel) const {
        return bytes[(std::size_t(y) * width + x) * channels + channel];
    }
};

// Every sample drawn by itself.
[[nodiscard]] Pixels noise(int width, int height, int channels, unsigned seed);
// Every pixel the same; one value for each channel.
[[nodiscard]] Pixels flat(int width, int height, const std::vector<std::uint8_t>& color);
// Colour ramps and a few rectangles: coefficients of every size, as a photograph has.
[[nodiscard]] Pixels scene(int width, int height, unsigned seed);

}  // namespace haarmony::image
