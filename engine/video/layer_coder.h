// A layer as the bytes of one chunk: nodes first, then bricks, each against what is known at
// its place.
//   layer_places.h, brick_coder.h -> [layer_coder.h] -> mrv_writer.h, mrv_clip.h
//
// Shape    MRV.md, "Chunks". Nodes and bricks keep their numbers.
// Errors   decoding: kUndecodable; every ref of a decoded layer lies within its layer.
//          Hostile bytes cost no more than kMostExpansion times their length for the layer,
//          and at most one and a half times that beside it while it is decoded.
// Source   sec. 5.5 [compressed without loss].
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/video/layer_places.h"

namespace haarmony::video {

// Bytes in memory for each byte of a chunk, at most.
inline constexpr std::uint64_t kMostExpansion = 1024;

struct LayerSize {
    std::uint32_t nodes = 0;
    std::uint32_t bricks = 0;

    // Decoded pixel by pixel. Layer::memory_bytes() is no more, but for 8 bytes for 32 bricks
    // where none of them is opaque.
    [[nodiscard]] std::uint64_t memory_bytes() const {
        return std::uint64_t{nodes} * sizeof(LinkedNode) +
               std::uint64_t{bricks} * sizeof(Brick);
    }
    [[nodiscard]] bool empty() const { return nodes == 0 && bricks == 0; }
    friend bool operator==(const LayerSize&, const LayerSize&) = default;
};

// The chunk of the layer that surroundings.layer(time level, space level) holds.
// Requires: the layer is not empty.
[[nodiscard]] std::vector<std::byte> encode_layer(const LayerSurroundings& surroundings);
// The layer into `layer`, whose place in `surroundings` is the last.
[[nodiscard]] Result<void> decode_layer(std::span<const std::byte> chunk,
                                        const LayerSize& size,
                                        const LayerSurroundings& surroundings,
                                        Layer& layer);

// A chunk begins with as many zeros as its expansion needs.
void put_padding(std::uint64_t memory_bytes, std::vector<std::byte>& chunk);
[[nodiscard]] Result<std::span<const std::byte>> without_padding(
    std::span<const std::byte> chunk,
    std::uint64_t memory_bytes);

}  // namespace haarmony::video
