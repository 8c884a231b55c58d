// The bricks of one layer, as they are held in memory.
//   brick_packing.h -> [bricks.h] -> layer.h
//
// Shape    the colours of all bricks in one array, the alphas of those that are not opaque in
//          another. Which those are says a bit each, and where theirs are the number of those
//          before: 8 bytes for 32 bricks, up to the last that is not opaque.
// Memory   192 bytes a brick, and 64 for alpha.
// Errors   none; an index past the end is a caller's bug and asserts.
// Threads  const-thread-safe.
#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/video/brick.h"
#include "engine/video/brick_packing.h"

namespace haarmony::video {

class Bricks {
  public:
    [[nodiscard]] std::size_t size() const { return colors_.size(); }
    [[nodiscard]] bool empty() const { return colors_.empty(); }
    void reserve(std::size_t count) { colors_.reserve(count); }
    void push_back(const Brick& brick);
    void shrink_to_fit();
    // Keeps the memory for others.
    void clear();

    // Where brick i is, until there are more or the bricks are gone.
    [[nodiscard]] PackedBrick packed(std::size_t i) const {
        assert(i < size());
        return {&colors_[i], alphas_of(i)};
    }
    [[nodiscard]] Brick operator[](std::size_t i) const {
        Brick brick;
        get(i, brick);
        return brick;
    }
    void get(std::size_t i, Brick& brick) const { unpack(packed(i), brick); }
    // Whether brick i is `brick`, byte for byte.
    [[nodiscard]] bool equals(std::size_t i, const Brick& brick) const {
        return same_pixels(packed(i), brick);
    }

    [[nodiscard]] std::size_t memory_bytes() const {
        return colors_.size() * sizeof(BrickColors) +
               alphas_.size() * sizeof(BrickAlphas) +
               with_alpha_.size() * sizeof(RankedBits);
    }
    friend bool operator==(const Bricks&, const Bricks&) = default;

  private:
    // Which of 32 bricks have alphas, and how many before them.
    struct RankedBits {
        std::uint32_t bits = 0;
        std::uint32_t before = 0;

        friend bool operator==(const RankedBits&, const RankedBits&) = default;
    };

    [[nodiscard]] const BrickAlphas* alphas_of(std::size_t i) const {
        if (i / 32 >= with_alpha_.size()) return nullptr;
        const RankedBits ranked = with_alpha_[i / 32];
        const std::uint32_t rest = ranked.bits >> i % 32;
        if ((rest & 1) == 0) return nullptr;
        const int from_here = std::popcount(rest);
        return &alphas_[ranked.before + std::popcount(ranked.bits) - from_here];
    }

    std::vector<BrickColors> colors_;
    std::vector<BrickAlphas> alphas_;
    std::vector<RankedBits> with_alpha_;
};

}  // namespace haarmony::video
