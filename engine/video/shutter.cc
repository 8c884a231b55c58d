#include "engine/video/shutter.h"

#include <cassert>
#include <cstddef>
#include <utility>

namespace haarmony::video {
namespace {

// `picture_of` draws one frame of the range.
template <typename PictureOf>
Result<Picture> average(const TimeTree& clip,
                        const FrameRange& range,
                        int space_level,
                        const PictureOf& picture_of) {
    const std::vector<NodeAddress> nodes = covering_nodes(clip.shape(), range);
    std::vector<PixelSum> sums;
    Picture picture;
    for (const NodeAddress& node : nodes) {
        Result<Frame> frame = clip.frame(node, space_level);
        if (!frame) return std::move(frame).error();
        picture = picture_of(*frame);
        if (nodes.size() == 1) return picture;
        sums.resize(picture.pixels.size());
        const auto weight =
            static_cast<std::uint64_t>(clip.shape().frames_of(node).count());
        for (std::size_t i = 0; i < sums.size(); ++i) {
            sums[i] += sum_of(picture.pixels[i], weight);
        }
    }
    const auto weight = static_cast<std::uint64_t>(range.count());
    for (std::size_t i = 0; i < sums.size(); ++i)
        picture.pixels[i] = mean(sums[i], weight);
    return picture;
}

}  // namespace

NodeAddress half_blur(const TimeTree& clip, const NodeAddress& at) {
    assert(clip.shape().contains(at));
    if (at.time_level == clip.shape().time_levels()) return at;
    return {at.time_level + 1, 2 * at.index};
}

std::vector<NodeAddress> covering_nodes(const ClipShape& shape, const FrameRange& range) {
    assert(0 <= range.first && range.first < range.end && range.end <= shape.frames());
    std::vector<NodeAddress> nodes;
    std::int64_t first = range.first;
    while (first < range.end) {
        NodeAddress node{shape.time_levels(), first};
        while (node.time_level > 0 && (node.index & 1) == 0) {
            const NodeAddress parent{node.time_level - 1, node.index >> 1};
            if (shape.frames_of(parent).end > range.end) break;
            node = parent;
        }
        nodes.push_back(node);
        first = shape.frames_of(node).end;
    }
    return nodes;
}

Result<Picture> draw_shutter(const TimeTree& clip,
                             const FrameRange& range,
                             int level,
                             Edge edge,
                             const PixelBox& box) {
    return average(clip, range, level, [&](const Frame& frame) {
        return draw(frame, level, edge, box);
    });
}

Result<Picture> zoom_shutter(const TimeTree& clip,
                             const FrameRange& range,
                             std::int32_t root_side,
                             Edge edge,
                             const PixelBox& box,
                             Finer finer) {
    return average(
        clip, range, zoom_level(clip.shape(), root_side), [&](const Frame& frame) {
            return zoom(frame, root_side, edge, box, finer);
        });
}

}  // namespace haarmony::video
