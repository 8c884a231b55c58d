// The picture within its borders: letterbox bars, frames, page margins (image search, before
// step 0 of 5):
//   [autocrop.h] -> resample.h
//
// Units   pixels of the view.
// Errors  none at run time; a wrong shape is a caller's bug and asserts.
#pragma once

#include <optional>

#include "engine/core/image_view.h"

namespace haarmony::image {

struct CropBox {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;

    friend bool operator==(const CropBox&, const CropBox&) = default;
};

// What is within the borders; nothing where there are none. A border is lines of one colour
// (what is transparent is of one colour), each side by itself, as noisy as JPEG leaves them,
// that end in an edge and take up at most 45 % of the side's direction. A flat picture has no
// edge, nor has a sky that changes slowly.
// Requires: width, height >= 1; 1, 3 or 4 channels. Cost: one pass over the borders.
[[nodiscard]] std::optional<CropBox> content_box(const ImageView& picture);

// The same pixels, seen through the box. Requires: the box lies in the picture.
[[nodiscard]] ImageView cropped(const ImageView& picture, const CropBox& box);

}  // namespace haarmony::image
