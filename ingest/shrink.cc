#include "ingest/shrink.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <vector>

#include "engine/image/area_kernel.h"
#include "engine/image/area_mean.h"

namespace haarmony::ingest {
namespace {

// Which source pixels one result pixel covers. In units of 1/`to` of a source pixel, result
// i is [i * from, (i + 1) * from): whole numbers, so that no pixel is lost to rounding.
struct Cover {
    int begin = 0;
    int end = 0;
    float first = 0;  // covered part of pixel `begin`
    float last = 0;   // covered part of pixel `end - 1`, where that is another one
};

std::vector<Cover> covers(int from, int to) {
    std::vector<Cover> result(static_cast<std::size_t>(to));
    for (int i = 0; i < to; ++i) {
        const std::int64_t left = std::int64_t{i} * from;
        const std::int64_t right = left + from;
        Cover& cover = result[static_cast<std::size_t>(i)];
        cover.begin = static_cast<int>(left / to);
        cover.end = static_cast<int>((right + to - 1) / to);
        const std::int64_t first_end =
            std::min(right, std::int64_t{cover.begin + 1} * to);
        const std::int64_t last_begin = std::int64_t{cover.end - 1} * to;
        cover.first = static_cast<float>(first_end - left) / static_cast<float>(to);
        cover.last = static_cast<float>(right - last_begin) / static_cast<float>(to);
    }
    return result;
}

float weight(const Cover& cover, int at) {
    if (at == cover.begin) return cover.first;
    return at == cover.end - 1 ? cover.last : 1.0f;
}

// sums += weight * row, with alpha over white. Plain loops over neighbours, which the
// compiler turns into vector instructions.
void add_row(const ImageView& picture, int y, float weight, std::vector<float>& sums) {
    const std::uint8_t* row = picture.row(y);
    if (picture.channels != 4) {
        for (std::size_t i = 0; i < sums.size(); ++i) {
            sums[i] += weight * static_cast<float>(row[i]);
        }
        return;
    }
    float* sum = sums.data();
    for (int x = 0; x < picture.width; ++x, row += 4, sum += 3) {
        const float alpha = static_cast<float>(row[3]) / 255;
        const float white = 255 * (1 - alpha);
        for (int c = 0; c < 3; ++c) {
            sum[c] += weight * (static_cast<float>(row[c]) * alpha + white);
        }
    }
}

// The ends of a cover by their parts, what lies between in full: no test inside the loops,
// and the number of channels known to the compiler.
template <int kDepth>
void average_columns(const std::vector<float>& sums,
                     const std::vector<Cover>& columns,
                     float scale,
                     std::uint8_t* out) {
    for (const Cover& cover : columns) {
        const float* sample =
            sums.data() + static_cast<std::size_t>(cover.begin) * kDepth;
        std::array<float, kDepth> sum{};
        for (int c = 0; c < kDepth; ++c) sum[c] = cover.first * sample[c];
        for (int x = cover.begin + 1; x < cover.end - 1; ++x) {
            sample += kDepth;
            for (int c = 0; c < kDepth; ++c) sum[c] += sample[c];
        }
        if (cover.end - cover.begin > 1) {
            sample += kDepth;
            for (int c = 0; c < kDepth; ++c) sum[c] += cover.last * sample[c];
        }
        for (int c = 0; c < kDepth; ++c) {
            *out++ = static_cast<std::uint8_t>(std::min(255.0f, sum[c] * scale + 0.5f));
        }
    }
}

// The common case, in exact integers.
Raster shrink_exactly(const ImageView& picture, int width, int height) {
    Raster small(width, height, picture.channels);
    image::AreaSums sums(picture, width, height);
    const float scale =
        1.0f / (static_cast<float>(picture.width) * static_cast<float>(picture.height));
    for (int y = 0; y < height; ++y) {
        image::scale_to_bytes(sums.row(y), scale, {small.row(y), small.row_bytes()});
    }
    return small;
}

}  // namespace

Raster shrink(const ImageView& picture, int width, int height) {
    assert(width >= 1 && width <= picture.width && height >= 1 &&
           height <= picture.height);
    assert(picture.channels == 1 || picture.channels == 3 || picture.channels == 4);
    if (picture.channels != 4 && std::max(width, height) <= image::kMaxAreaCells &&
        image::AreaSums::fits(picture)) {
        return shrink_exactly(picture, width, height);
    }
    Raster small(width, height, picture.channels == 1 ? 1 : 3);
    const std::vector<Cover> columns = covers(picture.width, width);
    const std::vector<Cover> rows = covers(picture.height, height);
    const float scale = static_cast<float>(width) / static_cast<float>(picture.width) *
                        static_cast<float>(height) / static_cast<float>(picture.height);
    std::vector<float> sums(static_cast<std::size_t>(picture.width) * small.channels);
    for (int y = 0; y < height; ++y) {
        const Cover& cover = rows[static_cast<std::size_t>(y)];
        std::fill(sums.begin(), sums.end(), 0.0f);
        for (int source = cover.begin; source < cover.end; ++source) {
            add_row(picture, source, weight(cover, source), sums);
        }
        if (small.channels == 1) {
            average_columns<1>(sums, columns, scale, small.row(y));
        } else {
            average_columns<3>(sums, columns, scale, small.row(y));
        }
    }
    return small;
}

}  // namespace haarmony::ingest
