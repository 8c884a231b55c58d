#include "engine/video/advance.h"

#include <cassert>
#include <cmath>

namespace haarmony::video {
namespace {

class Way {
  public:
    Way(const ClipShape& shape, std::int64_t front, Direction direction, double target)
        : shape_(shape), front_(front), direction_(direction), target_(target) {
        assert(front >= 0 && front <= shape.frames() && !at_end(shape, front, direction));
    }

    // The node of a time level that holds the frame beyond the front.
    [[nodiscard]] NodeAddress node(int time_level) const {
        const std::int64_t frame =
            direction_ == Direction::kForwards ? front_ : front_ - 1;
        return {time_level, frame >> (shape_.time_levels() - time_level)};
    }
    // How far the far end of a node is beyond the target.
    [[nodiscard]] double beyond(const NodeAddress& at) const {
        const std::int64_t end = front_of(shape_.frames_of(at), direction_);
        const double ahead = static_cast<double>(end) - target_;
        return direction_ == Direction::kForwards ? ahead : -ahead;
    }
    [[nodiscard]] double away(const NodeAddress& at) const {
        return std::abs(beyond(at));
    }
    // Whether a node begins at the front: nothing is shown twice.
    [[nodiscard]] bool fits(const NodeAddress& at) const {
        const FrameRange frames = shape_.frames_of(at);
        return (direction_ == Direction::kForwards ? frames.first : frames.end) == front_;
    }
    [[nodiscard]] double lag() const {
        const double lag = target_ - static_cast<double>(front_);
        return direction_ == Direction::kForwards ? lag : -lag;
    }

  private:
    const ClipShape& shape_;
    std::int64_t front_;
    Direction direction_;
    double target_;
};

}  // namespace

NodeAddress furthest_node(const ClipShape& shape,
                          std::int64_t front,
                          Direction direction,
                          double limit) {
    const Way way(shape, front, direction, limit);
    NodeAddress furthest = way.node(shape.time_levels());
    for (int level = shape.time_levels() - 1; level >= 0; --level) {
        const NodeAddress node = way.node(level);
        if (way.beyond(node) > 0) break;
        if (way.beyond(node) > way.beyond(furthest)) furthest = node;
    }
    return furthest;
}

NodeAddress steady_node(const ClipShape& shape,
                        std::int64_t front,
                        Direction direction,
                        double target,
                        double step) {
    assert(step > 0);
    const Way way(shape, front, direction, target);
    if (way.lag() > 3 * step) {
        const double half = direction == Direction::kForwards ? step / 2 : -step / 2;
        return furthest_node(shape, front, direction, target + half);
    }
    int level = shape.time_levels();
    double size = 1;
    while (level > 0 && 2 * size <= step) {
        --level;
        size *= 2;
    }
    const NodeAddress small = way.node(level);
    if (level == 0) return small;
    const NodeAddress large = way.node(level - 1);
    if (way.fits(large)) {
        // The large node takes one step, its two halves take two: whichever comes nearer.
        return way.beyond(large) <= step / 2 ? large : small;
    }
    // In the midst of a large node its second half goes on. Where not even a small node
    // begins, as after a change of pace, some frames are shown twice.
    if (way.fits(small)) return small;
    return way.away(large) < way.away(small) ? large : small;
}

}  // namespace haarmony::video
