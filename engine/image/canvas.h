// Pixels that strokes are painted on, and how much of each a stroke covers (strokes.h).
//
// Units   cover counts from 0 to kFullCover, in integers, so that a pixel that is covered
//         in full is exactly that; colours are premultiplied, in [0, 1], while layers add up.
// Errors  none.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/image/spans.h"
#include "engine/image/strokes.h"

namespace haarmony::image {

// Along x a pixel is kSubPixel units wide, and it is met by kSubRows lines.
inline constexpr int kSubPixel = 256;
inline constexpr int kFullCover = kSubPixel * kSubRows;

// The cover of one row of pixels, kept as differences: a span costs the same at any length.
class RowCover {
  public:
    explicit RowCover(int width);

    // Adds a span of one line. Requires: it overlaps no other span of the same line.
    void add(const Span& span);

    // Calls visit(x, cover) for the pixels that are touched, and starts the next row.
    template <typename Visit>
    void flush(const Visit& visit);

  private:
    [[nodiscard]] int to_units(double x) const;
    void clear();

    int width_;
    std::vector<int> step_;  // cover of pixel x = edge_[x] + the sum of step_[0..x]
    std::vector<int> edge_;
    std::size_t touched_begin_;  // what may differ from 0
    std::size_t touched_end_ = 0;
};

class Canvas {
  public:
    Canvas(int width, int height, const std::optional<Rgb>& background);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    void paint(std::size_t x, int y, const Rgb& color, int cover);

    // Straight 8-bit RGBA; 0, 0, 0, 0 where nothing is painted.
    [[nodiscard]] std::vector<std::uint8_t> straight() const;

  private:
    int width_;
    int height_;
    std::vector<std::array<float, 4>> pixels_;
};

template <typename Visit>
void RowCover::flush(const Visit& visit) {
    int whole = 0;
    for (std::size_t x = touched_begin_; x < touched_end_; ++x) {
        whole += step_[x];
        const int cover = whole + edge_[x];
        if (cover > 0) visit(x, cover);
    }
    clear();
}

}  // namespace haarmony::image
