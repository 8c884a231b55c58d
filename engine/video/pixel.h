// One pixel of a clip, the mean of many, and how different two are.
//   [pixel.h] -> brick.h -> image_tree.h -> time_tree.h
//
// Shape   red, green, blue, alpha, 8 bits each; straight (not premultiplied). Canonical: a
//         clear pixel (alpha 0) has no colour, so that equal looks are equal bytes.
// Errors  none; a wrong argument is a caller's bug and asserts.
// Source  sec. 5.2.1 and its footnote 1 [averages are premultiplied], sec. 5.3.1,
//         ColorDiff(); ERRATA of the project, video 12 [D*], 14, 15 [one rounding].
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>

namespace haarmony::video {

struct Rgba {
    std::uint8_t r = 0;
    std::uint8_t g = 0;
    std::uint8_t b = 0;
    std::uint8_t a = 0;

    friend bool operator==(const Rgba&, const Rgba&) = default;
};

inline constexpr Rgba kClear{};

[[nodiscard]] constexpr Rgba canonical(Rgba pixel) {
    return pixel.a == 0 ? kClear : pixel;
}

// Sums over samples: of colour times alpha, and of alpha. 64 bits hold 2^47 samples.
struct PixelSum {
    std::uint64_t r = 0;
    std::uint64_t g = 0;
    std::uint64_t b = 0;
    std::uint64_t a = 0;

    PixelSum& operator+=(const PixelSum& other) {
        r += other.r;
        g += other.g;
        b += other.b;
        a += other.a;
        return *this;
    }
    friend bool operator==(const PixelSum&, const PixelSum&) = default;
};

// What `samples` pixels of one colour add up to.
[[nodiscard]] constexpr PixelSum sum_of(Rgba pixel, std::uint64_t samples) {
    const std::uint64_t weight = samples * pixel.a;
    return {pixel.r * weight, pixel.g * weight, pixel.b * weight, weight};
}

// The mean of `samples` pixels, each channel rounded once, half up.
// Requires: samples >= 1, and no more alpha than `samples` opaque pixels have.
[[nodiscard]] constexpr Rgba mean(const PixelSum& sum, std::uint64_t samples) {
    assert(samples >= 1 && sum.a <= 255 * samples);
    const std::uint64_t alpha = (2 * sum.a + samples) / (2 * samples);
    if (alpha == 0) return kClear;
    const auto channel = [&sum](std::uint64_t total) {
        return static_cast<std::uint8_t>((2 * total + sum.a) / (2 * sum.a));
    };
    return {
        channel(sum.r), channel(sum.g), channel(sum.b), static_cast<std::uint8_t>(alpha)};
}

// One level of one channel's worth of difference(): the unit of `delta`.
inline constexpr std::uint32_t kDifferenceOne = 255'000;

// D*: the largest luminance-weighted difference of the two pixels over a black and over a
// white background, in 1/255,000 of a grey level. Zero exactly where the pixels look the same
// over everything.
[[nodiscard]] constexpr std::uint32_t difference(Rgba p, Rgba q) {
    const int alpha = 255 * (p.a - q.a);
    const int r = p.r * p.a - q.r * q.a;
    const int g = p.g * p.a - q.g * q.a;
    const int b = p.b * p.a - q.b * q.a;
    const auto weighted = [r, g, b](int lighter) {
        const auto magnitude = [lighter](int channel) {
            return static_cast<std::uint32_t>(channel < lighter ? lighter - channel
                                                                : channel - lighter);
        };
        return 299 * magnitude(r) + 587 * magnitude(g) + 114 * magnitude(b);
    };
    return std::max(weighted(0), weighted(alpha));
}

}  // namespace haarmony::video
