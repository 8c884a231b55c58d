// The examples of the dissertation's Figures 5.13 to 5.18, ours: sources of frames by
// name.
//   [generator.h] -> build.h
//
// Each is a function of its parameters: the same on every run, of any size, and as deep
// as there is detail. Known are julia, galaxy, fluid, wind, room and panorama.
//
// Errors   kInvalidArgument: param generate (no such name; the message lists all), width,
//          height, frames, rate, or depth.
// Source   sec. 5.5.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "engine/core/result.h"
#include "engine/video/clip_shape.h"
#include "engine/video/frame_source.h"

namespace haarmony::video {

inline constexpr std::array<std::string_view, 6> kGeneratorNames =
    {"julia", "galaxy", "fluid", "wind", "room", "panorama"};
inline constexpr std::int32_t kMinGeneratedSide = 16;
inline constexpr std::int64_t kMaxGeneratedFrames = 1 << 16;

struct GeneratorParameters {
    std::int32_t width = 0;  // 0: as the generator likes it, or as the other side demands
    std::int32_t height = 0;
    std::int64_t frames = 0;        // 0: as the generator likes it
    std::optional<int> depth = {};  // finest space level painted, 3 .. space levels
    FrameRate rate = {};
    std::uint32_t seed = 1;
};

[[nodiscard]] Result<std::unique_ptr<FrameSource>> make_generator(
    std::string_view name,
    const GeneratorParameters& parameters);

}  // namespace haarmony::video
