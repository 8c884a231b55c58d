#include "engine/video/exact_mean.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

#include "engine/video/sum_tree.h"

namespace haarmony::video {
namespace {

constexpr std::size_t kSide = kBrickSide;
constexpr std::size_t kHalf = kBrickSide / 2;
constexpr auto kPad = static_cast<std::size_t>(Edge::kPad);
constexpr auto kNormalize = static_cast<std::size_t>(Edge::kNormalize);

// Where quadrant q of a brick begins.
constexpr std::size_t corner_of(std::size_t q) {
    return (q >> 1) * kHalf * kSide + (q & 1) * kHalf;
}

// The sum of the 2 x 2 pixels at (2 x, 2 y) of a square with rows of `side`.
PixelSum sum_of_four(const PixelSum* sums,
                     std::size_t side,
                     std::size_t x,
                     std::size_t y) {
    const PixelSum* const upper = sums + 2 * y * side + 2 * x;
    PixelSum sum = upper[0];
    sum += upper[1];
    sum += upper[side];
    sum += upper[side + 1];
    return sum;
}

struct EdgeNode {
    Brick brick;
    std::array<std::uint32_t, 4> child;

    [[nodiscard]] bool has_child() const {
        return std::any_of(child.begin(), child.end(), [](std::uint32_t index) {
            return index != kNoDetail;
        });
    }
    // Whether it shows more than a quadrant of the brick above.
    [[nodiscard]] bool is_finer_than(const Brick& above, std::size_t quadrant) const {
        if (has_child()) return true;
        const Rgba* const corner = &above[corner_of(quadrant)];
        for (std::size_t i = 0; i < brick.size(); ++i) {
            if (brick[i] != corner[i / kSide / 2 * kSide + i % kSide / 2]) return true;
        }
        return false;
    }
    friend bool operator==(const EdgeNode&, const EdgeNode&) = default;
};

// A square averaged, before it is known whether it becomes a node.
struct Averaged {
    SumBrick sums;  // over space and time
    std::array<EdgeNode, kEdges> edge;
    bool same = true;  // both edges; then only kPad's is there
};

class Averager {
  public:
    Averager(const SumTree& sums, const FrameFormat& format, ExactFrame& out)
        : sums_(sums), out_(out) {
        const Result<ClipShape> shape = ClipShape::make(format, 1);
        assert(shape.has_value());
        finest_ = std::max((*shape).space_levels(), kBrickLevel);
        scale_ = finest_ - (*shape).space_levels();
        width_ = std::int64_t{format.width} << scale_;
        height_ = std::int64_t{format.height} << scale_;
    }

    void run() {
        out_.nodes.clear();
        out_.bricks.clear();
        Averaged root;
        average(sums_.root(), kBrickLevel, 0, 0, root);
        out_.root[kPad] = emit(root.edge[kPad]);
        out_.root[kNormalize] = root.same ? out_.root[kPad] : emit(root.edge[kNormalize]);
        average_apex(root.sums);
        out_.bounds = in_pixels();
    }

  private:
    // Pixels of the finest level, which are several to a pixel of a picture below 8 x 8.
    struct Box {
        std::int64_t left, top, right, bottom;
    };
    [[nodiscard]] Box square(int level, std::int64_t x, std::int64_t y) const {
        const int below = finest_ - level;
        return {x << below, y << below, (x + 1) << below, (y + 1) << below};
    }
    // How many of its samples are inside the picture.
    [[nodiscard]] std::uint64_t samples_inside(const Box& box) const {
        const std::int64_t width = std::min(box.right, width_) - box.left;
        const std::int64_t height = std::min(box.bottom, height_) - box.top;
        return width <= 0 || height <= 0 ? 0 : static_cast<std::uint64_t>(width * height);
    }

