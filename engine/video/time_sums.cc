#include "engine/video/time_sums.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <utility>

#include "engine/video/brick_match.h"

namespace haarmony::video {
namespace {

bool same_below(const ExactFrame& a,
                std::uint32_t i,
                const ExactFrame& b,
                std::uint32_t j) {
    const TreeNode& p = a.nodes[i];
    const TreeNode& q = b.nodes[j];
    if (!same_bytes(a.bricks[p.brick], b.bricks[q.brick])) return false;
    for (std::size_t child = 0; child < p.child.size(); ++child) {
        const bool missing = p.child[child] == kNoDetail;
        if (missing != (q.child[child] == kNoDetail)) return false;
        if (!missing && !same_below(a, p.child[child], b, q.child[child])) return false;
    }
    return true;
}

// Whether single frames look the same at every level: equal at the finest, then. Both are
// pruned, so that equal pictures have equal shapes, whatever the order of their nodes.
bool same_picture(const ExactFrame& a, const ExactFrame& b) {
    const auto padded = static_cast<std::size_t>(Edge::kPad);
    return a.apex == b.apex && same_below(a, a.root[padded], b, b.root[padded]);
}

}  // namespace

TimeSums::Waiting& TimeSums::waiting(int height) {
    while (waiting_.size() <= static_cast<std::size_t>(height)) {
        waiting_.push_back({FrameSum(format_), {}, false});
    }
    return waiting_[static_cast<std::size_t>(height)];
}

Result<void> TimeSums::add(const ImageTree& tree, std::int64_t repeats) {
    assert(repeats >= 1);
    bool begins = true;
    // Blocks as large as their place allows: 2 log2(repeats) at most.
    while (repeats > 0) {
        int height =
            static_cast<int>(std::bit_width(static_cast<std::uint64_t>(repeats))) - 1;
        if (frames_ > 0) {
            const auto begin = static_cast<std::uint64_t>(frames_);
            height = std::min(height, std::countr_zero(begin));
        }
        const std::int64_t block = std::int64_t{1} << height;
        sum_.clear();
        sum_.add(tree, block);
        if (begins) {
            const Result<void> spooled = spool_single();
            if (!spooled) return spooled;
            begins = false;
        }
        frames_ += block;
        const Result<void> completed = complete(height, {*last_spooled_, true});
        if (!completed) return completed;
        repeats -= block;
    }
    return {};
}

Result<void> TimeSums::spool_single() {
    // However often it stays, the mean of equal frames is that frame.
    sum_.mean_into(exact_);
    if (last_spooled_ && same_picture(exact_, last_)) return {};
    const Result<SpooledFrame> spooled = spool_.put(exact_);
    if (!spooled) return spooled.error();
    last_spooled_ = *spooled;
    std::swap(last_, exact_);
    return {};
}

Result<void> TimeSums::add_whole(int height, FrameSum sum, bool uniform) {
    assert(sum.frames() == std::int64_t{1} << height);
    assert(frames_ % sum.frames() == 0);
    sum_ = std::move(sum);
    SpooledNode node{{}, uniform};
    if (uniform) {
        const Result<void> spooled = spool_single();
        if (!spooled) return spooled;
        node.frame = *last_spooled_;
    } else {
        sum_.mean_into(exact_);
        const Result<SpooledFrame> spooled = spool_.put(exact_);
        if (!spooled) return spooled.error();
        node.frame = *spooled;
    }
    frames_ += sum_.frames();
    return complete(height, node);
}

Result<void> TimeSums::complete(int height, SpooledNode node) {
    std::int64_t index = (frames_ - 1) >> height;
    nodes_.add(height, index, node);
    // As in binary addition: a second half completes its parent.
    for (; (index & 1) != 0; ++height, index >>= 1) {
        const Result<SpooledNode> joined = join(waiting(height), node);
        if (!joined) return joined.error();
        node = *joined;
        nodes_.add(height + 1, index >> 1, node);
    }
    Waiting& place = waiting(height);
    std::swap(place.sum, sum_);
    place.node = node;
    place.present = true;
    return {};
}

Result<SpooledNode> TimeSums::join(Waiting& first, const SpooledNode& second) {
    assert(first.present);
    first.present = false;
    first.sum.add(sum_);
    std::swap(first.sum, sum_);
    if (first.node.uniform && second.uniform && first.node.frame == second.frame) {
        return second;
    }
    sum_.mean_into(exact_);
    const Result<SpooledFrame> spooled = spool_.put(exact_);
    if (!spooled) return spooled.error();
    return SpooledNode{*spooled, false};
}

Result<SpooledNodes> TimeSums::finish() {
    assert(frames_ >= 1);
    const auto root =
        static_cast<int>(std::bit_width(static_cast<std::uint64_t>(frames_ - 1)));
    // The node on the right edge that is not complete, with its sum in sum_.
    std::optional<SpooledNode> edge;
    for (int height = 0; height < root; ++height) {
        Waiting& first = waiting(height);
        if (first.present) {
            if (edge) {
                const Result<SpooledNode> joined = join(first, *edge);
                if (!joined) return joined.error();
                edge = *joined;
            } else {
                first.present = false;
                std::swap(first.sum, sum_);
                edge = first.node;
            }
        }
        // A half without a brother is its parent.
        if (edge) nodes_.add(height + 1, (frames_ - 1) >> (height + 1), *edge);
    }
    return std::move(nodes_);
}

}  // namespace haarmony::video
