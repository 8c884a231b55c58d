// Fractional-level zoom, and enlarging beyond the finest level.
#include <algorithm>
#include <bit>
#include <cassert>
#include <string>
#include <vector>

#include "engine/video/display.h"
#include "engine/video/mix.h"

namespace haarmony::video {
namespace {

// The pixels of a level that one axis of a zoomed box reads, from `begin` on.
struct Columns {
    std::int32_t begin = 0;
    std::int32_t end = 0;
    // For each pixel of the box, counted from `begin`; end - begin: a clear one.
    std::vector<std::int32_t> index;
};

// The last source pixel that the dissertation's scatter floor(x M / 2^l) would put at `x`.
std::int64_t last_writer(std::int64_t x, int level, std::int32_t root_side) {
    return (((x + 1) << level) + root_side - 1) / root_side - 1;
}

// `coarser`: the pixels one level above those of `level`. `side` is that of the picture.
Columns gather(std::int32_t first,
               std::int32_t count,
               int level,
               int coarser,
               std::int32_t root_side,
               std::int32_t side,
               Edge edge) {
    Columns columns;
    columns.index.reserve(static_cast<std::size_t>(count));
    for (std::int32_t i = 0; i < count; ++i) {
        const std::int64_t source =
            last_writer(std::int64_t{first} + i, level, root_side) >> coarser;
        // The last pixel of the zoomed picture may begin in the picture and be read from
        // the padding: clear, or, where edges are normalized, what the edge shows.
        columns.index.push_back(static_cast<std::int32_t>(
            std::min<std::int64_t>(source, edge == Edge::kPad ? side : side - 1)));
    }
    columns.begin = std::min(columns.index.front(), side - 1);
    columns.end = std::min(columns.index.back() + 1, side);
    for (std::int32_t& index : columns.index) {
        index = std::min(index, columns.end) - columns.begin;
    }
    return columns;
}

// The rows and columns of a level, drawn, with a clear row and column behind them.
struct Gathered {
    Columns x;
    Columns y;
    Picture picture;