    [[nodiscard]] std::uint64_t frames() const {
        return static_cast<std::uint64_t>(sums_.frames());
    }
    // The mean of pixel (x, y) of a level.
    [[nodiscard]] Rgba padded(const PixelSum& sum, int level) const {
        return mean(sum, frames() << 2 * (finest_ - level));
    }
    [[nodiscard]] Rgba normalized(const PixelSum& sum,
                                  int level,
                                  std::int64_t x,
                                  std::int64_t y) const {
        const std::uint64_t inside = samples_inside(square(level, x, y));
        assert(inside > 0 || sum == PixelSum{});
        return inside == 0 ? kClear : mean(sum, frames() * inside);
    }

    // Square (x, y) of those that bricks of a level fill.
    void average(std::uint32_t at,
                 int level,
                 std::int64_t x,
                 std::int64_t y,
                 Averaged& out) {
        const TreeNode& node = sums_.node(at);
        std::array<Averaged, 4> below;
        for (std::size_t q = 0; q < 4; ++q) {
            const std::size_t corner = corner_of(q);
            if (node.child[q] == kNoDetail) {
                widen(sums_.brick(node.brick), corner, level, out.sums);
                continue;
            }
            average(node.child[q],
                    level + 1,
                    2 * x + static_cast<std::int64_t>(q & 1),
                    2 * y + static_cast<std::int64_t>(q >> 1),
                    below[q]);
            for (std::size_t i = 0; i < kBrickPixels / 4; ++i) {
                out.sums[corner + i / kHalf * kSide + i % kHalf] =
                    sum_of_four(below[q].sums.data(), kSide, i % kHalf, i / kHalf);
            }
        }
        average_brick(level, x, y, out);
        extend_bounds(node, level, x, y, out.edge[kPad].brick);
        keep_finer(node, below, out);
    }

    // Sums over time alone become sums over all finest pixels.
    void widen(const SumBrick& sums, std::size_t corner, int level, SumBrick& out) const {
        const int below = 2 * (finest_ - level);
        for (std::size_t y = 0; y < kHalf; ++y) {
            for (std::size_t x = 0; x < kHalf; ++x) {
                const PixelSum& sum = sums[corner + y * kSide + x];
                out[corner + y * kSide + x] = {
                    sum.r << below, sum.g << below, sum.b << below, sum.a << below};
            }
        }
    }

    void average_brick(int level, std::int64_t x, std::int64_t y, Averaged& out) const {
        const Box box = square(level - kBrickLevel, x, y);
        const bool crossed =
            samples_inside(box) > 0 && (box.right > width_ || box.bottom > height_);
        for (std::size_t i = 0; i < kBrickPixels; ++i) {
            out.edge[kPad].brick[i] = padded(out.sums[i], level);
            if (!crossed) continue;
            out.edge[kNormalize].brick[i] =
                normalized(out.sums[i],
                           level,
                           x * kBrickSide + static_cast<std::int64_t>(i % kSide),
                           y * kBrickSide + static_cast<std::int64_t>(i / kSide));
        }
        out.same = !crossed;
    }

    // Of the squares below, those become nodes that show more than this one.
    void keep_finer(const TreeNode& node,
                    const std::array<Averaged, 4>& below,
                    Averaged& out) {
        EdgeNode& pad = out.edge[kPad];
        EdgeNode& normalize = out.edge[kNormalize];
        for (std::size_t q = 0; q < 4; ++q) {
            pad.child[q] = kNoDetail;
            normalize.child[q] = kNoDetail;
            if (node.child[q] == kNoDetail) continue;
            const EdgeNode& finer = below[q].edge[kPad];
            if (finer.is_finer_than(pad.brick, q)) pad.child[q] = emit(finer);
            if (out.same) continue;
            if (!below[q].same) {
                const EdgeNode& other = below[q].edge[kNormalize];
                if (other.is_finer_than(normalize.brick, q)) {
                    normalize.child[q] = emit(other);
                }
            } else if (finer.is_finer_than(normalize.brick, q)) {
                normalize.child[q] =
                    pad.child[q] == kNoDetail ? emit(finer) : pad.child[q];
            }
        }
        out.same = out.same || pad == normalize;
    }

