#include "tests/eval/recolour.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace haarmony::eval {
namespace {

using Colour = std::array<double, 3>;  // in [0, 1]

template <typename Change>
RgbPicture each_colour(const RgbPicture& picture, const Change& change) {
    RgbPicture result = picture;
    for (std::size_t at = 0; at + 2 < result.rgb.size(); at += 3) {
        Colour colour{};
        for (std::size_t c = 0; c < 3; ++c) colour[c] = result.rgb[at + c] / 255.0;
        change(colour);
        for (std::size_t c = 0; c < 3; ++c) {
            result.rgb[at + c] = static_cast<std::uint8_t>(
                std::lround(std::clamp(colour[c], 0.0, 1.0) * 255));
        }
    }
    return result;
}

}  // namespace

RgbPicture shift_colours(const RgbPicture& picture, const std::array<double, 3>& step) {
    return each_colour(picture, [&](Colour& colour) {
        for (std::size_t c = 0; c < 3; ++c) colour[c] += step[c];
    });
}

RgbPicture tone(const RgbPicture& picture, double factor, double gamma) {
    return each_colour(picture, [&](Colour& colour) {
        for (double& value : colour) value = factor * std::pow(value, gamma);
    });
}

RgbPicture saturate(const RgbPicture& picture, double factor) {
    return each_colour(picture, [&](Colour& colour) {
        const double grey = (colour[0] + colour[1] + colour[2]) / 3;
        for (double& value : colour) value = grey + factor * (value - grey);
    });
}

RgbPicture posterize(const RgbPicture& picture, int levels) {
    assert(levels >= 2);
    const double steps = levels - 1;
    return each_colour(picture, [&](Colour& colour) {
        for (double& value : colour) value = std::round(value * steps) / steps;
    });
}

RgbPicture to_grey(const RgbPicture& picture) {
    return each_colour(picture, [](Colour& colour) {
        colour.fill(0.299 * colour[0] + 0.587 * colour[1] + 0.114 * colour[2]);
    });
}

}  // namespace haarmony::eval
