#include "engine/video/ops/place.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <optional>
#include <vector>

#include "engine/video/ops/tree_square.h"
#include "engine/video/tree_writer.h"

namespace haarmony::video {
namespace {

// Everything below is in units of the canvas: its finest pixels or, where the root square
// is smaller than a brick, the brick's pixels.
struct Box {
    std::int64_t left = 0;
    std::int64_t top = 0;
    std::int64_t right = 0;
    std::int64_t bottom = 0;

    [[nodiscard]] bool empty() const { return right <= left || bottom <= top; }
    [[nodiscard]] bool covers(const Box& other) const {
        return left <= other.left && top <= other.top && right >= other.right &&
               bottom >= other.bottom;
    }
};

Box intersection(const Box& a, const Box& b) {
    return {std::max(a.left, b.left),
            std::max(a.top, b.top),
            std::min(a.right, b.right),
            std::min(a.bottom, b.bottom)};
}

// A square of the tree: where it begins and how wide it is, in the tree's own units.
struct Part {
    TreeSquare square;
    std::int64_t x = 0;
    std::int64_t y = 0;
    std::int64_t side = 0;
};

Part quadrant(const Part& part, int q) {
    assert(part.side >= 2);
    const std::int64_t half = part.side / 2;
    return {
        part.square.quadrant(q), part.x + (q & 1) * half, part.y + (q >> 1) * half, half};
}

class Placing {
  public:
    Placing(const Mapping& mapping, int levels, const FrameFormat& canvas, ImageTree& out)
        : writer_(out) {
        assert(mapping.scale_x >= 1 && mapping.scale_y >= 1);
        assert(mapping.halvings >= 0 && mapping.halvings <= 32);
        const int canvas_levels = ClipShape::make(canvas, 1).value().space_levels();
        // Pixels of a canvas below level 3 are several units wide, and so are the tree's.
        const int unit = std::max(0, kBrickLevel - canvas_levels);
        halvings_ = mapping.halvings + std::max(0, kBrickLevel - levels);
        cell_ = std::int64_t{1} << unit;
        scale_x_ = mapping.scale_x * cell_;
        scale_y_ = mapping.scale_y * cell_;
        const std::int64_t whole = cell_ << (halvings_ - mapping.halvings);
        add_x_ = mapping.add_x * whole;
        add_y_ = mapping.add_y * whole;
        canvas_ = {0, 0, canvas.width * cell_, canvas.height * cell_};
        side_ = std::int64_t{1} << std::max(kBrickLevel, canvas_levels);
        root_side_ = std::int64_t{1} << std::max(kBrickLevel, levels);
    }

    Visited run(const ImageTree& tree) {
        const Part root{TreeSquare::root_of(tree), 0, 0, root_side_};
        content_ = intersection(canvas_, box_of(root));
        lists_.resize(static_cast<std::size_t>(std::bit_width(
                          static_cast<std::uint64_t>(side_ / kBrickSide))) +
                      1);
        const Box all{0, 0, side_, side_};
        narrow(root, intersection(all, content_), side_, lists_[0]);
        writer_.finish(emit(0, all));
        return visited_;
    }

  private:
    [[nodiscard]] std::int64_t map_x(std::int64_t u) const {
        return cells((u * scale_x_ + add_x_) >> halvings_);
    }
    [[nodiscard]] std::int64_t map_y(std::int64_t v) const {
        return cells((v * scale_y_ + add_y_) >> halvings_);
    }
    // Floors to whole pixels of the canvas.
    [[nodiscard]] std::int64_t cells(std::int64_t at) const { return at & -cell_; }
    [[nodiscard]] Box box_of(const Part& part) const {
        return {map_x(part.x),
                map_y(part.y),
                map_x(part.x + part.side),
                map_y(part.y + part.side)};
    }

    // Appends what of `part` lies in `region`, in squares of which neither side is twice
    // `side` or more: so many squares of the canvas at most look at one of the tree.
    void narrow(const Part& part,
                const Box& region,
                std::int64_t side,
                std::vector<Part>& parts) {
        if (intersection(box_of(part), region).empty()) return;
        ++visited_.read;
        const std::int64_t longest =
            part.side * std::max(scale_x_, scale_y_) >> halvings_;
        if (part.square.flat() || longest < 2 * side) {
            parts.push_back(part);
            return;
        }
        for (int q = 0; q < 4; ++q) narrow(quadrant(part, q), region, side, parts);
    }

    // The one colour that a box shows, if its parts tell.
    [[nodiscard]] std::optional<Rgba> one_color(const std::vector<Part>& parts,
                                                const Box& box) const {
        std::optional<Rgba> one;
        if (parts.empty() || !content_.covers(box)) one = kClear;
        for (const Part& part : parts) {
            if (!part.square.flat()) return std::nullopt;
            if (one && *one != part.square.pixel(0, 0)) return std::nullopt;
            one = part.square.pixel(0, 0);
        }
        return one;
    }

