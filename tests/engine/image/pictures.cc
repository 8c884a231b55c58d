#include "tests/engine/image/pictures.h"

#include <algorithm>
#include <random>

namespace haarmony::image {

Pixels noise(int width, int height, int channels, unsigned seed) {
    Pixels picture{width, height, channels, {}};
    std::mt19937 random(seed);
    picture.bytes.resize(std::size_t(width) * height * channels);
    for (std::uint8_t& byte : picture.bytes)
        byte = static_cast<std::uint8_t>(random() >> 7);
    return picture;
}

Pixels flat(int width, int height, const std::vector<std::uint8_t>& color) {
    Pixels picture{width, height, static_cast<int>(color.size()), {}};
    for (int i = 0; i < width * height; ++i) {
        picture.bytes.insert(picture.bytes.end(), color.begin(), color.end());
    }
    return picture;
}

Pixels scene(int width, int height, unsigned seed) {
    Pixels picture = flat(width, height, {0, 0, 0});
    std::mt19937 random(seed);
    const int slope = 1 + static_cast<int>(random() % 5);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            picture.at(x, y, 0) = static_cast<std::uint8_t>(255 * x / width);
            picture.at(x, y, 1) = static_cast<std::uint8_t>(255 * y / height);
            picture.at(x, y, 2) = static_cast<std::uint8_t>(
                (slope * (x + y) * 64 / (width + height)) % 256);
        }
    }
    for (int i = 0; i < 12; ++i) {
        const int left = static_cast<int>(random() % width);
        const int top = static_cast<int>(random() % height);
        const int right =
            std::min(width, left + 1 + static_cast<int>(random() % width) / 2);
        const int bottom =
            std::min(height, top + 1 + static_cast<int>(random() % height) / 2);
        for (int c = 0; c < 3; ++c) {
            const auto value = static_cast<std::uint8_t>(random() >> 9);
            for (int y = top; y < bottom; ++y) {
                for (int x = left; x < right; ++x) picture.at(x, y, c) = value;
            }
        }
    }
    return picture;
}

}  // namespace haarmony::image
