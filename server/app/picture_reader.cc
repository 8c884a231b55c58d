#include "server/app/picture_reader.h"

#include <memory>
#include <utility>
#include <vector>

#include "ingest/describe.h"

namespace haarmony::server {
namespace {

std::vector<std::uint8_t> over_black(const ImageView& picture) {
    std::vector<std::uint8_t> pixels;
    pixels.reserve(static_cast<std::size_t>(picture.width) * picture.height * 3);
    for (int y = 0; y < picture.height; ++y) {
        const std::uint8_t* pixel = picture.row(y);
        for (int x = 0; x < picture.width; ++x, pixel += 4)
            for (int channel = 0; channel < 3; ++channel)
                pixels.push_back(
                    static_cast<std::uint8_t>((pixel[channel] * pixel[3] + 127) / 255));
    }
    return pixels;
}

}  // namespace

PictureReader::PictureReader(const ingest::DecodeLimits& limits)
    : decoders_([limits]() -> Result<std::unique_ptr<ingest::Decoder>> {
          return std::make_unique<ingest::Decoder>(limits);
      }) {}

Result<image::Signature> PictureReader::signature(std::span<const std::uint8_t> bytes,
                                                  Mask mask) {
    const auto decoder = decoders_.lend();
    if (!decoder) return decoder.error();
    if (mask == Mask::kAlpha) return ingest::describe_query(**decoder, bytes);
    const Result<ingest::Picture> picture = (*decoder)->decode(bytes);
    if (!picture) return picture.error();
    return signature_of_pixels(picture->view(), mask);
}

Result<schema::NewImage> PictureReader::describe(std::span<const std::uint8_t> bytes) {
    const auto decoder = decoders_.lend();
    if (!decoder) return decoder.error();
    return ingest::describe(**decoder, bytes);
}

image::Signature signature_of_pixels(const ImageView& picture, Mask mask) {
    if (mask == Mask::kAlpha || picture.channels != 4)
        return image::make_signature(picture);
    const std::vector<std::uint8_t> opaque = over_black(picture);
    return image::make_signature({opaque.data(),
                                  picture.width,
                                  picture.height,
                                  3,
                                  std::ptrdiff_t{3} * picture.width});
}

}  // namespace haarmony::server
