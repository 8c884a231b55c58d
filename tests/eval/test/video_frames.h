// Small clips for the tests of video's measures: fixed, and with detail everywhere.
#pragma once

#include <cstdint>
#include <string>

#include "tests/eval/video_clips.h"

namespace haarmony::eval {

// Noise of its own in every frame, on a ramp that moves. Opaque, or with any alpha.
[[nodiscard]] VideoClip noisy_clip(std::int32_t width,
                                   std::int32_t height,
                                   int frames,
                                   bool opaque = true);

// The largest difference of a channel, alpha left out.
[[nodiscard]] int largest_step(const video::Picture& a, const video::Picture& b);

// The bytes of an animated PNG of the clip. Fails the test where it cannot be written.
[[nodiscard]] std::string apng_of(const VideoClip& clip);

void write_file(const std::string& path, const std::string& bytes);

}  // namespace haarmony::eval
