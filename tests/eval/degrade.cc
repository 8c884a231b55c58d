#include "tests/eval/degrade.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace haarmony::eval {
namespace {

std::uint8_t to_byte(double value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

// The share of each source cell in one target cell along one axis.
struct Span {
    int first = 0;
    std::vector<double> shares;
};

Span span_of(int target, int target_size, int source_size) {
    const double scale = static_cast<double>(source_size) / target_size;
    const double from = target * scale;
    const double to = (target + 1) * scale;
    Span span{static_cast<int>(from), {}};
    for (int i = span.first; i < source_size && i < to; ++i) {
        const double share = std::min<double>(to, i + 1) - std::max<double>(from, i);
        if (share > 0) span.shares.push_back(share / scale);
    }
    return span;
}

}  // namespace

RgbPicture to_rgb(const ImageView& picture) {
    RgbPicture result{picture.width, picture.height, {}};
    result.rgb.reserve(static_cast<std::size_t>(picture.width) * picture.height * 3);
    for (int y = 0; y < picture.height; ++y) {
        const std::uint8_t* pixel = picture.row(y);
        for (int x = 0; x < picture.width; ++x, pixel += picture.channels) {
            for (int c = 0; c < 3; ++c) {
                const int value = pixel[picture.channels == 1 ? 0 : c];
                const int alpha = picture.channels == 4 ? pixel[3] : 255;
                result.rgb.push_back(
                    to_byte((value * alpha + 255 * (255 - alpha)) / 255.0));
            }
        }
    }
    return result;
}

RgbPicture resize(const RgbPicture& picture, int width, int height) {
    assert(width >= 1 && height >= 1);
    RgbPicture result{width, height, {}};
    result.rgb.reserve(static_cast<std::size_t>(width) * height * 3);
    std::vector<Span> spans_across;
    for (int x = 0; x < width; ++x)
        spans_across.push_back(span_of(x, width, picture.width));
    for (int y = 0; y < height; ++y) {
        const Span rows = span_of(y, height, picture.height);
        for (const Span& columns : spans_across) {
            double sum[3] = {0, 0, 0};
            for (std::size_t j = 0; j < rows.shares.size(); ++j) {
                for (std::size_t i = 0; i < columns.shares.size(); ++i) {
                    const std::size_t at =
                        ((rows.first + j) * picture.width + columns.first + i) * 3;
                    for (int c = 0; c < 3; ++c) {
                        sum[c] +=
                            picture.rgb[at + c] * rows.shares[j] * columns.shares[i];
                    }
                }
            }
            for (const double value : sum) result.rgb.push_back(to_byte(value));
        }
    }
    return result;
}

RgbPicture darken(const RgbPicture& picture, double factor) {
    RgbPicture result = picture;
    for (std::uint8_t& value : result.rgb) value = to_byte(value * factor);
    return result;
}

RgbPicture blur(const RgbPicture& picture, int radius) {
    RgbPicture result = picture;
    const int area = (2 * radius + 1) * (2 * radius + 1);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                int sum = 0;
                for (int dy = -radius; dy <= radius; ++dy) {
                    for (int dx = -radius; dx <= radius; ++dx) {
                        const int from_y = std::clamp(y + dy, 0, picture.height - 1);
                        const int from_x = std::clamp(x + dx, 0, picture.width - 1);
                        sum +=
                            picture
                                .rgb[(static_cast<std::size_t>(from_y) * picture.width +
                                      from_x) *
                                         3 +
                                     c];
                    }
                }
                result.rgb[(static_cast<std::size_t>(y) * picture.width + x) * 3 + c] =
                    to_byte(static_cast<double>(sum) / area);
            }
        }
    }
    return result;
}

RgbPicture poor_copy(const RgbPicture& picture) {
    const int longest = std::max(picture.width, picture.height);
    const int width = std::max(1, picture.width * 48 / longest);
    const int height = std::max(1, picture.height * 48 / longest);
    return darken(blur(resize(picture, width, height), 1), 0.8);
}

RgbPicture mosaic(const RgbPicture& picture, int grid) {
    const int square = 16;
    const RgbPicture cells = resize(picture, grid, grid);
    RgbPicture result{grid * square, grid * square, {}};
    result.rgb.reserve(static_cast<std::size_t>(result.width) * result.height * 3);
    for (int y = 0; y < result.height; ++y) {
        for (int x = 0; x < result.width; ++x) {
            const std::size_t cell =
                (static_cast<std::size_t>(y / square) * grid + x / square) * 3;
            result.rgb.insert(result.rgb.end(),
                              cells.rgb.begin() + static_cast<std::ptrdiff_t>(cell),
                              cells.rgb.begin() + static_cast<std::ptrdiff_t>(cell) + 3);
        }
    }
    return result;
}

RgbPicture painted_mosaic(const RgbPicture& picture, int grid) {
    RgbPicture result = mosaic(picture, grid);
    for (std::size_t at = 0; at < result.rgb.size(); at += 3) {
        const double grey =
            (result.rgb[at] + result.rgb[at + 1] + result.rgb[at + 2]) / 3.0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double vivid = grey + 1.3 * (result.rgb[at + c] - grey);
            result.rgb[at + c] = to_byte(std::round(vivid / 255 * 4) * 255 / 4);
        }
    }
    return result;
}

}  // namespace haarmony::eval
