#include "tests/eval/distortions.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "ingest/jpeg.h"
#include "ingest/thumbnail.h"
#include "tests/eval/affine.h"
#include "tests/eval/recolour.h"

namespace haarmony::eval {
namespace {

// A picture of width x height whose pixel (x, y) is that of `from(x, y)`.
template <typename From>
RgbPicture rearrange(const RgbPicture& picture, int width, int height, const From& from) {
    RgbPicture result{width, height, {}};
    result.rgb.reserve(static_cast<std::size_t>(width) * height * 3);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const auto [from_x, from_y] = from(x, y);
            const auto at =
                picture.rgb.begin() +
                (static_cast<std::ptrdiff_t>(from_y) * picture.width + from_x) * 3;
            result.rgb.insert(result.rgb.end(), at, at + 3);
        }
    }
    return result;
}

int share_of(int side, double share) {
    return static_cast<int>(std::lround(side * share));
}

void fill(RgbPicture& picture, int x0, int y0, int x1, int y1, std::uint8_t grey) {
    for (int y = y0; y < std::min(y1, picture.height); ++y) {
        for (int x = x0; x < std::min(x1, picture.width); ++x) {
            const std::size_t at = (static_cast<std::size_t>(y) * picture.width + x) * 3;
            std::fill_n(picture.rgb.begin() + static_cast<std::ptrdiff_t>(at), 3, grey);
        }
    }
}

RgbPicture thumbnail(const RgbPicture& picture, int longest_side) {
    const double shrink = static_cast<double>(longest_side) /
                          std::max({picture.width, picture.height, longest_side});
    return resize(picture,
                  std::max(1, share_of(picture.width, shrink)),
                  std::max(1, share_of(picture.height, shrink)));
}

// A row whose result is opaque and may use random numbers or not.
template <typename Apply>
Distortion row(std::string name, Apply apply) {
    return {std::move(name), [apply](const RgbPicture& picture, Random& random) {
                if constexpr (std::is_invocable_v<Apply, const RgbPicture&, Random&>) {
                    return opaque(apply(picture, random));
                } else {
                    return opaque(apply(picture));
                }
            }};
}

std::vector<Distortion> make_distortions() {
    using P = const RgbPicture&;
    using R = Random&;
    return {
        row("identity", [](P p) { return p; }),
        row("JPEG quality 10", [](P p) { return compress(p, 10); }),
        row("thumbnail 32 px", [](P p) { return thumbnail(p, 32); }),
        row("scan simulation", [](P p, R r) { return simulate_scan(p, r); }),
        row("brightness x 1.3", [](P p) { return tone(p, 1.3, 1); }),
        row("colour shift 0.2", [](P p, R r) { return random_colour_shift(p, 0.2, r); }),
        row("grey", [](P p) { return to_grey(p); }),
        row("crop 5 % a side", [](P p) { return crop(p, 0.05); }),
        row("crop 10 % a side", [](P p) { return crop(p, 0.10); }),
        row("crop 20 % a side", [](P p) { return crop(p, 0.20); }),
        row("rotation 2 degrees", [](P p, R r) { return rotate(p, 2 * r.sign()); }),
        row("rotation 5 degrees", [](P p, R r) { return rotate(p, 5 * r.sign()); }),
        row("rotation 10 degrees", [](P p, R r) { return rotate(p, 10 * r.sign()); }),
        row("translation 5 %", [](P p, R r) { return random_translation(p, 0.05, r); }),
        row("translation 10 %", [](P p, R r) { return random_translation(p, 0.10, r); }),
        row("mirror", [](P p) { return mirror(p); }),
        row("quarter turn", [](P p) { return turn(p); }),
        row("white border 10 %", [](P p) { return frame(p, 0.1, 0.1, 255); }),
        row("letterbox", [](P p) { return frame(p, 0, 0.1, 0); }),
        row("caption bar 15 %", [](P p, R r) { return caption(p, 0.15, r); }),
        row("mosaic 8 x 8", [](P p, R) { return mosaic(p, 8); }),
        {"half mosaic 8 x 8", [](P p, R r) { return keep_half(mosaic(p, 8), r); }},
        row("half mosaic 8 x 8 (rest mean)",
            [](P p, R r) { return fill_with_mean(keep_half(mosaic(p, 8), r)); }),
        row("painted 8 x 8", [](P p, R r) { return simulate_painting(p, 8, r); }),
        row("painted 12 x 12", [](P p, R r) { return simulate_painting(p, 12, r); }),
        {"half painted 8 x 8", [](P p, R r) { return simulate_half_painting(p, 8, r); }},
        row("half painted 8 x 8 (rest mean)",
            [](P p, R r) { return fill_with_mean(simulate_half_painting(p, 8, r)); }),
    };
}

}  // namespace

