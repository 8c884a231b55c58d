// Pictures for the tests of the evaluation, from the gallery's painters.
#pragma once

#include "tests/eval/picture_source.h"

namespace haarmony::eval {

// Picture `number` of a small gallery, 64 pixels at its longest side.
[[nodiscard]] RgbPicture generated_picture(int number);

// The first `count` of them.
[[nodiscard]] PictureSource generated_pictures(int count);

// width x height pixels of a colour that changes from pixel to pixel.
[[nodiscard]] RgbPicture gradient(int width, int height);

[[nodiscard]] RgbPicture flat(int width, int height, int red, int green, int blue);

}  // namespace haarmony::eval
