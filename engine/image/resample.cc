#include "engine/image/resample.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <memory>
#include <span>
#include <vector>

#include "engine/image/area_kernel.h"
#include "engine/image/area_mean.h"
#include "engine/image/mask.h"

namespace haarmony::image {
namespace {

constexpr std::uint32_t kPixelLength = kSide;  // in the parts of area_kernel.h

// Adds weight * row to the running sums of a band. With alpha: premultiplied colours and
// alpha itself. A band's weights add up to the picture's height, so a sum is at most
// 255 * 255 * 65535 and fits 32 bits.
template <int kSamples>
void add_row(const std::uint8_t* row,
             int width,
             std::uint32_t weight,
             std::uint32_t* sums) {
    if constexpr (kSamples == 4) {
        for (int x = 0; x < width; ++x, row += 4, sums += 4) {
            const std::uint32_t alpha = weight * row[3];
            sums[0] += alpha * row[0];
            sums[1] += alpha * row[1];
            sums[2] += alpha * row[2];
            sums[3] += alpha;
        }
    } else {
        const int count = width * kSamples;
        for (int i = 0; i < count; ++i) {
            // At most 128 * 255: a 16-bit product, which every vector unit has.
            sums[i] += static_cast<std::uint16_t>(weight * row[i]);
        }
    }
}

// The exact sums of one row of cells.
template <int kSamples>
void sum_cells(const std::uint32_t* sums,
               const std::array<Overlap, kSide>& columns,
               std::int64_t* cells) {
    for (const Overlap& column : columns) {
        const std::uint32_t* pixel = sums + std::size_t(column.first) * kSamples;
        std::array<std::uint64_t, kSamples> total{};
        for (int c = 0; c < kSamples; ++c) {
            total[c] = std::uint64_t{column.first_weight} * pixel[c];
        }
        if (column.last > column.first) {
            std::array<std::uint64_t, kSamples> whole{};
            for (int x = column.first + 1; x < column.last; ++x) {
                pixel += kSamples;
                for (int c = 0; c < kSamples; ++c) whole[c] += pixel[c];
            }
            pixel += kSamples;
            for (int c = 0; c < kSamples; ++c) {
                total[c] += kPixelLength * whole[c] +
                            std::uint64_t{column.last_weight} * pixel[c];
            }
        }
        for (int c = 0; c < kSamples; ++c) cells[c] = static_cast<std::int64_t>(total[c]);
        cells += kSamples;
    }
}

// The exact sums of all cells, interleaved as the picture is.
template <int kSamples>
std::vector<std::int64_t> sum_all_cells(const ImageView& picture) {
    std::array<Overlap, kSide> columns;
    for (int i = 0; i < kSide; ++i) columns[i] = overlap(i, kSide, picture.width);

    std::vector<std::int64_t> cells(std::size_t{kCoefficientCount} * kSamples);
    std::vector<std::uint32_t> sums(std::size_t(picture.width) * kSamples);
    for (int band = 0; band < kSide; ++band) {
        const Overlap rows = overlap(band, kSide, picture.height);
        std::fill(sums.begin(), sums.end(), 0U);
        for (int y = rows.first; y <= rows.last; ++y) {
            const std::uint32_t weight = y == rows.first  ? rows.first_weight
                                         : y == rows.last ? rows.last_weight
                                                          : kPixelLength;
            add_row<kSamples>(picture.row(y), picture.width, weight, sums.data());
        }
        sum_cells<kSamples>(
            sums.data(), columns, cells.data() + std::size_t(band) * kSide * kSamples);
    }
    return cells;
}

std::span<float> row_of(Plane& plane, int row) {
    return std::span(plane).subspan(std::size_t(row) * kSide, kSide);
}

// The area of a cell times the largest sample.
double full_scale(const ImageView& picture) {
    return 255.0 * picture.width * picture.height;
}

// Pictures whose sums do not fit AreaSums.
template <int kSamples>
void fill_from_large(const ImageView& picture, ColorPlanes& rgb) {
    const std::vector<std::int64_t> cells = sum_all_cells<kSamples>(picture);
    const double scale = full_scale(picture);
    for (int i = 0; i < kCoefficientCount; ++i) {
        for (int c = 0; c < kSamples; ++c) {
            rgb[c][i] = static_cast<float>(
                static_cast<double>(cells[std::size_t(i) * kSamples + c]) / scale);
        }
    }
}

void fill_from_grey(const ImageView& picture, ColorPlanes& rgb) {
    if (AreaSums::fits(picture)) {
        AreaSums sums(picture, kSide, kSide);
        for (int i = 0; i < kSide; ++i) {
            divide(sums.row(i), full_scale(picture), row_of(rgb[0], i));
        }
    } else {
        fill_from_large<1>(picture, rgb);
    }
    rgb[1] = rgb[0];
    rgb[2] = rgb[0];
}

void fill_from_rgb(const ImageView& picture, ColorPlanes& rgb) {
    if (!AreaSums::fits(picture)) return fill_from_large<3>(picture, rgb);
    AreaSums sums(picture, kSide, kSide);
    std::array<float, std::size_t{3} * kSide> cells;
    for (int i = 0; i < kSide; ++i) {
        divide(sums.row(i), full_scale(picture), cells);
        take_apart(cells, row_of(rgb[0], i), row_of(rgb[1], i), row_of(rgb[2], i));
    }
}

// Colours are means of what is painted, weighed by alpha.
std::unique_ptr<Plane> fill_from_rgba(const ImageView& picture, ColorPlanes& rgb) {
    const std::vector<std::int64_t> cells = sum_all_cells<4>(picture);
    std::int64_t most_opaque = 0;
    bool equally_opaque = true;
    for (std::size_t i = 3; i < cells.size(); i += 4) {
        most_opaque = std::max(most_opaque, cells[i]);
        equally_opaque = equally_opaque && cells[i] == cells[3];
    }
    auto cover = std::make_unique<Plane>();
    for (Plane& plane : rgb) plane.fill(0.0F);
    if (most_opaque == 0) return cover;

    for (int i = 0; i < kCoefficientCount; ++i) {
        const double alpha = static_cast<double>(cells[4 * i + 3]);
        (*cover)[i] = static_cast<float>(alpha / static_cast<double>(most_opaque));
        if (alpha == 0) continue;
        for (int c = 0; c < 3; ++c) {
            // Both are integers below 2^53: one rounding, that of the division.
            rgb[c][i] = static_cast<float>(static_cast<double>(cells[4 * i + c]) /
                                           (255.0 * alpha));
        }
    }
    if (equally_opaque) return nullptr;
    extend_painted(*cover, rgb);
    return cover;
}

}  // namespace

std::unique_ptr<Plane> area_average(const ImageView& picture, ColorPlanes& rgb) {
    assert(picture.pixels != nullptr);
    assert(picture.width >= 1 && picture.width <= kMaxPictureSide);
    assert(picture.height >= 1 && picture.height <= kMaxPictureSide);
    assert(picture.channels == 1 || picture.channels == 3 || picture.channels == 4);
    switch (picture.channels) {
        case 1:
            fill_from_grey(picture, rgb);
            return nullptr;
        case 3:
            fill_from_rgb(picture, rgb);
            return nullptr;
        default:
            return fill_from_rgba(picture, rgb);
    }
}

}  // namespace haarmony::image
