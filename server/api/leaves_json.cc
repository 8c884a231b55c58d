#include "server/api/leaves_json.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "engine/video/create_frame.h"
#include "server/api/points_json.h"
#include "server/app/leaf_frames.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

constexpr std::size_t kNumbers = 7;
constexpr int kDeepest = 16;  // log2 of the longest side that a clip may have
constexpr std::int64_t kMostRepeats = std::int64_t{1} << video::kMaxTimeLevels;

std::optional<std::int64_t> whole(const json& value) {
    if (!value.is_number_integer()) return {};
    if (value.is_number_unsigned() &&
        value.get<std::uint64_t>() > std::numeric_limits<std::int64_t>::max())
        return {};
    return value.get<std::int64_t>();
}

struct ReadFrame {
    std::vector<video::LeafSquare> leaves;
    std::int64_t repeats = 1;
};

Outcome<video::LeafSquare> read_leaf(const json& value, const std::string& place) {
    if (!value.is_array() || value.size() != kNumbers)
        return malformed(
            place + " " + shown_json(value) + " is not [level, x, y, r, g, b, a]", place);
    std::int64_t numbers[kNumbers];
    for (std::size_t i = 0; i < kNumbers; ++i) {
        const auto number = whole(value[i]);
        const std::string at = place + "[" + std::to_string(i) + "]";
        if (!number)
            return malformed(at + " " + shown_json(value[i]) + " is not a whole number",
                             at);
        const std::int64_t most = i == 0 ? kDeepest : i < 3 ? video::kMaxSide - 1 : 255;
        if (*number < 0 || *number > most)
            return impossible("out_of_range",
                              at + " '" + std::to_string(*number) +
                                  "' is not from 0 to " + std::to_string(most),
                              at);
        numbers[i] = *number;
    }
    const auto byte = [&](std::size_t i) {
        return static_cast<std::uint8_t>(numbers[i]);
    };
    video::LeafSquare leaf;
    leaf.level = static_cast<int>(numbers[0]);
    leaf.x = static_cast<std::int32_t>(numbers[1]);
    leaf.y = static_cast<std::int32_t>(numbers[2]);
    leaf.color = {byte(3), byte(4), byte(5), byte(6)};
    return leaf;
}

Outcome<ReadFrame> read_frame(const json& value, const std::string& place) {
    if (!value.is_object() || !value.contains("leaves") || !value["leaves"].is_array())
        return malformed(place + " has no list \"leaves\"", place);
    for (const auto& [name, member] : value.items())
        if (name != "leaves" && name != "repeats")
            return http::Problem{400,
                                 "unknown_parameter",
                                 "'" + name + "' is not known in " + place,
                                 place + "." + name,
                                 {}};
    ReadFrame frame;
    if (value.contains("repeats")) {
        const auto repeats = whole(value["repeats"]);
        if (!repeats || *repeats < 1 || *repeats > kMostRepeats)
            return malformed(place + ".repeats " + shown_json(value["repeats"]) +
                                 " is not a whole number from 1 to " +
                                 std::to_string(kMostRepeats),
                             place + ".repeats");
        frame.repeats = *repeats;
    }
    const json& leaves = value["leaves"];
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        auto leaf = read_leaf(leaves[i], place + ".leaves[" + std::to_string(i) + "]");
        if (!leaf) return leaf.problem();
        frame.leaves.push_back(*leaf);
    }
    return frame;
}

}  // namespace

Outcome<LeafFramesIn> read_leaf_frames(const json& frames, video::FrameFormat format) {
    if (!frames.is_array()) return malformed("frames is not a list", "frames");
    if (frames.empty()) return impossible("no_frames", "frames is empty", "frames");
    LeafFramesIn in;
    int deepest = 0;
    std::int64_t count = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        auto frame = read_frame(frames[i], "frames[" + std::to_string(i) + "]");
        if (!frame) return frame.problem();
        for (const video::LeafSquare& leaf : frame->leaves)
            deepest = std::max(deepest, leaf.level);
        count += frame->repeats;
        append_leaf_frame(frame->leaves, frame->repeats, in.bytes);
    }
    if (format.width == 0) format.width = 1 << deepest;
    if (format.height == 0) format.height = 1 << deepest;
    const auto shape = video::ClipShape::make(format, count);
    if (!shape) return impossible(shape.error());
    LeafFrames source(in.bytes, format);
    video::SourceFrame made;
    for (std::size_t i = 0; i < frames.size(); ++i)
        if (const auto next = source.next(made); !next) return impossible(next.error());
    in.format = format;
    return in;
}

}  // namespace haarmony::server
