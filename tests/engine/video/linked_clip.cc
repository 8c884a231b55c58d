#include "tests/engine/video/linked_clip.h"

#include <algorithm>
#include <array>
#include <optional>
#include <random>
#include <utility>
#include <vector>

namespace haarmony::video::testing {
namespace {

struct PlainNode {
    const Frame* frame;
    int level;
    Ref ref;

    [[nodiscard]] Brick brick() const {
        return frame->brick(level, frame->node(level, ref).brick);
    }
    [[nodiscard]] std::optional<PlainNode> child(std::size_t q) const {
        const Ref below = frame->node(level, ref).child[q];
        if (below == kNoDetailRef) return std::nullopt;
        return PlainNode{frame, level + 1, below};
    }
};

bool same_tree(const PlainNode& a, const PlainNode& b) {
    if (a.brick() != b.brick()) return false;
    for (std::size_t q = 0; q < 4; ++q) {
        const auto below = a.child(q);
        if (below && !same_tree(*below, *b.child(q))) return false;
    }
    return true;
}

Brick doubled_quadrant(const Brick& brick, std::size_t q) {
    Brick doubled;
    for (std::size_t y = 0; y < 8; ++y) {
        for (std::size_t x = 0; x < 8; ++x) {
            doubled[8 * y + x] = brick[8 * (4 * (q >> 1) + y / 2) + 4 * (q & 1) + x / 2];
        }
    }
    return doubled;
}

// Whether nothing in the subtree differs from `shown`, what the level above shows there.
bool flat(const PlainNode& node, const Brick& shown) {
    if (node.brick() != shown) return false;
    for (std::size_t q = 0; q < 4; ++q) {
        const auto below = node.child(q);
        if (below && !flat(*below, doubled_quadrant(shown, q))) return false;
    }
    return true;
}

class Linking {
  public:
    Linking(const RawClip& raw, const MemoryClip& plain)
        : raw_(raw), plain_(plain), shape_(plain.shape()) {}

    std::unique_ptr<MemoryClip> run() {
        (void)sink_.begin(shape_, 0);
        add({0, 0}, {{0, 0}});
        (void)sink_.finish();
        return sink_.take();
    }

  private:
    [[nodiscard]] LinkedNode linked(int level, Ref ref) const {
        return path_[static_cast<std::size_t>(time_level_of(ref))]
            .layers[static_cast<std::size_t>(level - kBrickLevel)]
            .nodes[index_of(ref)];
    }

    // A node of the linked clip with the content of `node`; `above` is the time-parent's
    // plain node at the same place and `link` its linked one, where there are.
    Ref tree(const PlainNode& node,
             const std::optional<PlainNode>& above,
             std::optional<Ref> link) {
        if (link && same_tree(node, *above)) return *link;
        Layer& layer = path_.back().layers[static_cast<std::size_t>(node.level - 3)];
        LinkedNode made;
        if (link && node.brick() == above->brick()) {
            made.brick = linked(node.level, *link).brick;
        } else {
            made.brick = make_ref(path_.back().address.time_level,
                                  static_cast<std::uint32_t>(layer.bricks.size()));
            layer.bricks.push_back(node.brick());
        }
        for (std::size_t q = 0; q < 4; ++q) {
            const auto below = node.child(q);
            if (!below || flat(*below, doubled_quadrant(node.brick(), q))) continue;
            std::optional<Ref> child_link;
            if (link && linked(node.level, *link).child[q] != kNoDetailRef) {
                child_link = linked(node.level, *link).child[q];
            }
            made.child[q] = tree(*below, above ? above->child(q) : above, child_link);
        }
        layer.nodes.push_back(made);
        return make_ref(path_.back().address.time_level,
                        static_cast<std::uint32_t>(layer.nodes.size() - 1));
    }

