#include "tests/eval/video_clip_art.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "engine/video/generate/lattice_noise.h"

namespace haarmony::eval {
namespace {

constexpr int kOctaves = 6;
constexpr double kCoarsest = 4;  // lattice points across the picture
constexpr double kGrain = 3;     // grey levels to either side
constexpr std::array<double, 3> kObject = {230, 40, 30};

std::uint8_t level(double value) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
}

// Each octave half as strong as the one before, as in photos; and grain of its own for every
// pixel and channel.
video::Picture photo(std::int32_t side) {
    video::Picture picture(side, side);
    const video::LatticeNoise noise(11);
    for (std::int32_t y = 0; y < side; ++y) {
        for (std::int32_t x = 0; x < side; ++x) {
            std::array<double, 3> color{};
            double scale = kCoarsest / side;
            double strength = 70;
            for (int octave = 0; octave < kOctaves; ++octave) {
                for (std::size_t c = 0; c < color.size(); ++c) {
                    const double z = 0.4 * static_cast<double>(c) + 10.0 * octave;
                    color[c] += strength * noise(x * scale, y * scale, z);
                }
                scale *= 2;
                strength /= 2;
            }
            for (std::size_t c = 0; c < color.size(); ++c) {
                color[c] += 120 + kGrain * noise(x, y, 100.0 + static_cast<double>(c));
            }
            picture.at(x, y) = {level(color[0]), level(color[1]), level(color[2]), 255};
        }
    }
    return picture;
}

void draw_object(video::Picture& picture, double at_x, double at_y) {
    const double radius = picture.width / 32.0;
    for (std::int32_t y = 0; y < picture.height; ++y) {
        for (std::int32_t x = 0; x < picture.width; ++x) {
            const double distance = std::hypot(x + 0.5 - at_x, y + 0.5 - at_y);
            const double cover = std::clamp(radius + 0.5 - distance, 0.0, 1.0);
            if (cover == 0) continue;
            video::Rgba& pixel = picture.at(x, y);
            const auto mixed = [cover](std::uint8_t below, double color) {
                return level(below + (color - below) * cover);
            };
            pixel = {mixed(pixel.r, kObject[0]),
                     mixed(pixel.g, kObject[1]),
                     mixed(pixel.b, kObject[2]),
                     255};
        }
    }
}

}  // namespace

VideoClip make_clip_art(std::int32_t side, std::int64_t frames) {
    assert(side >= 16 && frames >= 1);
    VideoClip clip{"clip-art", VideoKind::kClipArt, {side, side, {25, 1}}, {}};
    const video::Picture background = photo(side);
    for (std::int64_t t = 0; t < frames; ++t) {
        const double way = (static_cast<double>(t) + 0.5) / static_cast<double>(frames);
        clip.frames.push_back(background);
        draw_object(clip.frames.back(),
                    side * (0.1 + 0.8 * way),
                    side * (0.5 + 0.2 * std::sin(2 * std::numbers::pi * way)));
    }
    return clip;
}

}  // namespace haarmony::eval
