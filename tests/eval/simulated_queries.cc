#include "tests/eval/simulated_queries.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

#include "tests/eval/affine.h"
#include "tests/eval/recolour.h"

namespace haarmony::eval {
namespace {

RgbPicture misregister(const RgbPicture& picture, double share, Random& random) {
    const double dx = random.between(-share, share) * picture.width;
    const double dy = random.between(-share, share) * picture.height;
    return translate(picture, dx, dy);
}

// To the right by dx, down by dy; what stood at the edge fills what is left free.
RgbPicture moved_by(const RgbPicture& picture, int dx, int dy) {
    RgbPicture result{picture.width, picture.height, {}};
    result.rgb.reserve(picture.rgb.size());
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const int from_x = std::clamp(x - dx, 0, picture.width - 1);
            const int from_y = std::clamp(y - dy, 0, picture.height - 1);
            const auto at =
                picture.rgb.begin() +
                (static_cast<std::ptrdiff_t>(from_y) * picture.width + from_x) * 3;
            result.rgb.insert(result.rgb.end(), at, at + 3);
        }
    }
    return result;
}

}  // namespace

QueryPicture opaque(RgbPicture picture) {
    return {picture.width, picture.height, 3, std::move(picture.rgb)};
}

RgbPicture simulate_scan(const RgbPicture& picture, Random& random) {
    const RgbPicture turned = rotate(picture, random.between(-1.5, 1.5));
    const RgbPicture moved = misregister(turned, 0.02, random);
    const double shrink = 48.0 / std::max({picture.width, picture.height, 48});
    const auto shrunk = [&](int side) {
        return std::max(1, static_cast<int>(std::lround(side * shrink)));
    };
    RgbPicture scan =
        tone(resize(moved, shrunk(picture.width), shrunk(picture.height)), 0.85, 1.3);
    for (std::uint8_t& value : scan.rgb) {
        const double noisy = value + random.bell() * 0.02 * 255;
        value = static_cast<std::uint8_t>(std::lround(std::clamp(noisy, 0.0, 255.0)));
    }
    return scan;
}

RgbPicture simulate_painting(const RgbPicture& picture, int grid, Random& random) {
    assert(grid >= 2);
    const RgbPicture vivid = saturate(resize(picture, grid, grid), 1.3);
    std::array<double, 3> bias{};
    for (double& channel : bias) channel = random.between(-0.06, 0.06);
    const RgbPicture squares = mosaic(posterize(shift_colours(vivid, bias), 5), grid);
    const auto off = [&] {
        return static_cast<int>(std::lround(random.between(-0.03, 0.03) * squares.width));
    };
    const int dx = off();
    const int dy = off();
    return moved_by(squares, dx, dy);
}

RgbPicture simulate_painting(const RgbPicture& picture, Random& random) {
    return simulate_painting(picture, 8 + random.below(9), random);
}

QueryPicture keep_half(const RgbPicture& painting, Random& random) {
    const int half = random.below(4);
    QueryPicture result{painting.width, painting.height, 4, {}};
    result.pixels.reserve(painting.rgb.size() / 3 * 4);
    for (int y = 0; y < painting.height; ++y) {
        for (int x = 0; x < painting.width; ++x) {
            const bool first =
                half < 2 ? x < painting.width / 2 : y < painting.height / 2;
            const bool painted = first == (half % 2 == 0);
            const std::size_t at = (static_cast<std::size_t>(y) * painting.width + x) * 3;
            for (std::size_t c = 0; c < 3; ++c) {
                result.pixels.push_back(painted ? painting.rgb[at + c] : 0);
            }
            result.pixels.push_back(painted ? 255 : 0);
        }
    }
    return result;
}

QueryPicture simulate_half_painting(const RgbPicture& picture, int grid, Random& random) {
    assert(grid % 2 == 0);
    return keep_half(simulate_painting(picture, grid, random), random);
}

std::string query_kind_name(QueryKind kind) {
    switch (kind) {
        case QueryKind::kScanned:
            return "scanned";
        case QueryKind::kPainted:
            return "painted";
        case QueryKind::kHalfPainted:
            break;
    }
    return "half painted";
}

QueryPicture simulate(QueryKind kind, const RgbPicture& picture, Random& random) {
    switch (kind) {
        case QueryKind::kScanned:
            return opaque(simulate_scan(picture, random));
        case QueryKind::kPainted:
            return opaque(simulate_painting(picture, random));
        case QueryKind::kHalfPainted:
            break;
    }
    return simulate_half_painting(picture, 8 + 2 * random.below(5), random);
}

}  // namespace haarmony::eval
