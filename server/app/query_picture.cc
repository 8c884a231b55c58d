#include "server/app/query_picture.h"

#include <algorithm>
#include <utility>

#include "engine/image/aspect.h"
#include "engine/image/autocrop.h"
#include "engine/image/window.h"

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

void add_windows(const ImageView& pixels,
                 const LookOptions& options,
                 QueryPicture& picture) {
    for (const image::SignatureKind& kind : options.kinds) {
        std::vector<image::Signature>& windows = picture.signatures[kind];
        for (image::WindowSignature& window : image::window_signatures(pixels, kind))
            windows.push_back(std::move(window.signature));
    }
}

void add_whole(const ImageView& pixels,
               const LookOptions& options,
               QueryPicture& picture) {
    for (image::Signature& signature : image::make_signatures(pixels, options.kinds)) {
        const image::SignatureKind kind = signature.kind;
        picture.signatures[kind].push_back(std::move(signature));
    }
}

void add_moved(const ImageView& pixels,
               const LookOptions& options,
               QueryPicture& picture) {
    for (const image::SignatureKind& kind : options.kinds) {
        std::vector<image::Signature>& ways = picture.signatures[kind];
        for (image::Signature& moved : image::moved_signatures(pixels, kind))
            ways.push_back(std::move(moved));
    }
}

// `pixels_across` of `pixels_of` stand for how many of `length`, at least one.
int share_of(int length, int pixels_across, int pixels_of) {
    return static_cast<int>(std::max<std::int64_t>(
        1, (std::int64_t{length} * pixels_across + pixels_of / 2) / pixels_of));
}

QueryPicture look_at_masked(const ImageView& pixels,
                            int width,
                            int height,
                            const LookOptions& options) {
    ImageView seen = pixels;
    if (options.autocrop) {
        if (const auto box = image::content_box(pixels))
            seen = image::cropped(pixels, *box);
    }
    QueryPicture picture;
    picture.log_aspect = image::log_aspect(share_of(width, seen.width, pixels.width),
                                           share_of(height, seen.height, pixels.height));
    if (options.partial) {
        add_windows(seen, options, picture);
    } else {
        add_whole(seen, options, picture);
    }
    if (options.misregistered) add_moved(seen, options, picture);
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
