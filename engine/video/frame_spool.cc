#include "engine/video/frame_spool.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <type_traits>

namespace haarmony::video {
namespace {

struct Head {
    std::uint64_t nodes = 0;
    std::uint64_t bricks = 0;
    std::array<std::uint32_t, kEdges> root{};
    std::array<Apex, kEdges> apex{};
    Bounds bounds;
};
// No padding: every byte of the spool is determined by the frame.
static_assert(std::has_unique_object_representations_v<Head>);
static_assert(std::has_unique_object_representations_v<TreeNode>);
static_assert(std::has_unique_object_representations_v<Brick>);

std::uint64_t checksum_of(const std::vector<std::byte>& bytes) {
    constexpr std::uint64_t kOdd = 0x9E37'79B9'7F4A'7C15;
    constexpr std::size_t kLanes = 4;
    constexpr std::size_t kWord = sizeof(std::uint64_t);
    std::array<std::uint64_t, kLanes> lane = {1, 2, 3, 4};
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

}  // namespace

Result<SpooledFrame> FrameSpool::put(const ExactFrame& frame) {
    const Head head{
        frame.nodes.size(), frame.bricks.size(), frame.root, frame.apex, frame.bounds};
    const std::size_t node_bytes = frame.nodes.size() * sizeof(TreeNode);
    const std::size_t brick_bytes = frame.bricks.size() * sizeof(Brick);
    bytes_.resize(sizeof(Head) + node_bytes + brick_bytes);
    std::memcpy(bytes_.data(), &head, sizeof(Head));
    std::memcpy(bytes_.data() + sizeof(Head), frame.nodes.data(), node_bytes);
    std::memcpy(
        bytes_.data() + sizeof(Head) + node_bytes, frame.bricks.data(), brick_bytes);
    const Result<std::uint64_t> offset = spool_.append(bytes_);
    if (!offset) return offset.error();
    return SpooledFrame{*offset, bytes_.size(), checksum_of(bytes_)};
}

Result<void> FrameSpool::get(const SpooledFrame& from, ExactFrame& frame) {
    bytes_.resize(static_cast<std::size_t>(from.bytes));
    Result<void> read = spool_.read(from.offset, bytes_);
    if (!read) return read;
    if (checksum_of(bytes_) != from.checksum) {
        return Error{ErrorCode::kIo,
                     "the spool has changed at offset " + std::to_string(from.offset)};
    }
    Head head;
    std::memcpy(&head, bytes_.data(), sizeof(Head));
    frame.nodes.resize(static_cast<std::size_t>(head.nodes));
    frame.bricks.resize(static_cast<std::size_t>(head.bricks));
    frame.root = head.root;
    frame.apex = head.apex;
    frame.bounds = head.bounds;
    const std::size_t node_bytes = frame.nodes.size() * sizeof(TreeNode);
    std::memcpy(frame.nodes.data(), bytes_.data() + sizeof(Head), node_bytes);
    std::memcpy(frame.bricks.data(),
                bytes_.data() + sizeof(Head) + node_bytes,
                frame.bricks.size() * sizeof(Brick));
    return {};
}

}  // namespace haarmony::video
