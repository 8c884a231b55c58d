#include "tests/eval/video_bound.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <memory>

#include "engine/video/display.h"
#include "tests/eval/video_sizes.h"

namespace haarmony::eval {
namespace {

constexpr std::array<video::Edge, video::kEdges> kBothEdges = {video::Edge::kPad,
                                                               video::Edge::kNormalize};

std::uint32_t largest_of(const video::Picture& a, const video::Picture& b) {
    std::uint32_t largest = 0;
    for (std::size_t p = 0; p < a.pixels.size(); ++p) {
        if (a.pixels[p] == b.pixels[p]) continue;
        largest = std::max(largest, video::difference(a.pixels[p], b.pixels[p]));
    }
    return largest;
}

double grey_levels(std::uint32_t difference) {
    return static_cast<double>(difference) / video::kDifferenceOne;
}

Result<void> compare_with_source(const VideoClip& clip, const video::TimeTree& built) {
    const video::ClipShape& shape = built.shape();
    for (std::size_t i = 0; i < clip.frames.size(); ++i) {
        const auto frame = built.frame(
            {shape.time_levels(), static_cast<std::int64_t>(i)}, shape.space_levels());
        if (!frame) return frame.error();
        const video::Picture shown =
            video::draw(*frame, shape.space_levels(), video::Edge::kPad);
        if (shown != clip.frames[i]) {
            return Error{ErrorCode::kConflict,
                         clip.name + ": frame " + std::to_string(i) +
                             " built at delta 0 is not its source"};
        }
    }
    return {};
}

}  // namespace

Result<std::uint32_t> largest_difference(const video::TimeTree& a,
                                         const video::TimeTree& b,
                                         int first_time_level,
                                         int end_time_level) {
    const video::ClipShape& shape = a.shape();
    assert(shape == b.shape() && end_time_level <= shape.time_levels() + 1);
    std::uint32_t largest = 0;
    for (int k = first_time_level; k < end_time_level; ++k) {
        for (std::int64_t i = 0; i < shape.nodes_at(k); ++i) {
            const auto frame_a = a.frame({k, i}, shape.space_levels());
            if (!frame_a) return frame_a.error();
            const auto frame_b = b.frame({k, i}, shape.space_levels());
            if (!frame_b) return frame_b.error();
            for (int level = 0; level <= shape.space_levels(); ++level) {
                for (const video::Edge edge : kBothEdges) {
                    largest = std::max(largest,
                                       largest_of(video::draw(*frame_a, level, edge),
                                                  video::draw(*frame_b, level, edge)));
                }
            }
        }
    }
    return largest;
}

Result<std::vector<VideoBound>> measure_video_bounds(const VideoClip& clip,
                                                     std::span<const int> deltas) {
    assert(!clip.frames.empty());
    const auto exact = built_in_memory(clip, 0);
    if (!exact) return exact.error();
    const auto same = compare_with_source(clip, **exact);
    if (!same) return same.error();
    const int finest = (*exact)->shape().time_levels();
    std::vector<VideoBound> bounds;
    for (const int delta : deltas) {
        assert(delta >= 1);
        const auto lossy = built_in_memory(
            clip, static_cast<std::uint32_t>(delta) * video::kDifferenceOne);
        if (!lossy) return lossy.error();
        const auto leaf = largest_difference(**exact, **lossy, finest, finest + 1);
        if (!leaf) return leaf.error();
        const auto coarse = largest_difference(**exact, **lossy, 0, finest);
        if (!coarse) return coarse.error();
        bounds.push_back({clip.name,
                          delta,
                          grey_levels(*leaf),
                          grey_levels(*coarse),
                          static_cast<double>((*lossy)->memory_bytes()) /
                              static_cast<double>(clip.raw_bytes())});
    }
    return bounds;
}

}  // namespace haarmony::eval
