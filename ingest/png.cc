#include "ingest/png.h"

#include <png.h>

#include <string>

#include "ingest/one_line.h"

namespace haarmony::ingest {
namespace {

// libpng's simplified interface: it keeps its jumps to itself and its messages off the
// standard error.
struct Image {
    Image() { fields.version = PNG_IMAGE_VERSION; }
    ~Image() { png_image_free(&fields); }
    Image(const Image&) = delete;
    Image& operator=(const Image&) = delete;

    png_image fields{};
};

Error damaged(const Image& image) {
    return {ErrorCode::kUndecodable, "damaged PNG: " + one_line(image.fields.message)};
}

}  // namespace

Result<Raster> decode_png(std::span<const std::uint8_t> bytes) {
    Image image;
    if (png_image_begin_read_from_memory(&image.fields, bytes.data(), bytes.size()) ==
        0) {
        return damaged(image);
    }
    const bool alpha = (image.fields.format & PNG_FORMAT_FLAG_ALPHA) != 0;
    const bool color = (image.fields.format & PNG_FORMAT_FLAG_COLOR) != 0;
    int channels = color ? 3 : 1;
    image.fields.format = color ? PNG_FORMAT_RGB : PNG_FORMAT_GRAY;
    if (alpha) {
        channels = 4;
        image.fields.format = PNG_FORMAT_RGBA;
    }
    // Sixteen bits without a word about gamma would otherwise count as linear.
    image.fields.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;

    Raster raster(static_cast<int>(image.fields.width),
                  static_cast<int>(image.fields.height),
                  channels);
    const png_int_32 stride = static_cast<png_int_32>(raster.row_bytes());
    if (png_image_finish_read(
            &image.fields, nullptr, raster.pixels.data(), stride, nullptr) == 0) {
        return damaged(image);
    }
    return raster;
}

}  // namespace haarmony::ingest
