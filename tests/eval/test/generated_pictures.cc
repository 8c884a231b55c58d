#include "tests/eval/test/generated_pictures.h"

#include <cstdint>
#include <string>

#include "ingest/gallery/gallery.h"

namespace haarmony::eval {

RgbPicture generated_picture(int number) {
    gallery::Painting painting = gallery::paint(11, number, 64);
    return {painting.width, painting.height, std::move(painting.rgb)};
}

PictureSource generated_pictures(int count) {
    PictureSource source;
    for (int i = 0; i < count; ++i) source.names.push_back(std::to_string(i));
    source.load = [](std::size_t i) -> Result<RgbPicture> {
        return generated_picture(static_cast<int>(i));
    };
    return source;
}

RgbPicture gradient(int width, int height) {
    RgbPicture picture{width, height, {}};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            picture.rgb.push_back(static_cast<std::uint8_t>(x * 255 / width));
            picture.rgb.push_back(static_cast<std::uint8_t>(y * 255 / height));
            picture.rgb.push_back(static_cast<std::uint8_t>((x * 7 + y * 13) % 256));
        }
    }
    return picture;
}

RgbPicture flat(int width, int height, int red, int green, int blue) {
    RgbPicture picture{width, height, {}};
    for (int i = 0; i < width * height; ++i) {
        for (const int value : {red, green, blue})
            picture.rgb.push_back(static_cast<std::uint8_t>(value));
    }
    return picture;
}

}  // namespace haarmony::eval
