#include "engine/video/brick_match.h"

#include <array>

namespace haarmony::video {

bool within(const Brick& a, const Brick& b, std::uint32_t delta) {
    if (same_bytes(a, b)) return true;
    if (delta == 0) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (difference(a[i], b[i]) > delta) return false;
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
    constexpr int kHalf = kBrickSide / 2;
    const int left = (q & 1) * kHalf;
    const int top = (q >> 1) * kHalf;
    Brick large;
    for (int y = 0; y < kBrickSide; ++y) {
        for (int x = 0; x < kBrickSide; ++x) {
            large[static_cast<std::size_t>(y * kBrickSide + x)] =
                brick[static_cast<std::size_t>((top + y / 2) * kBrickSide + left +
                                               x / 2)];
        }
    }
    return large;
}

std::uint64_t equal_pixels(const Brick& a, const Brick& b) {
    if (same_bytes(a, b)) return ~std::uint64_t{0};
    std::uint64_t equal = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        equal |= static_cast<std::uint64_t>(a[i] == b[i]) << i;
    }
    return equal;
}

}  // namespace haarmony::video
