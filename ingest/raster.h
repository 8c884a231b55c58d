// What a decoder makes of a picture, before it is turned upright.
//
// Shape   row-major, tightly packed; 1, 3 or 4 channels.
// Units   sRGB bytes, straight alpha.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace haarmony::ingest {

struct Raster {
    std::vector<std::uint8_t> pixels;
    int width = 0;
    int height = 0;
    int channels = 0;

    Raster() = default;
    Raster(int columns, int rows, int depth)
        : pixels(static_cast<std::size_t>(columns) * rows * depth),
          width(columns),
          height(rows),
          channels(depth) {}

    [[nodiscard]] std::size_t row_bytes() const {
        return static_cast<std::size_t>(width) * channels;
    }
    [[nodiscard]] std::uint8_t* row(int y) {
        return pixels.data() + static_cast<std::size_t>(y) * row_bytes();
    }
    [[nodiscard]] const std::uint8_t* row(int y) const {
        return pixels.data() + static_cast<std::size_t>(y) * row_bytes();
    }
};

}  // namespace haarmony::ingest
