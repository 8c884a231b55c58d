#include "engine/video/accounting.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "engine/video/brick_match.h"
#include "engine/video/pixel_mask.h"

namespace haarmony::video {
namespace {

constexpr PixelMask kAll = ~PixelMask{0};

std::uint64_t bits_in(PixelMask mask) {
    return static_cast<std::uint64_t>(std::popcount(mask));
}

// Which pixels of a node's brick are subtrees (something below looks different), and how
// many subtrees they and all below them are.
struct Subtrees {
    PixelMask here = 0;
    std::uint64_t count = 0;
};

// The subtrees of every own node of some siblings, by space level and index.
using LayerSubtrees = std::vector<std::vector<Subtrees>>;

// What differs from the time-parent.
struct Changes {
    std::uint64_t own = 0;
    std::uint64_t uplinks = 0;
};

// Levels 0 to 2 have no brick of their own: theirs has them in its left upper corner.
Brick corner_brick(const Apex& apex, int level) {
    Brick brick{};
    const int side = 1 << level;
    for (int i = 0; i < side * side; ++i) {
        brick[static_cast<std::size_t>(i / side * kBrickSide + i % side)] =
            apex[static_cast<std::size_t>(apex_offset(level) + i)];
    }
    return brick;
}

// Adds the subtrees that quadrant q of `brick` has, with `below` in it.
void add_quadrant(const Brick& brick,
                  int q,
                  const Brick& brick_below,
                  const Subtrees& below,
                  Subtrees& subtrees) {
    const int flat = repeated_pixels(brick, q, brick_below) & ~any_of_four(below.here);
    const PixelMask here = in_quadrant(static_cast<QuadrantMask>(~flat), q);
    subtrees.here |= here;
    subtrees.count += below.count + bits_in(here);
}

class Counter {
  public:
    explicit Counter(const TimeTree& clip) : clip_(clip), shape_(clip.shape()) {}

    Result<StorageCounts> count() {
        const Result<void> counted = count_siblings({0, 0}, nullptr);
        if (!counted) return counted.error();
        // A complete tree has (4^L - 1) / 3 squares above its finest level L.
        const std::uint64_t complete =
            ((std::uint64_t{1} << (2 * shape_.space_levels())) - 1) / 3;
        total_.time_nodes = static_cast<std::uint64_t>(shape_.time_nodes());
        total_.complete_subtrees = total_.time_nodes * complete;
        const std::uint64_t nodes = kTimeNodeBytes * total_.time_nodes;
        total_.paper_bytes = kSubtreeBytes * total_.own_subtrees + nodes;
        total_.complete_bytes = kSubtreeBytes * total_.complete_subtrees + nodes;
        total_.pruned_bytes = kSubtreeBytes * total_.pruned_subtrees + nodes;
        return total_;
    }

  private:
    // `above`: the frame of their time-parent, as the walk came by it; null at the root.
    Result<void> count_siblings(const SiblingAddress& address, const Frame* above);
    // Counts the node, and where nothing finer in time is stored, all nodes below it.
    void count_node(const Frame& frame, const Frame* parent);
    // Those of the siblings that the frame's refs of a time level lead to.
    void find_subtrees(const Frame& frame, int time_level);
    // Which pixels are, with all below them, what the time-parent has.
    PixelMask compare(int level,
                      const Frame& frame,
                      Ref node,
                      const Frame& parent,
                      Ref above,
                      Changes& changes) const;
    [[nodiscard]] const Subtrees& known(int level, Ref node) const {
        return chain_[static_cast<std::size_t>(time_level_of(node))]
                     [static_cast<std::size_t>(level - kBrickLevel)][index_of(node)];
    }
    [[nodiscard]] std::uint64_t nodes_below(const NodeAddress& at) const;

