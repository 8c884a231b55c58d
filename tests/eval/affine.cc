#include "tests/eval/affine.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace haarmony::eval {
namespace {

// From a place in the result, relative to its centre, to a place in the picture.
struct InverseMap {
    double xx = 1, xy = 0, yx = 0, yy = 1;
    double dx = 0, dy = 0;
};

// Of a value in [0, 255], which rounds to the nearest byte.
std::uint8_t to_byte(double value) { return static_cast<std::uint8_t>(value + 0.5); }

RgbPicture warp(const RgbPicture& picture, const InverseMap& map) {
    const std::array<double, 3> outside = average_colour(picture);
    const double centre_x = picture.width / 2.0;
    const double centre_y = picture.height / 2.0;
    RgbPicture result{picture.width, picture.height, {}};
    result.rgb.reserve(picture.rgb.size());
    const auto sample = [&](int x, int y, std::size_t c) {
        if (x < 0 || y < 0 || x >= picture.width || y >= picture.height)
            return outside[c];
        return static_cast<double>(
            picture.rgb[(static_cast<std::size_t>(y) * picture.width + x) * 3 + c]);
    };
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const double u = x + 0.5 - centre_x;
            const double v = y + 0.5 - centre_y;
            const double from_x = map.xx * u + map.xy * v + map.dx + centre_x - 0.5;
            const double from_y = map.yx * u + map.yy * v + map.dy + centre_y - 0.5;
            const int left = static_cast<int>(std::floor(from_x));
            const int top = static_cast<int>(std::floor(from_y));
            const double right_share = from_x - left;
            const double lower_share = from_y - top;
            if (left < -1 || top < -1 || left >= picture.width || top >= picture.height) {
                for (const double channel : outside)
                    result.rgb.push_back(to_byte(channel));
                continue;
            }
            for (std::size_t c = 0; c < 3; ++c) {
                const double upper = sample(left, top, c) * (1 - right_share) +
                                     sample(left + 1, top, c) * right_share;
                const double lower = sample(left, top + 1, c) * (1 - right_share) +
                                     sample(left + 1, top + 1, c) * right_share;
                result.rgb.push_back(
                    to_byte(upper * (1 - lower_share) + lower * lower_share));
            }
        }
    }
    return result;
}

}  // namespace

std::array<double, 3> average_colour(const RgbPicture& picture) {
    std::array<double, 3> sum{};
    for (std::size_t at = 0; at < picture.rgb.size(); ++at)
        sum[at % 3] += picture.rgb[at];
    for (double& channel : sum) channel /= static_cast<double>(picture.rgb.size()) / 3;
    return sum;
}

RgbPicture enlarge(const RgbPicture& picture, double factor) {
    assert(factor >= 1);
    return warp(picture, {1 / factor, 0, 0, 1 / factor, 0, 0});
}

RgbPicture rotate(const RgbPicture& picture, double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    // y points down: what is seen as counter-clockwise has this inverse.
    return warp(
        picture,
        {std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle), 0, 0});
}

RgbPicture translate(const RgbPicture& picture, double dx, double dy) {
    return warp(picture, {1, 0, 0, 1, -dx, -dy});
}

}  // namespace haarmony::eval
