// A view of 8-bit pixels that somebody else owns.
//
// Shape   row-major, interleaved; `channels` is 1 (grey), 3 (RGB) or 4 (RGB and alpha);
//         rows start `row_stride` bytes apart.
// Units   sRGB bytes, 0..255; alpha is straight (not premultiplied), 255 = opaque.
// Errors  none; a wrong shape is a caller's bug and asserts where it is used.
#pragma once

#include <cstddef>
#include <cstdint>

namespace haarmony {

struct ImageView {
    const std::uint8_t* pixels = nullptr;
    int width = 0;
    int height = 0;
    int channels = 0;
    std::ptrdiff_t row_stride = 0;

    [[nodiscard]] const std::uint8_t* row(int y) const { return pixels + y * row_stride; }
};

}  // namespace haarmony