    // Whether pixels of `pixel` units show all that the parts have.
    [[nodiscard]] bool shown_by(std::int64_t pixel,
                                const std::vector<Part>& parts,
                                const Box& box) const {
        if (pixel == 1) return true;
        const auto whole = [pixel](std::int64_t at) { return at % pixel == 0; };
        const Box edge = intersection(box, content_);
        if (!whole(edge.left) || !whole(edge.top) || !whole(edge.right) ||
            !whole(edge.bottom)) {
            return false;
        }
        const std::int64_t step = pixel << halvings_;
        if (add_x_ % step != 0 || add_y_ % step != 0) return false;
        return std::all_of(parts.begin(), parts.end(), [&](const Part& part) {
            const std::int64_t cell = part.side / part.square.side();
            return part.square.resolved() && cell * scale_x_ % step == 0 &&
                   cell * scale_y_ % step == 0;
        });
    }

    TreePart emit(std::size_t depth, const Box& box) {
        ++visited_.written;
        const std::vector<Part>& parts = lists_[depth];
        if (const std::optional<Rgba> color = one_color(parts, box)) {
            TreePart flat;
            flat.pixels.fill(*color);
            return flat;
        }
        const std::int64_t side = box.right - box.left;
        const std::int64_t pixel = side / kBrickSide;
        if (shown_by(pixel, parts, box)) {
            Brick brick{};
            for (const Part& part : parts) paint(part, box, pixel, brick);
            return writer_.add(brick);
        }
        const std::int64_t half = side / 2;
        std::array<TreePart, 4> quadrants;
        for (std::size_t q = 0; q < 4; ++q) {
            Box below = box;
            below.left += static_cast<std::int64_t>(q & 1) * half;
            below.top += static_cast<std::int64_t>(q >> 1) * half;
            below.right = below.left + half;
            below.bottom = below.top + half;
            const Box region = intersection(below, content_);
            lists_[depth + 1].clear();
            if (!region.empty()) {
                for (const Part& part : parts) {
                    narrow(part, region, half, lists_[depth + 1]);
                }
            }
            quadrants[q] = emit(depth + 1, below);
        }
        return writer_.join(quadrants);
    }

    // Into the pixels of a box's brick, each `pixel` units wide.
    void paint(const Part& part, const Box& box, std::int64_t pixel, Brick& brick) {
        const Box region = intersection(intersection(box_of(part), content_), box);
        if (region.empty()) return;
        ++visited_.read;
        if (!part.square.resolved()) {
            for (int q = 0; q < 4; ++q) paint(quadrant(part, q), box, pixel, brick);
            return;
        }
        const int count = part.square.side();
        const std::int64_t cell = part.side / count;
        std::array<std::int64_t, kBrickSide + 1> columns{};
        for (int i = 0; i <= count; ++i) {
            columns[static_cast<std::size_t>(i)] =
                (std::clamp(map_x(part.x + i * cell), region.left, region.right) -
                 box.left) /
                pixel;
        }
        std::int64_t top = (region.top - box.top) / pixel;
        for (int j = 0; j < count; ++j) {
            const std::int64_t bottom =
                (std::clamp(map_y(part.y + (j + 1) * cell), region.top, region.bottom) -
                 box.top) /
                pixel;
            for (std::int64_t y = top; y < bottom; ++y) {
                Rgba* row = brick.data() + y * kBrickSide;
                for (int i = 0; i < count; ++i) {
                    const auto from = columns[static_cast<std::size_t>(i)];
                    const auto to = columns[static_cast<std::size_t>(i) + 1];
                    if (from < to)
                        std::fill(row + from, row + to, part.square.pixel(i, j));
                }
            }
            top = bottom;
        }
    }

    TreeWriter writer_;
    Visited visited_;
    std::int64_t scale_x_ = 1, scale_y_ = 1, add_x_ = 0, add_y_ = 0;
    int halvings_ = 0;
    std::int64_t cell_ = 1;  // units in a pixel of the canvas
    std::int64_t side_ = 0;
    std::int64_t root_side_ = 0;
    Box canvas_;
    Box content_;                           // of the canvas, what the tree reaches
    std::vector<std::vector<Part>> lists_;  // by depth in the canvas
};

}  // namespace

Visited place(const ImageTree& tree,
              int levels,
              const Mapping& mapping,
              const FrameFormat& canvas,
              ImageTree& out) {
    return Placing(mapping, levels, canvas, out).run(tree);
}

}  // namespace haarmony::video
