#include "engine/video/timeline.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

namespace haarmony::video {
namespace {

// What one time node shows and how much of that its time-parent does not.
struct NodeDetail {
    std::int64_t changed_area = 0;  // in pixels of the finest level
    std::int64_t squares = 0;
    int deepest_level = 0;
};

class Survey {
  public:
    Survey(const TimeTree& clip, std::int64_t buckets, int space_level)
        : clip_(clip), shape_(clip.shape()), space_level_(space_level) {
        const std::int64_t frames = shape_.frames();
        for (std::int64_t b = 0; b < buckets; ++b) {
            TimelineBucket& bucket = timeline_.buckets.emplace_back();
            // frames and buckets are below 2^31
            bucket.frames = {b * frames / buckets, (b + 1) * frames / buckets};
            bucket.changed.resize(static_cast<std::size_t>(shape_.time_levels()));
        }
    }

    // A stored time node and all below it.
    [[nodiscard]] Result<void> visit(const NodeAddress& at) {
        const Result<Frame> frame = clip_.frame(at, space_level_);
        if (!frame) return frame.error();
        const bool last = !clip_.finer_in_time(at);
        if (at.time_level == 0) {
            note(at, measure(*frame, nullptr, last), last);
        } else {
            const Result<Frame> parent = clip_.above(*frame);
            if (!parent) return parent.error();
            note(at, measure(*frame, &*parent, last), last);
        }
        if (last) return {};
        for (std::int64_t half = 0; half < 2; ++half) {
            const NodeAddress child{at.time_level + 1, 2 * at.index + half};
            if (!shape_.contains(child)) break;
            if (Result<void> visited = visit(child); !visited) return visited;
        }
        return {};
    }

    [[nodiscard]] Timeline take() { return std::move(timeline_); }

  private:
    [[nodiscard]] NodeDetail measure(const Frame& frame, const Frame* parent, bool last) {
        NodeDetail detail;
        if (space_level_ < kBrickLevel) {
            measure_apex(frame, parent, detail);
            return detail;
        }
        const Ref root = frame.root(Edge::kNormalize);
        if (parent != nullptr) {
            const Ref above = parent->root(Edge::kNormalize);
            detail.changed_area = changed(*parent, above, frame, root, kBrickLevel, 0, 0);
        }
        // Detail in space is that of the frames themselves.
        if (last) count(frame, root, kBrickLevel, detail);
        return detail;
    }

    // Clips of less than a brick have no nodes: their pixels are the squares.
    void measure_apex(const Frame& frame, const Frame* parent, NodeDetail& detail) const {
        const int level = shape_.space_levels();
        const Rgba* pixels = frame.apex(Edge::kNormalize).data() + apex_offset(level);
        for (std::int32_t y = 0; y < shape_.height(); ++y) {
            for (std::int32_t x = 0; x < shape_.width(); ++x) {
                const std::int32_t i = (y << level) + x;
                if (parent == nullptr) continue;
                const Rgba* above =
                    parent->apex(Edge::kNormalize).data() + apex_offset(level);
                detail.changed_area += pixels[i] != above[i] ? 1 : 0;
            }
        }
        detail.squares = 1;
        detail.deepest_level = level;
    }

    // How much of the picture lies in a square of 2^(L - level) pixels, (x, y) of its level.
    [[nodiscard]] std::int64_t area(int level, std::int32_t x, std::int32_t y) const {
        const std::int32_t side = std::int32_t{1} << (shape_.space_levels() - level);
        const std::int64_t width = std::clamp(shape_.width() - x * side, 0, side);
        const std::int64_t height = std::clamp(shape_.height() - y * side, 0, side);
        return width * height;
    }