    [[nodiscard]] bool still(const NodeAddress& at) const {
        const FrameRange range = shape_.frames_of(at);
        const auto first = raw_.frames.begin() + range.first;
        return std::all_of(first, raw_.frames.begin() + range.end, [&](const Picture& p) {
            return p == *first;
        });
    }

    void add(const SiblingAddress& address, const std::vector<NodeAddress>& nodes) {
        Siblings& siblings = path_.emplace_back();
        siblings.address = address;
        siblings.layers.resize(
            static_cast<std::size_t>(std::max(shape_.space_levels(), 3) - 2));
        for (const NodeAddress& at : nodes) {
            const auto half = static_cast<std::size_t>(siblings.nodes.count++);
            const Frame frame = *plain_.frame(at, shape_.space_levels());
            TimeNode& made = siblings.nodes.node[half];
            made = frame.time_node();
            if (shape_.space_levels() < kBrickLevel) {
                made.root = {kNoDetailRef, kNoDetailRef};
                continue;
            }
            std::optional<Frame> parent;
            const NodeAddress up{at.time_level - 1, at.index / 2};
            if (at.time_level > 0) parent = *plain_.frame(up, shape_.space_levels());
            for (std::size_t e = 0; e < kEdges; ++e) {
                const auto edge = static_cast<Edge>(e);
                std::optional<PlainNode> above;
                std::optional<Ref> link;
                if (parent) {
                    above = PlainNode{&*parent, kBrickLevel, parent->root(edge)};
                    link = path_[path_.size() - 2]
                               .nodes
                               .node[up.time_level == 0
                                         ? 0
                                         : static_cast<std::size_t>(up.index & 1)]
                               .root[e];
                }
                made.root[e] =
                    tree(PlainNode{&frame, kBrickLevel, frame.root(edge)}, above, link);
            }
        }
        (void)sink_.add(siblings);
        for (const NodeAddress& at : nodes) {
            if (at.time_level == shape_.time_levels() || still(at)) continue;
            std::vector<NodeAddress> halves = {{at.time_level + 1, 2 * at.index}};
            const NodeAddress second{at.time_level + 1, 2 * at.index + 1};
            if (shape_.contains(second)) halves.push_back(second);
            add({at.time_level + 1, at.index}, halves);
        }
        path_.pop_back();
    }

    const RawClip& raw_;
    const MemoryClip& plain_;
    ClipShape shape_;
    MemoryClip::Sink sink_;
    std::vector<Siblings> path_;
};

}  // namespace

std::unique_ptr<MemoryClip> linked_clip(const RawClip& clip) {
    const std::unique_ptr<MemoryClip> plain = plain_clip(clip);
    return Linking(clip, *plain).run();
}

RawClip moving_clip(int width, int height, int frames, std::uint32_t seed) {
    std::mt19937 random(seed);
    const Picture still = random_clip(width, height, 1, seed).frames.front();
    RawClip clip;
    clip.format = {width, height, {25, 1}};
    int x = 0, y = 0;
    for (int t = 0; t < frames; ++t) {
        Picture frame(width, height);
        for (int v = 0; v < height; ++v) {
            for (int u = 0; u < width; ++u) {
                const bool textured = 2 * u < width && 2 * v < height;
                const bool clear = 2 * u >= width && 2 * v >= height;
                frame.at(u, v) = textured ? still.at(u, v)
                                 : clear  ? kClear
                                          : Rgba{10, 200, 30, 255};
            }
        }
        if (random() % 3 != 0) {
            x = static_cast<int>(random() % static_cast<unsigned>(width));
            y = static_cast<int>(random() % static_cast<unsigned>(height));
        }
        for (int v = y; v < std::min(y + (height + 7) / 8, height); ++v) {
            for (int u = x; u < std::min(x + (width + 7) / 8, width); ++u) {
                frame.at(u, v) = {250, static_cast<std::uint8_t>(16 * (u - x)), 0, 200};
            }
        }
        clip.frames.push_back(std::move(frame));
    }
    return clip;
}

}  // namespace haarmony::video::testing
