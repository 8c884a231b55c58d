// Pixels drawn from a clip.
//
// Shape   row-major, without padding; straight RGBA.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/core/image_view.h"
#include "engine/video/pixel.h"

namespace haarmony::video {

// A rectangle of pixels of one picture.
struct PixelBox {
    std::int32_t x = 0;
    std::int32_t y = 0;
    std::int32_t width = 0;
    std::int32_t height = 0;

    friend bool operator==(const PixelBox&, const PixelBox&) = default;
};

struct Picture {
    std::int32_t width = 0;
    std::int32_t height = 0;
    std::vector<Rgba> pixels;

    Picture() = default;
    Picture(std::int32_t w, std::int32_t h)
        : width(w),
          height(h),
          pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}

    [[nodiscard]] Rgba& at(std::int32_t x, std::int32_t y) {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)];
    }
    [[nodiscard]] const Rgba& at(std::int32_t x, std::int32_t y) const {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)];
    }
    [[nodiscard]] ImageView view() const {
        static_assert(sizeof(Rgba) == 4);
        return {reinterpret_cast<const std::uint8_t*>(pixels.data()),
                width,
                height,
                4,
                std::ptrdiff_t{4} * width};
    }
    friend bool operator==(const Picture&, const Picture&) = default;
};

}  // namespace haarmony::video
