#include "server/app/query_picture.h"

#include <utility>

#include "engine/image/aspect.h"

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

QueryPicture look_at_masked(const ImageView& pixels,
                            int width,
                            int height,
                            const LookOptions& options) {
    QueryPicture picture;
    picture.log_aspect = image::log_aspect(width, height);
    for (image::Signature& signature : image::make_signatures(pixels, options.kinds)) {
        const image::SignatureKind kind = signature.kind;
        picture.signatures.emplace(kind, std::move(signature));
    }
    return picture;
}

}  // namespace

QueryPicture look_at(const ImageView& pixels,
                     int width,
                     int height,
                     const LookOptions& options) {
    if (options.mask == Mask::kAlpha || pixels.channels != 4)
        return look_at_masked(pixels, width, height, options);
    const std::vector<std::uint8_t> opaque = over_black(pixels);
    return look_at_masked(
        {opaque.data(), pixels.width, pixels.height, 3, std::ptrdiff_t{3} * pixels.width},
        width,
        height,
        options);
}

}  // namespace haarmony::server
