#include "engine/video/drawing.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace haarmony::video {
namespace {

constexpr int kHalf = kBrickSide / 2;

void copy_pixels(Rgba* out, const Rgba* pixels, std::int32_t count) {
    std::memcpy(out, pixels, static_cast<std::size_t>(count) * sizeof(Rgba));
}

// Asks for a brick's pixels, without waiting for them.
void fetch(const PackedBrick& brick) {
    constexpr std::size_t kLine = 64;
    for (std::size_t i = 0; i < sizeof(BrickColors); i += kLine)
        __builtin_prefetch(brick.colors->byte.data() + i);
    if (brick.alphas != nullptr) __builtin_prefetch(brick.alphas);
}

}  // namespace

void Drawing::tree(int at_level, Ref ref, std::int32_t x, std::int32_t y) {
    if (at_level == level_) {
        leaf(ref, x, y);
    } else {
        below(at_level, frame_.node(at_level, ref), x, y);
    }
}

void Drawing::below(int at_level,
                    const LinkedNode& node,
                    std::int32_t x,
                    std::int32_t y) {
    const std::int32_t half = kHalf << (level_ - at_level);
    const int finer = at_level + 1;
    // All four are read before the first is looked at: they come from memory together.
    std::array<LinkedNode, 4> child;
    for (unsigned q = 0; q < 4 && finer < level_; ++q) {
        if (node.child[q] != kNoDetailRef) child[q] = frame_.node(finer, node.child[q]);
    }
    for (unsigned q = 0; q < 4; ++q) {
        const std::int32_t child_x = x + ((q & 1) != 0 ? half : 0);
        const std::int32_t child_y = y + ((q & 2) != 0 ? half : 0);
        if (!touches(child_x, child_y, half)) continue;
        if (node.child[q] == kNoDetailRef) {
            const PackedBrick brick = frame_.packed(at_level, node.brick);
            flat(brick, q, child_x, child_y, level_ - at_level);
        } else if (finer == level_) {
            leaf(node.child[q], child_x, child_y);
        } else {
            below(finer, child[q], child_x, child_y);
        }
    }
}

void Drawing::leaf(Ref node, std::int32_t x, std::int32_t y) {
    if (!holds(x, y, kBrickSide)) {
        brick(frame_.brick_of(level_, node), x, y);
        return;
    }
    ++squares_;
    if (waiting_count_ == kMostWaiting) put_waiting();
    waiting_[waiting_count_++] = {node, at(x, y)};
}

void Drawing::brick(const PackedBrick& packed, std::int32_t x, std::int32_t y) {
    ++squares_;
    if (holds(x, y, kBrickSide)) {
        const BrickPut put{packed, at(x, y)};
        put_bricks({&put, 1}, stride_);
        return;
    }
    Brick brick;
    unpack(packed, brick);
    const std::int32_t left = std::max(x, left_);
    const std::int32_t count = std::min(x + kBrickSide, right_) - left;
    const std::int32_t end = std::min(y + kBrickSide, bottom_);
    for (std::int32_t v = std::max(y, top_); v < end; ++v) {
        const Rgba* row = brick.data() + kBrickSide * (v - y) + (left - x);
        copy_pixels(at(left, v), row, count);
    }
}

void Drawing::put_waiting() {
    std::array<BrickPut, kMostWaiting> puts;
    for (std::size_t i = 0; i < waiting_count_; ++i) {
        puts[i] = {frame_.brick_of(level_, waiting_[i].node), waiting_[i].out};
        fetch(puts[i].brick);
    }
    put_bricks({puts.data(), waiting_count_}, stride_);
    waiting_count_ = 0;
}

void Drawing::flat(const PackedBrick& packed,
                   unsigned quadrant,
                   std::int32_t x,
                   std::int32_t y,
                   int shift) {
    ++squares_;
    const std::int32_t side = kHalf << shift;
    // Most missing children are one level above what is drawn.
    if (shift == 1 && holds(x, y, side)) {
        put_doubled(packed, static_cast<int>(quadrant), at(x, y), stride_);
        return;
    }
    Brick brick;
    unpack(packed, brick);
    const Rgba* pixels = brick.data() + ((quadrant & 1) != 0 ? kHalf : 0) +
                         ((quadrant & 2) != 0 ? kHalf * kBrickSide : 0);
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
