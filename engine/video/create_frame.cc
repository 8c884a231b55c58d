#include "engine/video/create_frame.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

#include "engine/video/tree_writer.h"

namespace haarmony::video {
namespace {

// Clear pixels lose their colour.
Brick canonical(const Brick& brick) {
    constexpr auto kAlpha = std::bit_cast<std::uint32_t>(Rgba{0, 0, 0, 255});
    auto words = std::bit_cast<std::array<std::uint32_t, kBrickPixels>>(brick);
    for (std::uint32_t& word : words) word = (word & kAlpha) == 0 ? 0 : word;
    return std::bit_cast<Brick>(words);
}

int space_levels(std::int32_t width, std::int32_t height) {
    const Result<ClipShape> shape = ClipShape::make({width, height, {}}, 1);
    assert(shape.has_value());
    return (*shape).space_levels();
}

class PictureReader {
  public:
    PictureReader(const ImageView& picture, ImageTree& tree)
        : picture_(picture),
          writer_(tree),
          levels_(space_levels(picture.width, picture.height)) {}

    void read() {
        if (levels_ >= kBrickLevel) {
            writer_.finish(read(levels_, 0, 0));
        } else {
            writer_.finish(writer_.add(scaled()));
        }
    }

  private:
    // The square of 2^side x 2^side pixels that begins at (left, top).
    [[nodiscard]] TreePart read(int side, std::int32_t left, std::int32_t top) {
        if (left >= picture_.width || top >= picture_.height) return {};
        if (side == kBrickLevel) return writer_.add(brick(left, top));
        const std::int32_t half = 1 << (side - 1);
        return writer_.join({read(side - 1, left, top),
                             read(side - 1, left + half, top),
                             read(side - 1, left, top + half),
                             read(side - 1, left + half, top + half)});
    }

    [[nodiscard]] Brick brick(std::int32_t left, std::int32_t top) const {
        const int columns = std::min(kBrickSide, picture_.width - left);
        const int rows = std::min(kBrickSide, picture_.height - top);
        Brick pixels{};
        for (int y = 0; y < rows; ++y) {
            Rgba* const out = &pixels[static_cast<std::size_t>(y * kBrickSide)];
            const std::uint8_t* const in =
                picture_.row(top + y) + std::ptrdiff_t{left} * picture_.channels;
            if (picture_.channels == 3) {
                for (int x = 0; x < columns; ++x) {
                    out[x] = {in[3 * x], in[3 * x + 1], in[3 * x + 2], 255};
                }
            } else {
                std::memcpy(static_cast<void*>(out),
                            in,
                            static_cast<std::size_t>(columns) * sizeof(Rgba));
            }
        }
        return picture_.channels == 4 ? canonical(pixels) : pixels;
    }

    // A picture of less than 8 x 8, each pixel as a square of several.
    [[nodiscard]] Brick scaled() const {
        const Brick small = brick(0, 0);
        const int scale = kBrickLevel - levels_;
        Brick pixels;
        for (int i = 0; i < kBrickPixels; ++i) {
            const int x = (i % kBrickSide) >> scale;
            const int y = (i / kBrickSide) >> scale;
            pixels[static_cast<std::size_t>(i)] =
                small[static_cast<std::size_t>(y * kBrickSide + x)];
        }
        return pixels;
    }

    ImageView picture_;
    TreeWriter writer_;
    int levels_;
};

// A leaf square, and the finest pixels that it covers as a range of their Z-order.
struct Leaf {
    LeafSquare square;
    std::size_t number = 0;  // as given
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
};

// How many squares of the same size come before (x, y) in Z-order.
std::uint64_t z_order(std::int32_t x, std::int32_t y) {
    std::uint64_t order = 0;
    for (int bit = 0; bit < 32; ++bit) {
        order |= static_cast<std::uint64_t>(x >> bit & 1) << 2 * bit |
                 static_cast<std::uint64_t>(y >> bit & 1) << (2 * bit + 1);
    }
    return order;
}

// Those that meet the range [begin, end). Requires: disjoint, in order.
std::span<const Leaf> meeting(std::span<const Leaf> leaves,
                              std::uint64_t begin,
                              std::uint64_t end) {
    const auto first =
        std::partition_point(leaves.begin(), leaves.end(), [begin](const Leaf& leaf) {
            return leaf.end <= begin;
        });
    const auto last = std::partition_point(
        first, leaves.end(), [end](const Leaf& leaf) { return leaf.begin < end; });
    return {first, last};
}

std::string described(std::size_t number, const LeafSquare& leaf) {
    return "leaf " + std::to_string(number) + " (level " + std::to_string(leaf.level) +
           ", x " + std::to_string(leaf.x) + ", y " + std::to_string(leaf.y) + ")";
}

Error refused(const std::string& message) {
    return {ErrorCode::kInvalidArgument, message, "leaves"};
}

// The leaves in Z-order. `finest` is the level whose pixels are counted, at least `levels`.
Result<std::vector<Leaf>> in_order(std::span<const LeafSquare> squares,
                                   int levels,
                                   int finest) {
    std::vector<Leaf> leaves;
    leaves.reserve(squares.size());
    for (std::size_t i = 0; i < squares.size(); ++i) {
        const LeafSquare& square = squares[i];
        if (square.level > levels) {
            return refused(described(i, square) + " is deeper than the " +
                           std::to_string(levels) + " levels of the root square");
        }
        const std::int32_t side = square.level < 0 ? 0 : 1 << square.level;
        if (square.x < 0 || square.x >= side || square.y < 0 || square.y >= side) {
            return refused(described(i, square) + " lies outside the root square");
        }
        const std::uint64_t samples = std::uint64_t{1} << 2 * (finest - square.level);
        const std::uint64_t begin = z_order(square.x, square.y) * samples;
        leaves.push_back(
            {.square = square, .number = i, .begin = begin, .end = begin + samples});
    }
    std::sort(leaves.begin(), leaves.end(), [](const Leaf& a, const Leaf& b) {
        return a.begin != b.begin ? a.begin < b.begin : a.number < b.number;
    });
    for (std::size_t i = 1; i < leaves.size(); ++i) {
        const Leaf &a = leaves[i - 1], &b = leaves[i];
        if (b.begin < a.end) {
            return refused(described(b.number, b.square) + " overlaps " +
                           described(a.number, a.square));
        }
    }
    return leaves;
}

class LeafReader {
  public:
    // `finest` is the level of the finest pixels, `scale` of them wide each of the picture's.
    LeafReader(const FrameFormat& format, int finest, int scale, ImageTree& tree)
        : writer_(tree),
          finest_(finest),
          width_(std::int64_t{format.width} * scale),
          height_(std::int64_t{format.height} * scale) {}

