// Poor copies and coarse paintings of pictures, to query with (section 4.5: scanned and
// painted queries, simulated).
//
// Shape   RGB bytes, row-major, tightly packed.
// Source  sec. 4.5; PEERS' protocols: thumbnail, gamma, blur; 8 x 8 mosaic, few colours.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/image_view.h"

namespace haarmony::eval {

struct RgbPicture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;

    [[nodiscard]] ImageView view() const {
        return {rgb.data(), width, height, 3, static_cast<std::ptrdiff_t>(width) * 3};
    }
};

// Any 1-, 3- or 4-channel view as RGB; alpha over white.
[[nodiscard]] RgbPicture to_rgb(const ImageView& picture);

// Area average to exactly width x height. Requires: both >= 1.
[[nodiscard]] RgbPicture resize(const RgbPicture& picture, int width, int height);

// Each byte times `factor`, 0..1.
[[nodiscard]] RgbPicture darken(const RgbPicture& picture, double factor);

// Box blur, (2 * radius + 1) pixels square, edges repeated.
[[nodiscard]] RgbPicture blur(const RgbPicture& picture, int radius);

// A scan: longest side 48 pixels, blurred by one pixel, 0.8 times as bright.
[[nodiscard]] RgbPicture poor_copy(const RgbPicture& picture);

// A painting from flat squares: `grid` x `grid` mean colours.
[[nodiscard]] RgbPicture mosaic(const RgbPicture& picture, int grid);

// The mosaic as a hurried hand would paint it: more saturated, five levels a channel.
[[nodiscard]] RgbPicture painted_mosaic(const RgbPicture& picture, int grid);

}  // namespace haarmony::eval
