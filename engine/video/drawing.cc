#include "engine/video/drawing.h"

#include <algorithm>
#include <cstring>

namespace haarmony::video {
namespace {

constexpr std::size_t kRowBytes = kBrickSide * sizeof(Rgba);
constexpr int kHalf = kBrickSide / 2;

void copy_pixels(Rgba* out, const Rgba* pixels, std::int32_t count) {
    std::memcpy(out, pixels, static_cast<std::size_t>(count) * sizeof(Rgba));
}

// Most missing children are one level above what is drawn: 4 x 4 pixels, each doubled.
void put_doubled(Rgba* out, std::ptrdiff_t stride, const Rgba* pixels) {
    for (int v = 0; v < kHalf; ++v, pixels += kBrickSide, out += 2 * stride) {
        Rgba row[kBrickSide];
        for (int u = 0; u < kHalf; ++u) row[2 * u] = row[2 * u + 1] = pixels[u];
        std::memcpy(out, row, kRowBytes);
        std::memcpy(out + stride, row, kRowBytes);
    }
}

}  // namespace

void Drawing::tree(int at_level, Ref ref, std::int32_t x, std::int32_t y) {
    const LinkedNode& node = frame_.node(at_level, ref);
    if (at_level == level_) {
        brick(frame_.brick(at_level, node.brick), x, y);
        return;
    }
    const std::int32_t half = kHalf << (level_ - at_level);
    for (unsigned q = 0; q < 4; ++q) {
        const std::int32_t child_x = x + ((q & 1) != 0 ? half : 0);
        const std::int32_t child_y = y + ((q & 2) != 0 ? half : 0);
        if (!touches(child_x, child_y, half)) continue;
        if (node.child[q] == kNoDetailRef) {
            const Brick& pixels = frame_.brick(at_level, node.brick);
            flat(pixels, q, child_x, child_y, level_ - at_level);
        } else {
            tree(at_level + 1, node.child[q], child_x, child_y);
        }
    }
}

void Drawing::brick(const Brick& brick, std::int32_t x, std::int32_t y) {
    ++squares_;
    if (holds(x, y, kBrickSide)) {
        Rgba* out = at(x, y);
        const Rgba* row = brick.data();
        for (int v = 0; v < kBrickSide; ++v, row += kBrickSide, out += stride_) {
            std::memcpy(out, row, kRowBytes);
        }
        return;
    }
    const std::int32_t left = std::max(x, left_);
    const std::int32_t count = std::min(x + kBrickSide, right_) - left;
    const std::int32_t end = std::min(y + kBrickSide, bottom_);
    for (std::int32_t v = std::max(y, top_); v < end; ++v) {
        const Rgba* row = brick.data() + kBrickSide * (v - y) + (left - x);
        copy_pixels(at(left, v), row, count);
    }
}

void Drawing::flat(const Brick& brick,
                   unsigned quadrant,
                   std::int32_t x,
                   std::int32_t y,
                   int shift) {
    ++squares_;
    const bool right_half = (quadrant & 1) != 0;
    const bool lower_half = (quadrant & 2) != 0;
    const Rgba* pixels =
        brick.data() + (right_half ? kHalf : 0) + (lower_half ? kHalf * kBrickSide : 0);
    const std::int32_t side = kHalf << shift;
    if (shift == 1 && holds(x, y, side)) {
        put_doubled(at(x, y), stride_, pixels);
        return;
    }
    const std::int32_t left = std::max(x, left_);
    const std::int32_t right = std::min(x + side, right_);
    for (int v = 0; v < kHalf; ++v, pixels += kBrickSide) {
        const std::int32_t top = std::max(y + (v << shift), top_);
        const std::int32_t bottom = std::min(y + ((v + 1) << shift), bottom_);
        if (top >= bottom) continue;
        for (int u = 0; u < kHalf; ++u) {
            const std::int32_t begin = std::max(x + (u << shift), left);
            const std::int32_t end = std::min(x + ((u + 1) << shift), right);
            if (begin < end)
                std::fill(at(begin, top), at(begin, top) + (end - begin), pixels[u]);
        }
        const Rgba* first = at(left, top);
        for (std::int32_t row = top + 1; row < bottom; ++row) {
            copy_pixels(at(left, row), first, right - left);
        }
    }
}

}  // namespace haarmony::video
