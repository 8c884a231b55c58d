// The time nodes of two siblings as the bytes of one chunk: roots, bounds, and the three
// coarsest space levels.
//   ref_coder.h -> [time_node_coder.h] -> mrv_writer.h, mrv_clip.h
//
// Shape    MRV.md, "Time nodes".
// Errors   decoding: kUndecodable; roots lie within their layers, bounds within the picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/video/layer.h"

namespace haarmony::video {

// What two siblings are known by before their chunk is read.
struct TimeNodeSurroundings {
    ClipShape shape;
    SiblingAddress address;
    const TimeNode* time_parent = nullptr;  // null at the root of the time tree
    // Nodes of space level 3, by time level up to the siblings'.
    std::vector<std::uint32_t> root_nodes;
};

// One or two: the second half is absent where no frames are left.
[[nodiscard]] int sibling_count(const ClipShape& shape, const SiblingAddress& address);

[[nodiscard]] std::vector<std::byte> encode_time_nodes(
    const SiblingNodes& nodes,
    const TimeNodeSurroundings& surroundings);
[[nodiscard]] Result<void> decode_time_nodes(std::span<const std::byte> chunk,
                                             const TimeNodeSurroundings& surroundings,
                                             SiblingNodes& nodes);

}  // namespace haarmony::video
