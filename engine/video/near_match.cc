#include "engine/video/near_match.h"

#include "engine/video/brick_match.h"

namespace haarmony::video {

void NearMatch::begin(const ExactFrame& frame) {
    frame_ = &frame;
    answers_.assign(frame.nodes.size(), Answer{});
}

bool NearMatch::shows(Ref shown, std::uint32_t node, int level) {
    Answer& answer = answers_[node];
    if (answer.shown != shown) answer = {shown, compare(shown, node, level)};
    return answer.shows;
}

bool NearMatch::compare(Ref shown, std::uint32_t node, int level) {
    const TreeNode& exact = frame_->nodes[node];
    const LinkedNode linked = chain_.node(level, shown);
    const Brick& exact_brick = frame_->bricks[exact.brick];
    const Brick& shown_brick = chain_.brick(level, linked.brick);
    if (!within(exact_brick, shown_brick, delta_)) return false;
    for (int q = 0; q < 4; ++q) {
        const std::uint32_t below = exact.child[static_cast<std::size_t>(q)];
        const Ref shown_below = linked.child[static_cast<std::size_t>(q)];
        if (shown_below == kNoDetailRef) {
            if (below != kNoDetail && !flat(shown_brick, q, below)) return false;
        } else if (below == kNoDetail) {
            if (!flat(shown_below, enlarged_quadrant(exact_brick, q), level + 1)) {
                return false;
            }
        } else if (!shows(shown_below, below, level + 1)) {
            return false;
        }
    }
    return true;
}

bool NearMatch::flat(const Brick& brick, int q, std::uint32_t node) const {
    return flat(enlarged_quadrant(brick, q), node);
}

bool NearMatch::flat(const Brick& enlarged, std::uint32_t node) const {
    const TreeNode& exact = frame_->nodes[node];
    if (!within(frame_->bricks[exact.brick], enlarged, delta_)) return false;
    for (int q = 0; q < 4; ++q) {
        const std::uint32_t below = exact.child[static_cast<std::size_t>(q)];
        if (below != kNoDetail && !flat(enlarged_quadrant(enlarged, q), below)) {
            return false;
        }
    }
    return true;
}

bool NearMatch::flat(Ref shown, const Brick& enlarged, int level) const {
    const LinkedNode linked = chain_.node(level, shown);
    if (!within(chain_.brick(level, linked.brick), enlarged, delta_)) return false;
    for (int q = 0; q < 4; ++q) {
        const Ref below = linked.child[static_cast<std::size_t>(q)];
        if (below != kNoDetailRef &&
            !flat(below, enlarged_quadrant(enlarged, q), level + 1)) {
            return false;
        }
    }
    return true;
}

}  // namespace haarmony::video
