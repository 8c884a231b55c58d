#include "server/app/leaf_frames.h"

#include <string>

namespace haarmony::server {
namespace {

constexpr std::size_t kHeadBytes = 12;
constexpr std::size_t kLeafBytes = 16;

template <typename Number>
void put(Number number, std::vector<std::byte>& bytes) {
    for (std::size_t i = 0; i < sizeof number; ++i)
        bytes.push_back(static_cast<std::byte>(number >> (8 * i) & 0xFF));
}

template <typename Number>
Number take(std::span<const std::byte>& bytes) {
    Number number = 0;
    for (std::size_t i = 0; i < sizeof number; ++i)
        number = static_cast<Number>(number | std::to_integer<std::uint64_t>(bytes[i])
                                                  << (8 * i));
    bytes = bytes.subspan(sizeof number);
    return number;
}

video::LeafSquare take_leaf(std::span<const std::byte>& bytes) {
    video::LeafSquare leaf;
    leaf.level = static_cast<std::int32_t>(take<std::uint32_t>(bytes));
    leaf.x = static_cast<std::int32_t>(take<std::uint32_t>(bytes));
    leaf.y = static_cast<std::int32_t>(take<std::uint32_t>(bytes));
    leaf.color.r = take<std::uint8_t>(bytes);
    leaf.color.g = take<std::uint8_t>(bytes);
    leaf.color.b = take<std::uint8_t>(bytes);
    leaf.color.a = take<std::uint8_t>(bytes);
    return leaf;
}

}  // namespace

void append_leaf_frame(std::span<const video::LeafSquare> leaves,
                       std::int64_t repeats,
                       std::vector<std::byte>& bytes) {
    put(static_cast<std::uint64_t>(repeats), bytes);
    put(static_cast<std::uint32_t>(leaves.size()), bytes);
    for (const video::LeafSquare& leaf : leaves) {
        put(static_cast<std::uint32_t>(leaf.level), bytes);
        put(static_cast<std::uint32_t>(leaf.x), bytes);
        put(static_cast<std::uint32_t>(leaf.y), bytes);
        for (const std::uint8_t channel :
             {leaf.color.r, leaf.color.g, leaf.color.b, leaf.color.a})
            put(channel, bytes);
    }
}

LeafFrames::LeafFrames(std::span<const std::byte> bytes, const video::FrameFormat& format)
    : bytes_(bytes), format_(format) {}

Result<bool> LeafFrames::next(video::SourceFrame& frame) {
    if (bytes_.empty()) return false;
    const std::string name = "frames[" + std::to_string(number_) + "]";
    const Error cut_off{ErrorCode::kIo, name + " of the input is cut off"};
    if (bytes_.size() < kHeadBytes) return cut_off;
    frame.repeats = static_cast<std::int64_t>(take<std::uint64_t>(bytes_));
    const std::size_t count = take<std::uint32_t>(bytes_);
    if (frame.repeats < 1 || bytes_.size() / kLeafBytes < count) return cut_off;
    leaves_.clear();
    for (std::size_t i = 0; i < count; ++i) leaves_.push_back(take_leaf(bytes_));
    if (const auto made = video::create_frame(leaves_, format_, frame.tree); !made)
        return Error{made.error().code, name + ": " + made.error().message, "frames"};
    ++number_;
    return true;
}

}  // namespace haarmony::server
