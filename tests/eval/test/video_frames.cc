#include "tests/eval/test/video_frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <random>
#include <span>

#include "ingest/animated_png.h"

namespace haarmony::eval {

VideoClip noisy_clip(std::int32_t width, std::int32_t height, int frames, bool opaque) {
    std::mt19937 random(5);
    VideoClip clip{"noisy", VideoKind::kNatural, {width, height, {25, 1}}, {}};
    for (int t = 0; t < frames; ++t) {
        video::Picture& frame = clip.frames.emplace_back(width, height);
        for (std::int32_t y = 0; y < height; ++y) {
            for (std::int32_t x = 0; x < width; ++x) {
                const auto bits = static_cast<std::uint32_t>(random());
                const auto shade = [&](int slope, int shift) {
                    return static_cast<std::uint8_t>((slope * (x + 2 * t) + 3 * y) % 200 +
                                                     (bits >> shift & 15U));
                };
                const auto alpha =
                    opaque ? std::uint8_t{255} : static_cast<std::uint8_t>(bits >> 24U);
                frame.at(x, y) =
                    video::canonical({shade(2, 0), shade(3, 4), shade(5, 8), alpha});
            }
        }
    }
    return clip;
}

int largest_step(const video::Picture& a, const video::Picture& b) {
    int largest = 0;
    for (std::size_t p = 0; p < a.pixels.size(); ++p) {
        const video::Rgba& x = a.pixels[p];
        const video::Rgba& y = b.pixels[p];
        largest = std::max(
            {largest, std::abs(x.r - y.r), std::abs(x.g - y.g), std::abs(x.b - y.b)});
    }
    return largest;
}

std::string apng_of(const VideoClip& clip) {
    std::string bytes;
    ingest::VideoSinkOptions options;
    options.container = ingest::Container::kApng;
    options.format = clip.format;
    options.frames = static_cast<std::int64_t>(clip.frames.size());
    auto sink = ingest::open_animated_png(
        options, [&](std::span<const std::uint8_t> part) -> Result<void> {
            bytes.append(part.begin(), part.end());
            return {};
        });
    EXPECT_TRUE(sink.has_value());
    for (const video::Picture& frame : clip.frames) {
        EXPECT_TRUE((*sink)->add(frame.view()).has_value());
    }
    EXPECT_TRUE((*sink)->finish().has_value());
    return bytes;
}

void write_file(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace haarmony::eval