    // The area that differs between two nodes at the same place, of a frame and of its
    // time-parent: that one's chain is the beginning of the other's, so that the same ref is
    // the same node. (x, y) counts the nodes of the level.
    [[nodiscard]] std::int64_t changed(const Frame& parent,
                                       Ref above,
                                       const Frame& frame,
                                       Ref ref,
                                       int level,
                                       std::int32_t x,
                                       std::int32_t y) {
        if (above == ref) return 0;
        ++timeline_.nodes_visited;
        const int square_level = level - kBrickLevel;
        const LinkedNode old_node = parent.node(level, above);
        const LinkedNode new_node = frame.node(level, ref);
        if (level == space_level_) {
            return old_node == new_node ? 0 : area(square_level, x, y);
        }
        std::int64_t sum = 0;
        for (std::int32_t q = 0; q < 4; ++q) {
            const Ref old_child = old_node.child[static_cast<std::size_t>(q)];
            const Ref new_child = new_node.child[static_cast<std::size_t>(q)];
            const std::int32_t child_x = 2 * x + (q & 1);
            const std::int32_t child_y = 2 * y + (q >> 1);
            if (area(square_level + 1, child_x, child_y) == 0) continue;
            if (old_child != kNoDetailRef && new_child != kNoDetailRef) {
                sum += changed(
                    parent, old_child, frame, new_child, level + 1, child_x, child_y);
            } else if (old_child != new_child || old_node.brick != new_node.brick) {
                sum += area(square_level + 1, child_x, child_y);
            }
        }
        return sum;
    }

    void count(const Frame& frame, Ref ref, int level, NodeDetail& detail) {
        ++timeline_.nodes_visited;
        ++detail.squares;
        detail.deepest_level = std::max(detail.deepest_level, level);
        const LinkedNode node = frame.node(level, ref);
        for (const Ref child : node.child) {
            if (child == kNoDetailRef) continue;
            if (level < space_level_) {
                count(frame, child, level + 1, detail);
            } else {
                detail.deepest_level = level + 1;
            }
        }
    }

    void note(const NodeAddress& at, const NodeDetail& detail, bool last) {
        const FrameRange frames = shape_.frames_of(at);
        const auto picture = static_cast<double>(shape_.width()) * shape_.height();
        const auto buckets = static_cast<std::int64_t>(timeline_.buckets.size());
        std::int64_t b = frames.first * buckets / shape_.frames();
        for (; b < buckets; ++b) {
            TimelineBucket& bucket = timeline_.buckets[static_cast<std::size_t>(b)];
            const std::int64_t shared = std::min(frames.end, bucket.frames.end) -
                                        std::max(frames.first, bucket.frames.first);
            if (bucket.frames.first >= frames.end) break;
            if (shared <= 0) continue;
            const double share =
                static_cast<double>(shared) / static_cast<double>(bucket.frames.count());
            if (at.time_level > 0) {
                bucket.changed[static_cast<std::size_t>(at.time_level - 1)] +=
                    share * static_cast<double>(detail.changed_area) / picture;
            }
            if (!last) continue;
            bucket.squares += share * static_cast<double>(detail.squares);
            bucket.deepest_level = std::max(bucket.deepest_level, detail.deepest_level);
        }
    }

    const TimeTree& clip_;
    ClipShape shape_;
    int space_level_;
    Timeline timeline_;
};

}  // namespace

Result<Timeline> timeline(const TimeTree& clip, std::int64_t buckets, int space_level) {
    const ClipShape& shape = clip.shape();
    assert(space_level >= std::min(kBrickLevel, shape.space_levels()) &&
           space_level <= shape.space_levels());
    if (buckets < 1 || buckets > shape.frames()) {
        return Error{ErrorCode::kInvalidArgument,
                     "buckets is " + std::to_string(buckets) + "; want 1 to " +
                         std::to_string(shape.frames()),
                     "buckets"};
    }
    Survey survey(clip, buckets, space_level);
    if (Result<void> visited = survey.visit({0, 0}); !visited) {
        return std::move(visited).error();
    }
    return survey.take();
}

}  // namespace haarmony::video