    [[nodiscard]] const Rgba* row(std::int32_t v) const {
        return &picture.at(0, y.index[static_cast<std::size_t>(v)]);
    }
    [[nodiscard]] std::int32_t column(std::int32_t u) const {
        return x.index[static_cast<std::size_t>(u)];
    }
};

Gathered gather_level(const Frame& frame,
                      int level,
                      int coarser,
                      std::int32_t root_side,
                      Edge edge,
                      const PixelBox& box) {
    const ClipShape& shape = frame.shape();
    const int drawn = level - coarser;
    const std::int32_t width = shape.width_at(drawn);
    const std::int32_t height = shape.height_at(drawn);
    Gathered level_pixels{
        gather(box.x, box.width, level, coarser, root_side, width, edge),
        gather(box.y, box.height, level, coarser, root_side, height, edge),
        Picture()};
    const Columns& x = level_pixels.x;
    const Columns& y = level_pixels.y;
    level_pixels.picture = Picture(x.end - x.begin + 1, y.end - y.begin + 1);
    draw(frame,
         drawn,
         edge,
         {x.begin, y.begin, x.end - x.begin, y.end - y.begin},
         level_pixels.picture.pixels.data(),
         level_pixels.picture.width);
    return level_pixels;
}

// Pixels of the finest level around each of a box's, by the distance to their centres. The
// outermost go on outwards.
std::vector<Between> between_centres(std::int32_t first,
                                     std::int32_t count,
                                     int level,
                                     std::int32_t root_side,
                                     std::int32_t side) {
    std::vector<Between> places;
    places.reserve(static_cast<std::size_t>(count));
    const std::int64_t whole = 2 * std::int64_t{root_side};
    for (std::int32_t i = 0; i < count; ++i) {
        const std::int64_t doubled = 2 * (std::int64_t{first} + i) + 1;
        const std::int64_t place = (doubled << level) - root_side;  // in 1 / whole
        const std::int64_t before = place < 0 ? -1 : place / whole;
        const std::int64_t way = place - before * whole;
        const auto rest = static_cast<std::uint32_t>((way << kWayBits) / whole);
        const std::int64_t last = side - 1;
        places.push_back(
            {static_cast<std::int32_t>(std::clamp<std::int64_t>(before, 0, last)),
             static_cast<std::int32_t>(std::clamp<std::int64_t>(before + 1, 0, last)),
             (std::uint32_t{1} << kWayBits) - rest});
    }
    return places;
}

Picture enlarge_smoothly(const Frame& frame,
                         std::int32_t root_side,
                         Edge edge,
                         const PixelBox& box) {
    const ClipShape& shape = frame.shape();
    const int level = shape.space_levels();
    std::vector<Between> x =
        between_centres(box.x, box.width, level, root_side, shape.width());
    const std::vector<Between> y =
        between_centres(box.y, box.height, level, root_side, shape.height());
    const PixelBox read{x.front().first,
                        y.front().first,
                        x.back().second + 1 - x.front().first,
                        y.back().second + 1 - y.front().first};
    const Picture source = draw(frame, level, edge, read);
    for (Between& u : x) {
        u.first -= read.x;
        u.second -= read.x;
    }
    Picture picture(box.width, box.height);
    Rgba* out = picture.pixels.data();
    for (const Between& v : y) {
        const Rgba* above = &source.at(0, v.first - read.y);
        const Rgba* below = &source.at(0, v.second - read.y);
        for (const Between& u : x) {
            *out++ =
                mixed({above[u.first], above[u.second], below[u.first], below[u.second]},
                      u.weight,
                      v.weight);
        }
    }
    return picture;
}

Picture enlarge_flat(const Frame& frame,
                     std::int32_t root_side,
                     Edge edge,
                     const PixelBox& box) {
    const Gathered finest =
        gather_level(frame, frame.shape().space_levels(), 0, root_side, edge, box);
    Picture picture(box.width, box.height);
    Rgba* out = picture.pixels.data();
    for (std::int32_t v = 0; v < box.height; ++v) {
        const Rgba* row = finest.row(v);
        for (std::int32_t u = 0; u < box.width; ++u) *out++ = row[finest.column(u)];
    }
    return picture;
}

Picture mix_levels(const Frame& frame,
                   int level,
                   std::int32_t root_side,
                   Edge edge,
                   const PixelBox& box) {
    const Gathered fine = gather_level(frame, level, 0, root_side, edge, box);
    const Gathered coarse = gather_level(frame, level, 1, root_side, edge, box);
    const int bits = level - 1;
    const auto weight =
        static_cast<std::uint32_t>(root_side) - (std::uint32_t{1} << bits);
    Picture picture(box.width, box.height);
    Rgba* out = picture.pixels.data();
    for (std::int32_t v = 0; v < box.height; ++v) {
        const Rgba* fine_row = fine.row(v);
        const Rgba* coarse_row = coarse.row(v);
        for (std::int32_t u = 0; u < box.width; ++u) {
            *out++ = mixed(
                fine_row[fine.column(u)], coarse_row[coarse.column(u)], weight, bits);
        }
    }
    return picture;
}

std::int32_t zoomed(std::int32_t side, int space_levels, std::int32_t root_side) {
    const std::int64_t whole = std::int64_t{1} << space_levels;
    return static_cast<std::int32_t>((std::int64_t{side} * root_side + whole - 1) /
                                     whole);
}

}  // namespace

std::int32_t zoomed_width(const ClipShape& shape, std::int32_t root_side) {
    assert(root_side >= 1 && root_side <= kMaxRootSide);
    return zoomed(shape.width(), shape.space_levels(), root_side);
}

std::int32_t zoomed_height(const ClipShape& shape, std::int32_t root_side) {
    assert(root_side >= 1 && root_side <= kMaxRootSide);
    return zoomed(shape.height(), shape.space_levels(), root_side);
}

int zoom_level(const ClipShape& shape, std::int32_t root_side) {
    assert(root_side >= 1 && root_side <= kMaxRootSide);
    return std::min(
        static_cast<int>(std::bit_width(static_cast<std::uint32_t>(root_side) - 1)),
        shape.space_levels());
}

Result<std::int32_t> root_side_for_width(const ClipShape& shape, std::int64_t width) {
    const int levels = shape.space_levels();
    const std::int64_t most =
        ((2 * std::int64_t{kMaxRootSide} + 1) * shape.width() - 1) >> (levels + 1);
    if (width < 1 || width > most) {
        return Error{
            ErrorCode::kInvalidArgument,
            "width is " + std::to_string(width) + "; want 1 to " + std::to_string(most),
            "width"};
    }
    const std::int64_t doubled = (width << (levels + 1)) + shape.width();
    return static_cast<std::int32_t>(doubled / (2 * std::int64_t{shape.width()}));
}

Picture zoom(const Frame& frame,
             std::int32_t root_side,
             Edge edge,
             const PixelBox& box,
             Finer finer) {
    const ClipShape& shape = frame.shape();
    assert(root_side >= 1 && root_side <= kMaxRootSide);
    assert(box.x >= 0 && box.y >= 0 && box.width >= 0 && box.height >= 0);
    assert(box.width <= zoomed_width(shape, root_side) - box.x);
    assert(box.height <= zoomed_height(shape, root_side) - box.y);
    const int level = zoom_level(shape, root_side);
    assert(level <= frame.space_level());
    if (box.width == 0 || box.height == 0) return {box.width, box.height};
    if (root_side == std::int32_t{1} << level) return draw(frame, level, edge, box);
    if (root_side < std::int32_t{1} << level) {
        return mix_levels(frame, level, root_side, edge, box);
    }
    return finer == Finer::kSmooth ? enlarge_smoothly(frame, root_side, edge, box)
                                   : enlarge_flat(frame, root_side, edge, box);
}

}  // namespace haarmony::video
