// Two pixels or pictures mixed: between space levels, and between frames.
//   pixel.h -> [mix.h] -> display.h (zoom), playback.h, panorama.h
//
// Units   a weight of 2^bits is all of the first, 0 all of the second.
// Scale   mixed premultiplied, each channel rounded once, half up: mean() of the weights.
// Errors  none; a wrong argument is a caller's bug and asserts.
// Source  sec. 5.3.2, "Fractional-level zoom"; golden conventions (fzoom).
#pragma once

#include <array>
#include <cassert>
#include <cstdint>

#include "engine/video/picture.h"
#include "engine/video/pixel.h"

namespace haarmony::video {

// Requires: 1 <= bits <= 20, weight <= 2^bits.
[[nodiscard]] inline Rgba mixed(Rgba p, Rgba q, std::uint32_t weight, int bits) {
    assert(bits >= 1 && bits <= 20 && weight <= std::uint32_t{1} << bits);
    if (p == q) return p;
    const std::uint32_t rest = (std::uint32_t{1} << bits) - weight;
    if (p.a == 255 && q.a == 255) {  // mean() without a division
        const auto channel = [=](std::uint32_t a, std::uint32_t b) {
            const std::uint32_t sum = a * weight + b * rest;
            return static_cast<std::uint8_t>((sum + (1U << (bits - 1))) >> bits);
        };
        return {channel(p.r, q.r), channel(p.g, q.g), channel(p.b, q.b), 255};
    }
    PixelSum sum = sum_of(p, weight);
    sum += sum_of(q, rest);
    return mean(sum, std::uint64_t{1} << bits);
}

// Where a coordinate lies between two neighbours: `weight` of the first, in 1 / 2^kWayBits.
struct Between {
    std::int32_t first = 0;
    std::int32_t second = 0;
    std::uint32_t weight = 0;
};
inline constexpr int kWayBits = 16;

// Four neighbours, bilinearly: pixels[0], [1] above, [2], [3] below.
[[nodiscard]] Rgba mixed(const std::array<Rgba, 4>& pixels,
                         std::uint32_t weight_left,
                         std::uint32_t weight_above);

// Requires: pictures of one size.
[[nodiscard]] Picture mixed(const Picture& first,
                            const Picture& second,
                            std::uint32_t weight,
                            int bits);

}  // namespace haarmony::video
