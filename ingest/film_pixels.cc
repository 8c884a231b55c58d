#include "ingest/film_pixels.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace haarmony::ingest {
namespace {

constexpr int kBleedSteps = 2;

struct ColorSum {
    int r = 0;
    int g = 0;
    int b = 0;
    int count = 0;
};

// One step: pixels not yet `colored` next to some that are.
void bleed_once(video::Picture& picture, std::vector<std::uint8_t>& colored) {
    const std::vector<std::uint8_t> before = colored;
    const auto index = [&picture](std::int32_t x, std::int32_t y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
               static_cast<std::size_t>(x);
    };
    for (std::int32_t y = 0; y < picture.height; ++y) {
        for (std::int32_t x = 0; x < picture.width; ++x) {
            if (before[index(x, y)] != 0) continue;
            ColorSum sum;
            for (std::int32_t v = std::max(y - 1, 0);
                 v <= std::min(y + 1, picture.height - 1);
                 ++v) {
                for (std::int32_t u = std::max(x - 1, 0);
                     u <= std::min(x + 1, picture.width - 1);
                     ++u) {
                    if (before[index(u, v)] == 0) continue;
                    const video::Rgba& near = picture.at(u, v);
                    sum = {sum.r + near.r, sum.g + near.g, sum.b + near.b, sum.count + 1};
                }
            }
            if (sum.count == 0) continue;
            const auto mean = [&sum](int total) {
                return static_cast<std::uint8_t>((total + sum.count / 2) / sum.count);
            };
            picture.at(x, y) = {mean(sum.r), mean(sum.g), mean(sum.b), 0};
            colored[index(x, y)] = 1;
        }
    }
}

}  // namespace

void lay_over(video::Picture& picture, video::Rgba background) {
    for (video::Rgba& pixel : picture.pixels) {
        const auto over = [alpha = pixel.a](std::uint8_t above, std::uint8_t below) {
            return static_cast<std::uint8_t>(
                (above * alpha + below * (255 - alpha) + 127) / 255);
        };
        pixel = {over(pixel.r, background.r),
                 over(pixel.g, background.g),
                 over(pixel.b, background.b),
                 255};
    }
}

void bleed_into_clear(video::Picture& picture) {
    std::vector<std::uint8_t> colored(picture.pixels.size());
    std::size_t painted = 0;
    for (std::size_t i = 0; i < colored.size(); ++i) {
        colored[i] = picture.pixels[i].a != 0 ? 1 : 0;
        painted += colored[i];
    }
    if (painted == 0 || painted == colored.size()) return;
    for (int step = 0; step < kBleedSteps; ++step) bleed_once(picture, colored);
}

}  // namespace haarmony::ingest
