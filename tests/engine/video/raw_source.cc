#include "tests/engine/video/raw_source.h"

#include <algorithm>

namespace haarmony::video::testing {
namespace {

std::uint32_t add_square(const Picture& picture,
                         int scale,
                         int levels_below,
                         int x,
                         int y,
                         ImageTree& tree) {
    const auto index = static_cast<std::uint32_t>(tree.nodes.size());
    tree.nodes.emplace_back();
    if (levels_below > 0) {
        for (int q = 0; q < 4; ++q) {
            const std::uint32_t child = add_square(picture,
                                                   scale,
                                                   levels_below - 1,
                                                   2 * x + (q & 1),
                                                   2 * y + (q >> 1),
                                                   tree);
            tree.nodes[index].child[static_cast<std::size_t>(q)] = child;
        }
        return index;
    }
    tree.nodes[index].brick = static_cast<std::uint32_t>(tree.bricks.size());
    Brick& brick = tree.bricks.emplace_back();
    for (int i = 0; i < kBrickPixels; ++i) {
        const int u = (x * kBrickSide + i % kBrickSide) >> scale;
        const int v = (y * kBrickSide + i / kBrickSide) >> scale;
        if (u >= picture.width || v >= picture.height) continue;
        brick[static_cast<std::size_t>(i)] = picture.at(u, v);
    }
    return index;
}

}  // namespace

ImageTree complete_tree(const Picture& picture, const FrameFormat& format) {
    const int levels = (*ClipShape::make(format, 1)).space_levels();
    const int scale = std::max(0, kBrickLevel - levels);
    ImageTree tree;
    tree.root = add_square(picture, scale, std::max(0, levels - kBrickLevel), 0, 0, tree);
    return tree;
}

Result<bool> RawSource::next(SourceFrame& frame) {
    const std::int64_t call = calls_++;
    if (call == fail_at_) {
        return Error{ErrorCode::kUndecodable, "frame " + std::to_string(call)};
    }
    const auto t = static_cast<std::size_t>(call);
    if (t >= clip_.frames.size()) return false;
    frame.tree = complete_tree(clip_.frames[t], clip_.format);
    frame.repeats = repeats_.empty() ? 1 : repeats_[t];
    return true;
}

}  // namespace haarmony::video::testing