    // Requires: no two leaves overlap; in Z-order.
    void read(std::span<const Leaf> leaves) {
        writer_.finish(read(leaves, kBrickLevel, 0, 0));
    }

  private:
    // Squares of the finest pixels.
    struct Square {
        std::int64_t left, top, side;
    };
    [[nodiscard]] bool is_outside(const Square& square) const {
        return square.left >= width_ || square.top >= height_;
    }
    [[nodiscard]] bool is_inside(const Square& square) const {
        return square.left + square.side <= width_ && square.top + square.side <= height_;
    }

    // Square (x, y) of those that the bricks of a level fill, and the leaves that it meets.
    [[nodiscard]] TreePart read(std::span<const Leaf> leaves,
                                int level,
                                std::int32_t x,
                                std::int32_t y) {
        std::array<TreePart, 4> quadrants;
        const int below = finest_ - level;
        const std::int64_t side = std::int64_t{kBrickSide / 2} << below;
        for (std::int32_t q = 0; q < 4; ++q) {
            const std::int32_t column = 2 * x + (q & 1), row = 2 * y + (q >> 1);
            const Square square{column * side, row * side, side};
            if (is_outside(square)) continue;
            const std::uint64_t samples = std::uint64_t{kBrickPixels / 4} << 2 * below;
            const std::uint64_t begin = z_order(column, row) * samples;
            const std::span<const Leaf> within = meeting(leaves, begin, begin + samples);
            const bool finer =
                level < finest_ && !within.empty() &&
                (!is_inside(square) ||
                 std::any_of(within.begin(), within.end(), [level](const Leaf& leaf) {
                     return leaf.square.level > level;
                 }));
            TreePart& part = quadrants[static_cast<std::size_t>(q)];
            if (finer) {
                part = read(within, level + 1, column, row);
            } else {
                for (const Leaf& leaf : within) fill(leaf.square, level, square, part);
            }
        }
        return writer_.join(quadrants);
    }

    // What of the leaf lies in the square, a quadrant of a brick of this level, in which each
    // pixel is inside the picture, or is a finest one.
    void fill(const LeafSquare& leaf,
              int level,
              const Square& square,
              TreePart& part) const {
        constexpr int kHalf = kBrickSide / 2;
        const std::int64_t pixel = square.side / kHalf;
        for (int i = 0; i < kHalf * kHalf; ++i) {
            const std::int64_t x = square.left / pixel + i % kHalf;
            const std::int64_t y = square.top / pixel + i / kHalf;
            if (x * pixel >= width_ || y * pixel >= height_) continue;
            if (x >> (level - leaf.level) != leaf.x) continue;
            if (y >> (level - leaf.level) != leaf.y) continue;
            part.pixels[static_cast<std::size_t>(i)] = video::canonical(leaf.color);
        }
    }

    TreeWriter writer_;
    int finest_;
    std::int64_t width_;
    std::int64_t height_;
};

}  // namespace

void create_frame(const ImageView& picture, ImageTree& tree) {
    assert(picture.channels == 3 || picture.channels == 4);
    assert(picture.width >= 1 && picture.width <= kMaxSide);
    assert(picture.height >= 1 && picture.height <= kMaxSide);
    PictureReader(picture, tree).read();
}

Result<void> create_frame(std::span<const LeafSquare> leaves,
                          const FrameFormat& format,
                          ImageTree& tree) {
    const int levels = space_levels(format.width, format.height);
    const int finest = std::max(levels, kBrickLevel);
    const Result<std::vector<Leaf>> ordered = in_order(leaves, levels, finest);
    if (!ordered) return ordered.error();
    LeafReader(format, finest, 1 << (finest - levels), tree).read(*ordered);
    return {};
}

}  // namespace haarmony::video
