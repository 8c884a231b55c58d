#include "engine/video/frame_spool.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>

namespace haarmony::video {
namespace {

struct Head {
    std::uint64_t nodes = 0;
    std::uint64_t bricks = 0;
    std::uint64_t nodes_offset = 0;
    std::uint64_t bricks_offset = 0;
    std::uint64_t checksum = 0;  // of nodes and bricks
    std::array<std::uint32_t, kEdges> root{};
    std::array<Apex, kEdges> apex{};
    Bounds bounds;
};
// No padding: every byte of the spool is determined by the frame.
static_assert(std::has_unique_object_representations_v<Head>);
static_assert(std::has_unique_object_representations_v<TreeNode>);
static_assert(std::has_unique_object_representations_v<Brick>);

std::uint64_t checksum_of(std::span<const std::byte> bytes, std::uint64_t seed) {
    constexpr std::uint64_t kOdd = 0x9E37'79B9'7F4A'7C15;
    constexpr std::size_t kLanes = 4;
    constexpr std::size_t kWord = sizeof(std::uint64_t);
    std::array<std::uint64_t, kLanes> lane = {seed, 2, 3, 4};
    const auto mix = [&bytes](std::uint64_t& into, std::size_t at, std::size_t size) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + at, size);
        into = (into ^ word) * kOdd;
        into ^= into >> 32;
    };
    std::size_t at = 0;
    for (; at + kLanes * kWord <= bytes.size(); at += kLanes * kWord) {
        for (std::size_t k = 0; k < kLanes; ++k) mix(lane[k], at + k * kWord, kWord);
    }
    for (; at < bytes.size(); at += kWord) {
        mix(lane[0], at, std::min(kWord, bytes.size() - at));
    }
    std::uint64_t sum = bytes.size();
    for (const std::uint64_t value : lane) {
        sum = (sum ^ value) * kOdd;
        sum ^= sum >> 29;
    }
    return sum;
}

std::uint64_t checksum_of(const ExactFrame& frame) {
    return checksum_of(std::as_bytes(std::span(frame.bricks)),
                       checksum_of(std::as_bytes(std::span(frame.nodes)), 1));
}

std::uint64_t checksum_of(const Head& head) {
    return checksum_of(std::as_bytes(std::span(&head, 1)), 1);
}

}  // namespace

Result<SpooledFrame> FrameSpool::put(const ExactFrame& frame) {
    const Result<std::uint64_t> nodes =
        spool_.append(std::as_bytes(std::span(frame.nodes)));
    if (!nodes) return nodes.error();
    const Result<std::uint64_t> bricks =
        spool_.append(std::as_bytes(std::span(frame.bricks)));
    if (!bricks) return bricks.error();
    const Head head{frame.nodes.size(),
                    frame.bricks.size(),
                    *nodes,
                    *bricks,
                    checksum_of(frame),
                    frame.root,
                    frame.apex,
                    frame.bounds};
    const Result<std::uint64_t> at = spool_.append(std::as_bytes(std::span(&head, 1)));
    if (!at) return at.error();
    return SpooledFrame{*at, checksum_of(head)};
}

Result<void> FrameSpool::get(const SpooledFrame& from, ExactFrame& frame) {
    const Error changed{ErrorCode::kIo,
                        "the spool has changed at offset " + std::to_string(from.head)};
    Head head;
    Result<void> read =
        spool_.read(from.head, std::as_writable_bytes(std::span(&head, 1)));
    if (!read) return read;
    // The counts are believed, and memory taken for them, only after this.
    if (checksum_of(head) != from.checksum) return changed;
    frame.nodes.resize(static_cast<std::size_t>(head.nodes));
    frame.bricks.resize(static_cast<std::size_t>(head.bricks));
    frame.root = head.root;
    frame.apex = head.apex;
    frame.bounds = head.bounds;
    read = spool_.read(head.nodes_offset, std::as_writable_bytes(std::span(frame.nodes)));
    if (!read) return read;
    read =
        spool_.read(head.bricks_offset, std::as_writable_bytes(std::span(frame.bricks)));
    if (!read) return read;
    if (checksum_of(frame) != head.checksum) return changed;
    return {};
}

}  // namespace haarmony::video
