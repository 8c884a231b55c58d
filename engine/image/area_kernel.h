// Sums of a picture over the cells of a grid, exactly: the inner loops of area averages
// (image search, inside step 0 of 5): [area_kernel.h] -> area_mean.h. Vector code chosen at
// run time; integers, so that every choice gives the same sums.
//
// Lengths are counted in parts of a pixel: across, `columns` to a pixel, and down, `rows`.
// The borders of the pixels and of the cells are whole numbers then, and no part is lost.
//
// Shape   rows of cells, each cell with the channels of the picture, 1 or 3, interleaved.
// Units   bytes times parts of a pixel: a white cell is 255 times width times height.
// Errors  none; a wrong shape is a caller's bug and asserts.
// Threads an object belongs to one thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/image_view.h"

namespace haarmony::image {

// Weights are multiplied by bytes in 16 bits.
inline constexpr int kMaxAreaCells = 257;

// The pixels under one cell along one axis: [first, last], all but the ends in full.
struct Overlap {
    int first = 0;
    int last = 0;
    std::uint32_t first_weight = 0;
    std::uint32_t last_weight = 0;  // 0 where first == last

    friend bool operator==(const Overlap&, const Overlap&) = default;
};

// Of cell `cell` of `cells` along an axis of `length` pixels, each `cells` parts long.
[[nodiscard]] Overlap overlap(int cell, int cells, int length);

class AreaSums {
  public:
    // Whether 32 bits hold the sums. Grids of a larger picture are the caller's business.
    [[nodiscard]] static bool fits(const ImageView& picture);

    // Requires: fits(picture), which outlives this; 1 <= columns, rows <= kMaxAreaCells;
    // 1 or 3 channels.
    AreaSums(const ImageView& picture, int columns, int rows);

    // The cells of one row. Valid until the next call. Cost: one pass over its pixels.
    [[nodiscard]] std::span<const std::uint32_t> row(int row);

    // How many pixels the last of a cell lies after its first, over a row of cells.
    struct Widths {
        int fewest = 0;
        int most = 0;
    };

  private:
    ImageView picture_;
    int columns_;
    int rows_;
    std::vector<Overlap> across_;
    Widths widths_;
    std::vector<std::uint32_t> band_;  // the rows under a row of cells, summed up
    std::vector<std::uint32_t> cells_;
};

}  // namespace haarmony::image
