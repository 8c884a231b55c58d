#include "engine/video/brick_match.h"

#include <array>
#include <bit>
#include <cstddef>

namespace haarmony::video {
namespace {

constexpr std::size_t kSide = kBrickSide;
constexpr std::size_t kHalf = kSide / 2;

// Where quadrant q of a brick begins.
constexpr std::size_t corner_of(int q) {
    const auto quadrant = static_cast<std::size_t>(q);
    return (quadrant >> 1) * kHalf * kSide + (quadrant & 1) * kHalf;
}

// difference() of equally opaque pixels is this times their alpha, and a third of the work.
std::uint32_t luminance_difference(Rgba p, Rgba q) {
    const auto magnitude = [](int difference) {
        return static_cast<std::uint32_t>(difference < 0 ? -difference : difference);
    };
    return 299 * magnitude(p.r - q.r) + 587 * magnitude(p.g - q.g) +
           114 * magnitude(p.b - q.b);
}

}  // namespace

bool within(const Brick& a, const Brick& b, std::uint32_t delta) {
    if (same_bytes(a, b)) return true;
    if (delta == 0) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const std::uint32_t distance = a[i].a == b[i].a
                                           ? a[i].a * luminance_difference(a[i], b[i])
                                           : difference(a[i], b[i]);
        if (distance > delta) return false;
    }
    return true;
}

std::uint64_t hash_of(const Brick& brick) {
    // Four lanes, because one would wait for its own multiplication at every word.
    constexpr std::uint64_t kOdd = 0x9E37'79B9'7F4A'7C15;
    constexpr std::size_t kLanes = 4;
    std::array<std::uint64_t, kLanes> lane = {1, 2, 3, 4};
    std::array<std::uint64_t, sizeof(Brick) / sizeof(std::uint64_t)> word;
    std::memcpy(word.data(), &brick, sizeof(Brick));
    for (std::size_t i = 0; i < word.size(); i += kLanes) {
        for (std::size_t k = 0; k < kLanes; ++k) {
            lane[k] = (lane[k] ^ word[i + k]) * kOdd;
            lane[k] ^= lane[k] >> 32;
        }
    }
    std::uint64_t hash = 0;
    for (const std::uint64_t value : lane) {
        hash = (hash ^ value) * kOdd;
        hash ^= hash >> 29;
    }
    return hash;
}

Brick enlarged_quadrant(const Brick& brick, int q) {
    const Rgba* const corner = &brick[corner_of(q)];
    Brick large;
    for (std::size_t y = 0; y < kHalf; ++y) {
        for (std::size_t x = 0; x < kHalf; ++x) {
            const Rgba pixel = corner[kSide * y + x];
            Rgba* const four = &large[kSide * 2 * y + 2 * x];
            four[0] = four[1] = four[kSide] = four[kSide + 1] = pixel;
        }
    }
    return large;
}

PixelMask equal_pixels(const Brick& a, const Brick& b) {
    // Bytes first, which the compiler makes vectors of, then eight of them to eight bits.
    static_assert(std::endian::native == std::endian::little);
    std::array<std::uint32_t, kBrickPixels> left, right;
    std::memcpy(left.data(), &a, sizeof(Brick));
    std::memcpy(right.data(), &b, sizeof(Brick));
    std::array<std::uint8_t, kBrickPixels> equal;
    for (std::size_t i = 0; i < equal.size(); ++i) {
        equal[i] = static_cast<std::uint8_t>(left[i] == right[i]);
    }
    PixelMask mask = 0;
    for (std::size_t y = 0; y < kSide; ++y) {
        std::uint64_t row = 0;
        std::memcpy(&row, &equal[kSide * y], sizeof(row));
        mask |= (row * 0x0102'0408'1020'4080 >> 56) << (kSide * y);
    }
    return mask;
}

QuadrantMask repeated_pixels(const Brick& brick, int q, const Brick& below) {
    const Rgba* const corner = &brick[corner_of(q)];
    std::uint32_t repeated = 0;
    for (std::size_t y = 0; y < kHalf; ++y) {
        for (std::size_t x = 0; x < kHalf; ++x) {
            std::uint32_t pixel = 0;
            std::uint64_t upper = 0;
            std::uint64_t lower = 0;
            std::memcpy(&pixel, &corner[kSide * y + x], sizeof(pixel));
            std::memcpy(&upper, &below[kSide * (2 * y) + 2 * x], sizeof(upper));
            std::memcpy(&lower, &below[kSide * (2 * y + 1) + 2 * x], sizeof(lower));
            const std::uint64_t pair = std::uint64_t{pixel} << 32 | pixel;
            const bool same = ((upper ^ pair) | (lower ^ pair)) == 0;
            repeated |= static_cast<std::uint32_t>(same) << (kHalf * y + x);
        }
    }
    return static_cast<QuadrantMask>(repeated);
}

}  // namespace haarmony::video
