#include "engine/video/ops/preview.h"

#include <algorithm>
#include <string>
#include <utility>

#include "engine/video/exact_mean.h"
#include "engine/video/ops/leaf_tree.h"
#include "engine/video/ops/place.h"
#include "engine/video/ops/tree_picture.h"
#include "engine/video/tree_writer.h"

namespace haarmony::video {
namespace {

Result<void> check(const ClipShape& shape, const NodeAddress& at, int level) {
    const auto outside = [](const char* name, std::int64_t value, std::int64_t most) {
        return Error{ErrorCode::kInvalidArgument,
                     std::string(name) + " is " + std::to_string(value) + "; want 0 to " +
                         std::to_string(most),
                     name};
    };
    if (at.time_level < 0 || at.time_level > shape.time_levels()) {
        return outside("time_level", at.time_level, shape.time_levels());
    }
    const std::int64_t last = shape.nodes_at(at.time_level) - 1;
    if (at.index < 0 || at.index > last) return outside("index", at.index, last);
    if (level < 0 || level > shape.space_levels()) {
        return outside("level", level, shape.space_levels());
    }
    return {};
}

// A layer's frames averaged over a range of the composition's, up to one space level.
class Average {
  public:
    Average(const CompositionLayer& layer, int level)
        : layer_(layer), shape_(layer.clip->shape()), level_(level) {}

    [[nodiscard]] Result<ImageTree> over(const FrameRange& range) {
        const std::int64_t first = std::max(range.first, layer_.start) - layer_.start;
        const std::int64_t end = std::min(range.end, layer_.end()) - layer_.start;
        ImageTree tree;
        if (first >= end) {
            TreeWriter(tree).finish({});
            return tree;
        }
        FrameSum sum({shape_.width_at(level_), shape_.height_at(level_), shape_.rate()});
        const std::int64_t moving = std::min(end, shape_.frames());
        for (std::int64_t at = first; at < moving;) {
            NodeAddress node{shape_.time_levels(), at};
            while (node.time_level > 0 && shape_.frames_of(above(node)).first == at &&
                   shape_.frames_of(above(node)).end <= moving) {
                node = above(node);
            }
            if (Result<void> read = leaf(node, tree); !read) return read.error();
            const std::int64_t frames = shape_.frames_of(node).count();
            if (frames == range.count()) return tree;
            sum.add(tree, frames);
            at += frames;
        }
        // The last frame stays.
        if (const std::int64_t still = end - std::max(first, moving); still > 0) {
            const NodeAddress last{shape_.time_levels(), shape_.frames() - 1};
            if (Result<void> read = leaf(last, tree); !read) return read.error();
            if (still == range.count()) return tree;
            sum.add(tree, still);
        }
        if (const std::int64_t absent = range.count() - (end - first); absent > 0) {
            TreeWriter(tree).finish({});
            sum.add(tree, absent);
        }
        ExactFrame mean;
        sum.mean_into(mean);
        tree.nodes = std::move(mean.nodes);
        tree.bricks = std::move(mean.bricks);
        tree.root = mean.root[static_cast<std::size_t>(Edge::kPad)];
        return tree;
    }

  private:
    static NodeAddress above(const NodeAddress& node) {
        return {node.time_level - 1, node.index >> 1};
    }
    [[nodiscard]] Result<void> leaf(const NodeAddress& node, ImageTree& tree) const {
        const Result<Frame> frame = layer_.clip->frame(node, level_);
        if (!frame) return frame.error();
        leaf_tree(*frame, tree);
        return {};
    }

    const CompositionLayer& layer_;
    const ClipShape& shape_;
    int level_;
};

}  // namespace

Result<Picture> preview(std::span<const CompositionLayer> layers,
                        const FrameFormat& canvas,
                        const NodeAddress& at,
                        int level) {
    const Result<ClipShape> shape = composed_shape(layers, canvas);
    if (!shape) return shape.error();
    if (Result<void> valid = check(*shape, at, level); !valid) return valid.error();
    const int halvings = (*shape).space_levels() - level;
    const FrameFormat format{
        (*shape).width_at(level), (*shape).height_at(level), canvas.rate};
    ImageTree below, placed, both;
    TreeWriter(below).finish({});
    for (const CompositionLayer& layer : layers) {
        const Scale& scale = layer.placement.scale;
        const ClipShape& clip = layer.clip->shape();
        const CanvasBox box = placed_box(clip, layer.placement).value();
        // The coarsest level whose pixels are no wider than the preview's.
        int coarser = 0;
        while (coarser < std::min(halvings, clip.space_levels() - scale.shrink) &&
               std::int64_t{std::max(scale.x, scale.y)} << (coarser + 1) <=
                   std::int64_t{1} << halvings) {
            ++coarser;
        }
        const int layer_level = clip.space_levels() - scale.shrink - coarser;
        Result<ImageTree> tree = Average(layer, layer_level).over((*shape).frames_of(at));
        if (!tree) return std::move(tree).error();
        // Half a pixel further: what lies in its middle is shown.
        const std::int64_t half = halvings == 0 ? 0 : std::int64_t{1} << (halvings - 1);
        place(*tree,
              layer_level,
              {std::int64_t{scale.x} << coarser,
               std::int64_t{scale.y} << coarser,
               box.left + half,
               box.top + half,
               halvings},
              format,
              placed);
        composite(placed, below, layer.op, both);
        std::swap(below, both);
    }
    return tree_picture(below, format);
}

}  // namespace haarmony::video