    const TimeTree& clip_;
    const ClipShape& shape_;
    StorageCounts total_;
    std::vector<LayerSubtrees> chain_;  // by time level of refs
};

Result<void> Counter::count_siblings(const SiblingAddress& address, const Frame* above) {
    const int k = address.time_level;
    const std::int64_t first = k == 0 ? 0 : 2 * address.index;
    const std::int64_t end = std::min(first + (k == 0 ? 1 : 2), shape_.nodes_at(k));
    std::optional<Frame> parent;
    std::size_t shared = 0;
    std::vector<LayerSubtrees> aside;
    for (std::int64_t index = first; index < end; ++index) {
        Result<Frame> frame = clip_.frame({k, index}, shape_.space_levels());
        if (!frame) return std::move(frame).error();
        if (index == first) {
            if (above != nullptr) {
                // Siblings from before an append have other time-ancestors than the walk.
                shared = static_cast<std::size_t>(
                    Frame::last_shared_level(*above, *frame) + 1);
                aside.assign(std::make_move_iterator(chain_.begin() +
                                                     static_cast<std::ptrdiff_t>(shared)),
                             std::make_move_iterator(chain_.end()));
                chain_.resize(shared);
                Result<Frame> found = clip_.above(*frame);
                if (!found) return std::move(found).error();
                parent = *std::move(found);
            }
            for (int level = static_cast<int>(shared); level <= (*frame).depth(); ++level)
                find_subtrees(*frame, level);
        }
        count_node(*frame, parent ? &*parent : nullptr);
        if (!clip_.finer_in_time({k, index})) continue;
        const Result<void> below = count_siblings({k + 1, index}, &*frame);
        if (!below) return below;
    }
    chain_.resize(shared);
    std::move(aside.begin(), aside.end(), std::back_inserter(chain_));
    return {};
}

// The finest level first, so that what lies below is known.
void Counter::find_subtrees(const Frame& frame, int time_level) {
    LayerSubtrees& layers = chain_.emplace_back();
    layers.resize(
        static_cast<std::size_t>(std::max(0, shape_.space_levels() - kBrickLevel + 1)));
    for (int level = shape_.space_levels(); level >= kBrickLevel; --level) {
        const Layer& layer = frame.layer(time_level, level);
        std::vector<Subtrees>& found =
            layers[static_cast<std::size_t>(level - kBrickLevel)];
        found.reserve(layer.nodes.size());
        for (std::size_t i = 0; i < layer.nodes.size(); ++i) {
            const LinkedNode node = layer.nodes[i];
            Subtrees& subtrees = found.emplace_back();
            const Brick& brick = frame.brick(level, node.brick);
            for (int q = 0; q < 4; ++q) {
                const Ref child = node.child[static_cast<std::size_t>(q)];
                if (child == kNoDetailRef) continue;
                const Ref below = frame.node(level + 1, child).brick;
                add_quadrant(brick,
                             q,
                             frame.brick(level + 1, below),
                             known(level + 1, child),
                             subtrees);
            }
        }
    }
}

void Counter::count_node(const Frame& frame, const Frame* parent) {
    const int finest = std::min(shape_.space_levels(), kBrickLevel);
    Brick brick;
    Subtrees subtrees;
    PixelMask same = 0;
    Changes changes;
    if (finest == kBrickLevel) {
        const Ref root = frame.root(Edge::kPad);
        brick = frame.brick(finest, frame.node(finest, root).brick);
        subtrees = known(finest, root);
        if (parent != nullptr) {
            same =
                compare(finest, frame, root, *parent, parent->root(Edge::kPad), changes);
        }
    } else {
        brick = corner_brick(frame.apex(Edge::kPad), finest);
        if (parent != nullptr) {
            same = equal_pixels(brick, corner_brick(parent->apex(Edge::kPad), finest));
        }
    }
    for (int level = finest - 1; level >= 0; --level) {
        const Brick coarser = corner_brick(frame.apex(Edge::kPad), level);
        Subtrees subtrees_here;
        add_quadrant(coarser, 0, brick, subtrees, subtrees_here);
        PixelMask same_here = 0;
        if (parent != nullptr) {
            const Brick above = corner_brick(parent->apex(Edge::kPad), level);
            same_here = equal_pixels(coarser, above) & in_quadrant(all_of_four(same), 0);
            changes.own += bits_in(subtrees_here.here & ~same_here);
            changes.uplinks +=
                bits_in(subtrees.here & same & ~four_of_each(quadrant_of(same_here, 0)));
        }
        brick = coarser;
        subtrees = subtrees_here;
        same = same_here;
    }
    if (parent == nullptr) changes.own = subtrees.count;
    changes.uplinks += bits_in(subtrees.here & same);
    total_.own_subtrees += changes.own;
    total_.uplinks += changes.uplinks;
    total_.pruned_subtrees += subtrees.count;
    if (clip_.finer_in_time(frame.asked())) return;
    const std::uint64_t alike = nodes_below(frame.asked());
    total_.pruned_subtrees += alike * subtrees.count;
    total_.uplinks += alike * (subtrees.count == 0 ? 0 : 1);
}

PixelMask Counter::compare(int level,
                           const Frame& frame,
                           Ref node,
                           const Frame& parent,
                           Ref above,
                           Changes& changes) const {
    if (node == above) return kAll;
    const LinkedNode mine = frame.node(level, node);
    const LinkedNode theirs = parent.node(level, above);
    const Subtrees& subtrees = known(level, node);
    PixelMask same = mine.brick == theirs.brick
                         ? kAll
                         : equal_pixels(frame.brick(level, mine.brick),
                                        parent.brick(level, theirs.brick));
    for (int q = 0; q < 4; ++q) {
        const Ref child = mine.child[static_cast<std::size_t>(q)];
        const Ref their_child = theirs.child[static_cast<std::size_t>(q)];
        const PixelMask whole_quadrant = in_quadrant(0xFFFF, q);
        if (child == kNoDetailRef || their_child == kNoDetailRef) {
            // One of them is flat: the same where the other one is, too.
            same &= ~(whole_quadrant & (subtrees.here | known(level, above).here));
            if (child != kNoDetailRef) changes.own += known(level + 1, child).count;
            continue;
        }
        const PixelMask below =
            compare(level + 1, frame, child, parent, their_child, changes);
        same &= ~whole_quadrant | in_quadrant(all_of_four(below), q);
        changes.uplinks += bits_in(known(level + 1, child).here & below &
                                   ~four_of_each(quadrant_of(same, q)));
    }
    changes.own += bits_in(subtrees.here & ~same);
    return same;
}

std::uint64_t Counter::nodes_below(const NodeAddress& at) const {
    std::uint64_t nodes = 0;
    for (int k = at.time_level + 1; k <= shape_.time_levels(); ++k) {
        const int deeper = k - at.time_level;
        const std::int64_t end = std::min((at.index + 1) << deeper, shape_.nodes_at(k));
        nodes += static_cast<std::uint64_t>(end - (at.index << deeper));
    }
    return nodes;
}

}  // namespace

Result<StorageCounts> count_storage(const TimeTree& clip) {
    return Counter(clip).count();
}

}  // namespace haarmony::video
