#include "engine/video/exact_mean.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>

#include "engine/video/space_sums.h"
#include "engine/video/sum_kernel.h"
#include "engine/video/sum_tree.h"

namespace haarmony::video {
namespace {

constexpr std::size_t kSide = kBrickSide;
constexpr std::size_t kHalf = kBrickSide / 2;
constexpr auto kPad = static_cast<std::size_t>(Edge::kPad);
constexpr auto kNormalize = static_cast<std::size_t>(Edge::kNormalize);

std::uint32_t word_of(Rgba pixel) { return std::bit_cast<std::uint32_t>(pixel); }

struct EdgeNode {
    PixelWords words;
    std::array<std::uint32_t, 4> child;

    [[nodiscard]] bool has_child() const {
        return std::any_of(child.begin(), child.end(), [](std::uint32_t index) {
            return index != kNoDetail;
        });
    }
    // Whether it shows more than a quadrant of the brick above.
    [[nodiscard]] bool is_finer_than(const PixelWords& above,
                                     std::size_t quadrant) const {
        if (has_child()) return true;
        const std::uint32_t* const corner = &above[quadrant_corner(quadrant)];
        for (std::size_t i = 0; i < words.size(); ++i) {
            if (words[i] != corner[i / kSide / 2 * kSide + i % kSide / 2]) return true;
        }
        return false;
    }
    friend bool operator==(const EdgeNode&, const EdgeNode&) = default;
};

// A square averaged, before it is known whether it becomes a node.
struct Averaged {
    SpaceSums sums;
    bool is_same;  // both edges show the same; then only kPad's is there
    std::array<EdgeNode, kEdges> edge;
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
        out_.root[kNormalize] =
            root.is_same ? out_.root[kPad] : emit(root.edge[kNormalize]);
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
        const SumNode& node = sums_.node(at);
        std::array<Averaged, 4> below;
        for (std::size_t q = 0; q < 4; ++q) {
            if (node.child[q] == kNoDetail) continue;
            average(node.child[q],
                    level + 1,
                    2 * x + static_cast<std::int64_t>(q & 1),
                    2 * y + static_cast<std::int64_t>(q >> 1),
                    below[q]);
        }
        add_up(node, level, below, out.sums);
        average_brick(level, x, y, out);
        extend_bounds(node, level, x, y, out);
        keep_finer(node, below, out);
    }

    // The sums of a square from those of its quadrants.
    void add_up(const SumNode& node,
                int level,
                const std::array<Averaged, 4>& below,
                SpaceSums& out) const {
        bool opaque = true;
        bool is_leaf = true;
        for (std::size_t q = 0; q < 4; ++q) {
            const bool has_child = node.child[q] != kNoDetail;
            is_leaf &= !has_child;
            opaque &=
                has_child ? below[q].sums.is_opaque() : node.width == SumWidth::kShort;
        }
        out.begin(frames(), finest_ - level, opaque);
        if (is_leaf && level == finest_) {
            sums_.visit(node, [&out](const auto& sums) { out.take_finest(sums); });
            return;
        }
        for (std::size_t q = 0; q < 4; ++q) {
            if (node.child[q] != kNoDetail) {
                out.take(below[q].sums, q);
            } else {
                sums_.visit(node, [&out, q](const auto& sums) { out.take(sums, q); });
            }
        }
    }

    void average_brick(int level, std::int64_t x, std::int64_t y, Averaged& out) const {
        out.sums.mean_into(out.edge[kPad].words);
        const Box box = square(level - kBrickLevel, x, y);
        out.is_same = box.right <= width_ && box.bottom <= height_;
        // Each of the finest pixels lies inside or outside as a whole.
        if (out.is_same || level == finest_ || samples_inside(box) == 0) {
            out.is_same = true;
            return;
        }
        for (std::size_t i = 0; i < kBrickPixels; ++i) {
            out.edge[kNormalize].words[i] = word_of(
                normalized(out.sums.at(i),
                           level,
                           x * kBrickSide + static_cast<std::int64_t>(i % kSide),
                           y * kBrickSide + static_cast<std::int64_t>(i / kSide)));
        }
    }

    // Of the squares below, those become nodes that show more than this one.
    void keep_finer(const SumNode& node,
                    const std::array<Averaged, 4>& below,
                    Averaged& out) {
        EdgeNode& pad = out.edge[kPad];
        EdgeNode& normalize = out.edge[kNormalize];
        for (std::size_t q = 0; q < 4; ++q) {
            pad.child[q] = kNoDetail;
            normalize.child[q] = kNoDetail;
            if (node.child[q] == kNoDetail) continue;
            const EdgeNode& finer = below[q].edge[kPad];
            if (finer.is_finer_than(pad.words, q)) pad.child[q] = emit(finer);
            if (out.is_same) continue;
            if (!below[q].is_same) {
                const EdgeNode& other = below[q].edge[kNormalize];
                if (other.is_finer_than(normalize.words, q)) {
                    normalize.child[q] = emit(other);
                }
            } else if (finer.is_finer_than(normalize.words, q)) {
                normalize.child[q] =
                    pad.child[q] == kNoDetail ? emit(finer) : pad.child[q];
            }
        }
        out.is_same = out.is_same || pad == normalize;
    }

    std::uint32_t emit(const EdgeNode& node) {
        out_.bricks.push_back(std::bit_cast<Brick>(node.words));
        out_.nodes.push_back({.brick = static_cast<std::uint32_t>(out_.bricks.size() - 1),
                              .child = node.child});
        return static_cast<std::uint32_t>(out_.nodes.size() - 1);
    }

    void average_apex(const SpaceSums& root) {
        std::array<PixelSum, kBrickPixels> sums;
        for (std::size_t i = 0; i < kBrickPixels; ++i) {
            sums[i] = root.at(i);
        }
        for (int level = kBrickLevel - 1; level >= 0; --level) {
            const std::size_t side = std::size_t{1} << level;
            for (std::size_t i = 0; i < side * side; ++i) {
                // Rows shrink in place: never ahead of the reading.
                sums[i] = sum_of_four(sums.data(), 2 * side, i % side, i / side);
                const std::size_t at = static_cast<std::size_t>(apex_offset(level)) + i;
                out_.apex[kPad][at] = mean(sums[i], frames() << 2 * (finest_ - level));
                out_.apex[kNormalize][at] =
                    normalized(sums[i],
                               level,
                               static_cast<std::int64_t>(i % side),
                               static_cast<std::int64_t>(i / side));
            }
        }
    }

    // By what of a brick has no finer detail.
    void extend_bounds(const SumNode& node,
                       int level,
                       std::int64_t x,
                       std::int64_t y,
                       const Averaged& averaged) {
        const Box box = square(level - kBrickLevel, x, y);
        if (bounds_.left <= box.left && bounds_.top <= box.top &&
            bounds_.right >= box.right && bounds_.bottom >= box.bottom) {
            return;
        }
        const auto brick = std::bit_cast<Brick>(averaged.edge[kPad].words);
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
