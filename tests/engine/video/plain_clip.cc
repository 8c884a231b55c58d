#include "tests/engine/video/plain_clip.h"

#include <algorithm>
#include <cassert>
#include <random>
#include <utility>

namespace haarmony::video::testing {
namespace {

// The whole root square of a time node at a level, which may be finer than the clip's.
Picture root_square(const RawClip& clip, const FrameRange& range, int level, Edge edge) {
    const int finest = std::max(shape_of(clip).space_levels(), kBrickLevel);
    const int scale = finest - shape_of(clip).space_levels();
    const int block = 1 << (finest - level);
    Picture square(1 << level, 1 << level);
    for (int y = 0; y < square.height; ++y) {
        for (int x = 0; x < square.width; ++x) {
            std::uint64_t r = 0, g = 0, b = 0, a = 0, inside = 0;
            for (std::int64_t t = range.first; t < range.end; ++t) {
                const Picture& frame = clip.frames[static_cast<std::size_t>(t)];
                for (int v = y * block; v < (y + 1) * block; ++v) {
                    for (int u = x * block; u < (x + 1) * block; ++u) {
                        if ((u >> scale) >= frame.width || (v >> scale) >= frame.height) {
                            continue;
                        }
                        const Rgba p = frame.at(u >> scale, v >> scale);
                        r += std::uint64_t{p.r} * p.a;
                        g += std::uint64_t{p.g} * p.a;
                        b += std::uint64_t{p.b} * p.a;
                        a += p.a;
                        ++inside;
                    }
                }
            }
            const std::uint64_t all = static_cast<std::uint64_t>(range.count()) *
                                      static_cast<std::uint64_t>(block) *
                                      static_cast<std::uint64_t>(block);
            const std::uint64_t n = edge == Edge::kPad ? all : inside;
            const std::uint64_t alpha = n == 0 ? 0 : (2 * a + n) / (2 * n);
            if (alpha == 0) continue;
            square.at(x, y) = {static_cast<std::uint8_t>((2 * r + a) / (2 * a)),
                               static_cast<std::uint8_t>((2 * g + a) / (2 * a)),
                               static_cast<std::uint8_t>((2 * b + a) / (2 * a)),
                               static_cast<std::uint8_t>(alpha)};
        }
    }
    return square;
}

// Appends the complete tree of one edge rule to the siblings' layers; returns its root.
Ref add_tree(const RawClip& clip,
             const FrameRange& range,
             Edge edge,
             int time_level,
             std::vector<Layer>& layers) {
    std::vector<std::uint32_t> begin;
    for (const Layer& layer : layers) {
        begin.push_back(static_cast<std::uint32_t>(layer.nodes.size()));
    }
    for (std::size_t depth = 0; depth < layers.size(); ++depth) {
        const int level = kBrickLevel + static_cast<int>(depth);
        const Picture square = root_square(clip, range, level, edge);
        const std::uint32_t side = 1U << depth;
        for (std::uint32_t by = 0; by < side; ++by) {
            for (std::uint32_t bx = 0; bx < side; ++bx) {
                Brick brick;
                for (int i = 0; i < kBrickPixels; ++i) {
                    brick[static_cast<std::size_t>(i)] =
                        square.at(static_cast<int>(bx) * kBrickSide + i % kBrickSide,
                                  static_cast<int>(by) * kBrickSide + i / kBrickSide);
                }
                layers[depth].bricks.push_back(brick);
                LinkedNode node;
                node.brick =
                    make_ref(time_level,
                             static_cast<std::uint32_t>(layers[depth].bricks.size() - 1));
                for (std::uint32_t q = 0; q < 4 && depth + 1 < layers.size(); ++q) {
                    const std::uint32_t x = 2 * bx + (q & 1), y = 2 * by + (q >> 1);
                    node.child[q] =
                        make_ref(time_level, begin[depth + 1] + y * 2 * side + x);
                }
                layers[depth].nodes.push_back(node);
            }
        }
    }
    return make_ref(time_level, begin[0]);
}

Bounds bounds_of(const RawClip& clip, const FrameRange& range) {
    Bounds bounds;
    for (std::int64_t t = range.first; t < range.end; ++t) {
        const Picture& frame = clip.frames[static_cast<std::size_t>(t)];
        for (int y = 0; y < frame.height; ++y) {
            for (int x = 0; x < frame.width; ++x) {
                if (frame.at(x, y).a == 0) continue;
                if (bounds.empty()) bounds = {x, y, x + 1, y + 1};
                bounds.left = std::min(bounds.left, x);
                bounds.top = std::min(bounds.top, y);
                bounds.right = std::max(bounds.right, x + 1);
                bounds.bottom = std::max(bounds.bottom, y + 1);
            }
        }
    }
    return bounds;
}

TimeNode add_node(const RawClip& clip,
                  const NodeAddress& at,
                  std::vector<Layer>& layers) {
    const FrameRange range = shape_of(clip).frames_of(at);
    TimeNode node;
    node.bounds = bounds_of(clip, range);
    for (const Edge edge : {Edge::kPad, Edge::kNormalize}) {
        const auto e = static_cast<std::size_t>(edge);
        node.root[e] = add_tree(clip, range, edge, at.time_level, layers);
        for (int level = 0; level < kBrickLevel; ++level) {
            const Picture square = root_square(clip, range, level, edge);
            std::copy(square.pixels.begin(),
                      square.pixels.end(),
                      node.apex[e].begin() + apex_offset(level));
        }
    }
    return node;
}

}  // namespace

ClipShape shape_of(const RawClip& clip) {
    return *ClipShape::make(clip.format, static_cast<std::int64_t>(clip.frames.size()));
}

Picture exact_picture(const RawClip& clip, const NodeAddress& at, int level, Edge edge) {
    const ClipShape shape = shape_of(clip);
    const Picture square = root_square(clip, shape.frames_of(at), level, edge);
    Picture cropped(shape.width_at(level), shape.height_at(level));
    for (int y = 0; y < cropped.height; ++y) {
        for (int x = 0; x < cropped.width; ++x) {
            cropped.at(x, y) = square.at(x, y);
        }
    }
    return cropped;
}

std::unique_ptr<MemoryClip> plain_clip(const RawClip& clip) {
    const ClipShape shape = shape_of(clip);
    const auto levels = static_cast<std::size_t>(
        std::max(shape.space_levels(), kBrickLevel) - kBrickLevel + 1);
    MemoryClip::Sink sink;
    (void)sink.begin(shape, 0);
    for (int k = 0; k <= shape.time_levels(); ++k) {
        const std::int64_t groups = k == 0 ? 1 : shape.nodes_at(k - 1);
        for (std::int64_t group = 0; group < groups; ++group) {
            Siblings siblings;
            siblings.address = {k, group};
            siblings.layers.resize(levels);
            const std::int64_t first = k == 0 ? 0 : 2 * group;
            const std::int64_t end =
                std::min(first + (k == 0 ? 1 : 2), shape.nodes_at(k));
            for (std::int64_t i = first; i < end; ++i) {
                siblings.nodes.node[static_cast<std::size_t>(i - first)] =
                    add_node(clip, {k, i}, siblings.layers);
                ++siblings.nodes.count;
            }
            (void)sink.add(std::move(siblings));
        }
    }
    (void)sink.finish();
    return sink.take();
}

RawClip random_clip(int width,
                    int height,
                    int frames,
                    std::uint32_t seed,
                    bool coherent) {
    std::mt19937 random(seed);
    const auto pixel = [&random] {
        const auto bits = static_cast<std::uint32_t>(random());
        const auto kind = random() % 4;
        const auto alpha = static_cast<std::uint8_t>(kind == 0   ? 0
                                                     : kind == 1 ? bits >> 24
                                                                 : 255);
        return canonical({static_cast<std::uint8_t>(bits),
                          static_cast<std::uint8_t>(bits >> 8),
                          static_cast<std::uint8_t>(bits >> 16),
                          alpha});
    };
    RawClip clip;
    clip.format = {width, height, {25, 1}};
    for (int t = 0; t < frames; ++t) {
        Picture frame = coherent && t > 0 ? clip.frames.back() : Picture(width, height);
        const bool corner = coherent && t > 0;
        for (int y = 0; y < (corner ? (height + 3) / 4 : height); ++y) {
            for (int x = 0; x < (corner ? (width + 3) / 4 : width); ++x)
                frame.at(x, y) = pixel();
        }
        clip.frames.push_back(std::move(frame));
    }
    return clip;
}

}  // namespace haarmony::video::testing