    std::uint32_t emit(const EdgeNode& node) {
        out_.bricks.push_back(node.brick);
        out_.nodes.push_back({.brick = static_cast<std::uint32_t>(out_.bricks.size() - 1),
                              .child = node.child});
        return static_cast<std::uint32_t>(out_.nodes.size() - 1);
    }

    void average_apex(const SumBrick& root) {
        SumBrick sums = root;
        for (int level = kBrickLevel - 1; level >= 0; --level) {
            const std::size_t side = std::size_t{1} << level;
            for (std::size_t i = 0; i < side * side; ++i) {
                // Rows shrink in place: never ahead of the reading.
                sums[i] = sum_of_four(sums.data(), 2 * side, i % side, i / side);
                const std::size_t at = static_cast<std::size_t>(apex_offset(level)) + i;
                out_.apex[kPad][at] = padded(sums[i], level);
                out_.apex[kNormalize][at] =
                    normalized(sums[i],
                               level,
                               static_cast<std::int64_t>(i % side),
                               static_cast<std::int64_t>(i / side));
            }
        }
    }

    // By what of a brick has no finer detail.
    void extend_bounds(const TreeNode& node,
                       int level,
                       std::int64_t x,
                       std::int64_t y,
                       const Brick& brick) {
        for (std::size_t i = 0; i < kBrickPixels; ++i) {
            const std::size_t column = i % kSide, row = i / kSide;
            if (node.child[column / kHalf + row / kHalf * 2] != kNoDetail) continue;
            if (brick[i].a == 0) continue;
            const Box pixel = square(level,
                                     x * kBrickSide + static_cast<std::int64_t>(column),
                                     y * kBrickSide + static_cast<std::int64_t>(row));
            bounds_.left = std::min(bounds_.left, pixel.left);
            bounds_.top = std::min(bounds_.top, pixel.top);
            bounds_.right = std::max(bounds_.right, pixel.right);
            bounds_.bottom = std::max(bounds_.bottom, pixel.bottom);
        }
    }

    [[nodiscard]] Bounds in_pixels() const {
        if (bounds_.right == 0) return {};
        return {static_cast<std::int32_t>(bounds_.left >> scale_),
                static_cast<std::int32_t>(bounds_.top >> scale_),
                static_cast<std::int32_t>(bounds_.right >> scale_),
                static_cast<std::int32_t>(bounds_.bottom >> scale_)};
    }

    const SumTree& sums_;
    ExactFrame& out_;
    int finest_ = 0;
    int scale_ = 0;  // log2 of how many finest pixels wide a pixel of the picture is
    std::int64_t width_ = 0;
    std::int64_t height_ = 0;
    Box bounds_{kMaxSide, kMaxSide, 0, 0};
};

}  // namespace

class FrameSum::Impl {
  public:
    explicit Impl(const FrameFormat& frame_format) : format(frame_format) {}

    FrameFormat format;
    SumTree sums;
};

FrameSum::FrameSum(const FrameFormat& format) : impl_(std::make_unique<Impl>(format)) {
    assert(ClipShape::make(format, 1).has_value());
}
FrameSum::~FrameSum() = default;
FrameSum::FrameSum(FrameSum&&) noexcept = default;
FrameSum& FrameSum::operator=(FrameSum&&) noexcept = default;

void FrameSum::add(const ImageTree& tree, std::int64_t repeats) {
    impl_->sums.add(tree, repeats);
}

void FrameSum::add(const FrameSum& other) {
    assert(impl_->format == other.impl_->format);
    impl_->sums.add(other.impl_->sums);
}

void FrameSum::clear() { impl_->sums.clear(); }

std::int64_t FrameSum::frames() const { return impl_->sums.frames(); }

void FrameSum::mean_into(ExactFrame& out) const {
    assert(frames() >= 1);
    Averager(impl_->sums, impl_->format, out).run();
}

}  // namespace haarmony::video
