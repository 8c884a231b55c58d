// Squares of an image tree put into a buffer of pixels: what all ways of drawing share.
//   time_tree.h, brick_packing.h -> [drawing.h] -> display.h, incremental_display.h
//
// Shape   (x, y) is a square's origin in pixels of the level that is drawn; a square of a node
//         at level m is 8 x 2^(level - m) pixels wide. What lies outside the box is left out.
// Errors  none; a ref that is not the frame's is a caller's bug.
// Cost    proportional to the pixels put, and to the bricks that the box touches.
// Source  sec. 5.3.2, Figure 5.8 [DrawImage, DrawSquare, DrawPixel].
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/video/brick_packing.h"
#include "engine/video/picture.h"
#include "engine/video/time_tree.h"

namespace haarmony::video {

class Drawing {
  public:
    // `out` is the pixel at the box's origin.
    Drawing(const Frame& frame,
            int level,
            const PixelBox& box,
            Rgba* out,
            std::ptrdiff_t stride)
        : frame_(frame),
          level_(level),
          left_(box.x),
          top_(box.y),
          right_(box.x + box.width),
          bottom_(box.y + box.height),
          out_(out),
          stride_(stride) {}
    Drawing(const Drawing&) = delete;
    Drawing& operator=(const Drawing&) = delete;
    // All that was asked for is drawn by now, and not before.
    ~Drawing() { put_waiting(); }

    // A node of level `at` <= the level drawn, and all below it.
    void tree(int at, Ref node, std::int32_t x, std::int32_t y);
    // A brick of the level drawn.
    void brick(const PackedBrick& brick, std::int32_t x, std::int32_t y);
    // A quadrant of a brick that has no finer detail: each pixel a square of 2^shift.
    void flat(const PackedBrick& brick,
              unsigned quadrant,
              std::int32_t x,
              std::int32_t y,
              int shift);

    // Bricks and quadrants that were put, wholly or in part.
    [[nodiscard]] std::int64_t squares() const { return squares_; }
    [[nodiscard]] bool touches(std::int32_t x, std::int32_t y, std::int32_t side) const {
        return x < right_ && y < bottom_ && x + side > left_ && y + side > top_;
    }

  private:
    // Nodes of the level drawn wait for each other, so that their bricks come from memory
    // together.
    static constexpr std::size_t kMostWaiting = 64;
    struct Leaf {
        Ref node{};
        Rgba* out = nullptr;
    };

    [[nodiscard]] bool holds(std::int32_t x, std::int32_t y, std::int32_t side) const {
        return x >= left_ && y >= top_ && x + side <= right_ && y + side <= bottom_;
    }
    [[nodiscard]] Rgba* at(std::int32_t x, std::int32_t y) const {
        return out_ + (y - top_) * stride_ + (x - left_);
    }
    // What is below a node of a coarser level than the one drawn.
    void below(int at, const LinkedNode& node, std::int32_t x, std::int32_t y);
    // A node of the level drawn.
    void leaf(Ref node, std::int32_t x, std::int32_t y);
    void put_waiting();

    const Frame& frame_;
    int level_;
    std::int32_t left_, top_, right_, bottom_;
    Rgba* out_;
    std::ptrdiff_t stride_;
    std::int64_t squares_ = 0;
    std::array<Leaf, kMostWaiting> waiting_;
    std::size_t waiting_count_ = 0;
};

}  // namespace haarmony::video
