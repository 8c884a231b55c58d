#include "tests/golden/scenes.h"

#include <array>
#include <cstdint>
#include <utility>

namespace haarmony::golden {
namespace {

using Color = std::array<int, 3>;

// SplitMix64: the same numbers everywhere.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    int below(int bound) {
        state_ += 0x9e3779b97f4a7c15U;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
        return static_cast<int>((z ^ (z >> 31)) % static_cast<std::uint64_t>(bound));
    }
    Color color() { return {below(256), below(256), below(256)}; }

  private:
    std::uint64_t state_;
};

void set(eval::RgbPicture& picture, int x, int y, const Color& color) {
    const std::size_t at = (static_cast<std::size_t>(y) * picture.width + x) * 3;
    for (std::size_t c = 0; c < 3; ++c) {
        picture.rgb[at + c] = static_cast<std::uint8_t>(color[c]);
    }
}

void gradient(eval::RgbPicture& picture, const Color& top, const Color& bottom) {
    for (int y = 0; y < picture.height; ++y) {
        Color color;
        for (std::size_t c = 0; c < 3; ++c) {
            color[c] = (top[c] * (picture.height - 1 - y) + bottom[c] * y) /
                       (picture.height - 1);
        }
        for (int x = 0; x < picture.width; ++x) set(picture, x, y, color);
    }
}

void shape(eval::RgbPicture& picture, Random& random) {
    const Color color = random.color();
    const bool disc = random.below(2) == 1;
    const int center_x = random.below(picture.width);
    const int center_y = random.below(picture.height);
    const int half_width = 4 + random.below(24);
    const int half_height = 4 + random.below(24);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const int dx = x - center_x;
            const int dy = y - center_y;
            const bool inside = disc ? dx * dx + dy * dy <= half_width * half_width
                                     : dx * dx <= half_width * half_width &&
                                           dy * dy <= half_height * half_height;
            if (inside) set(picture, x, y, color);
        }
    }
}

}  // namespace

eval::RgbPicture scene(int number) {
    Random random(static_cast<std::uint64_t>(number) * 1000003U + 17U);
    eval::RgbPicture picture{96, 64, {}};
    if (random.below(2) == 1) std::swap(picture.width, picture.height);
    picture.rgb.resize(static_cast<std::size_t>(picture.width) * picture.height * 3);
    const Color top = random.color();
    const Color bottom = random.color();
    gradient(picture, top, bottom);
    const int shapes = 2 + random.below(7);
    for (int i = 0; i < shapes; ++i) shape(picture, random);
    return picture;
}

}  // namespace haarmony::golden