RgbPicture crop(const RgbPicture& picture, double share) {
    assert(share >= 0 && share < 0.5);
    const int left = share_of(picture.width, share);
    const int top = share_of(picture.height, share);
    return rearrange(picture,
                     std::max(1, picture.width - 2 * left),
                     std::max(1, picture.height - 2 * top),
                     [&](int x, int y) { return std::pair(x + left, y + top); });
}

RgbPicture frame(const RgbPicture& picture,
                 double across,
                 double along,
                 std::uint8_t grey) {
    const int left = share_of(picture.width, across);
    const int top = share_of(picture.height, along);
    RgbPicture result = rearrange(
        picture, picture.width + 2 * left, picture.height + 2 * top, [&](int x, int y) {
            return std::pair(std::clamp(x - left, 0, picture.width - 1),
                             std::clamp(y - top, 0, picture.height - 1));
        });
    fill(result, 0, 0, result.width, top, grey);
    fill(result, 0, top + picture.height, result.width, result.height, grey);
    fill(result, 0, 0, left, result.height, grey);
    fill(result, left + picture.width, 0, result.width, result.height, grey);
    return result;
}

RgbPicture caption(const RgbPicture& picture, double share, Random& random) {
    RgbPicture result = picture;
    const int height = share_of(picture.height, share);
    const int top = picture.height - height;
    fill(result, 0, top, picture.width, picture.height, 255);
    // One line of words of two to eight letters, each a third of the bar wide.
    const int letter = std::max(1, height / 3);
    for (int x = letter; x < picture.width - letter;) {
        const int end =
            std::min(x + letter * (2 + random.below(7)), picture.width - letter);
        fill(result, x, top + height / 3, end, top + height - height / 3, 32);
        x = end + letter;
    }
    return result;
}

RgbPicture mirror(const RgbPicture& picture) {
    return rearrange(picture, picture.width, picture.height, [&](int x, int y) {
        return std::pair(picture.width - 1 - x, y);
    });
}

RgbPicture turn(const RgbPicture& picture) {
    return rearrange(picture, picture.height, picture.width, [&](int x, int y) {
        return std::pair(y, picture.height - 1 - x);
    });
}

RgbPicture compress(const RgbPicture& picture, int quality) {
    const auto bytes = ingest::encode_jpeg(picture.view(), quality);
    assert(bytes);
    const auto raster =
        ingest::decode_jpeg(*bytes, std::max(picture.width, picture.height));
    assert(raster);
    return to_rgb({raster->pixels.data(),
                   raster->width,
                   raster->height,
                   raster->channels,
                   static_cast<std::ptrdiff_t>(raster->row_bytes())});
}

RgbPicture fill_with_mean(const QueryPicture& picture) {
    assert(picture.channels == 4);
    std::array<double, 4> sum{};
    for (std::size_t at = 0; at < picture.pixels.size(); at += 4) {
        const double alpha = picture.pixels[at + 3];
        for (std::size_t c = 0; c < 3; ++c) sum[c] += alpha * picture.pixels[at + c];
        sum[3] += alpha;
    }
    RgbPicture result{picture.width, picture.height, {}};
    result.rgb.reserve(picture.pixels.size() / 4 * 3);
    for (std::size_t at = 0; at < picture.pixels.size(); at += 4) {
        const double alpha = picture.pixels[at + 3] / 255.0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double mean = sum[3] > 0 ? sum[c] / sum[3] : 0;
            result.rgb.push_back(static_cast<std::uint8_t>(
                std::lround(alpha * picture.pixels[at + c] + (1 - alpha) * mean)));
        }
    }
    return result;
}

RgbPicture random_colour_shift(const RgbPicture& picture,
                               double distance,
                               Random& random) {
    // A bell in each coordinate has no preferred direction.
    std::array<double, 3> step{random.bell(), random.bell(), random.bell()};
    const double length = std::hypot(step[0], step[1], step[2]);
    for (double& part : step) part *= distance / length;
    return shift_colours(picture, step);
}

RgbPicture random_translation(const RgbPicture& picture,
                              double distance,
                              Random& random) {
    const double angle = random.between(0, 2 * std::numbers::pi);
    const double length = distance * picture.width;
    return translate(picture, length * std::cos(angle), length * std::sin(angle));
}

const std::vector<Distortion>& distortions() {
    static const std::vector<Distortion> table = make_distortions();
    return table;
}

const Distortion& distortion(const std::string& name) {
    const auto found = std::ranges::find(distortions(), name, &Distortion::name);
    assert(found != distortions().end());
    return *found;
}

}  // namespace haarmony::eval
