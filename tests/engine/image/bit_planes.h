// Sums as planes of bits, written bit by bit, and their comparison.
#pragma once

#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "engine/image/bit_sums.h"

namespace haarmony::image {

inline constexpr int kSlotsAtOnce = kBlocksAtOnce * kBlockSlots;
inline constexpr std::uint32_t kLargestSum = (1U << kMaxPlanes) - 1;

using Sums = std::vector<std::uint32_t>;  // [slot]

// Planes are too large for many of them on a stack.
using BitSumsPtr = std::unique_ptr<BitSums>;

inline BitSumsPtr copy_of(const BitSums& sums) { return std::make_unique<BitSums>(sums); }

// What nobody may rely on, nor read by mistake.
inline BitSumsPtr random_planes(std::mt19937_64& random) {
    auto sums = std::make_unique<BitSums>();
    for (auto& plane : sums->planes) {
        for (std::uint64_t& word : plane) word = random();
    }
    return sums;
}

// Bit by bit, the slots of `sums` alone and planes [0, planes) alone.
inline void write(const Sums& sums, int planes, BitSums& out) {
    for (std::size_t slot = 0; slot < sums.size(); ++slot) {
        for (int p = 0; p < planes; ++p) {
            std::uint64_t& word = out.planes[std::size_t(p)][slot / 64];
            const std::uint64_t bit = std::uint64_t{1} << (slot % 64);
            word = (sums[slot] & (1U << p)) != 0 ? word | bit : word & ~bit;
        }
    }
}

inline Sums random_sums(std::uint32_t most, std::mt19937_64& random) {
    Sums sums(kSlotsAtOnce);
    for (std::uint32_t& sum : sums)
        sum = static_cast<std::uint32_t>(random() % (most + 1U));
    return sums;
}

inline std::string first_difference(const BitSums& a, const BitSums& b) {
    for (std::size_t p = 0; p < a.planes.size(); ++p) {
        for (std::size_t word = 0; word < a.planes[p].size(); ++word) {
            if (a.planes[p][word] != b.planes[p][word])
                return "plane " + std::to_string(p) + ", word " + std::to_string(word);
        }
    }
    return "none";
}

}  // namespace haarmony::image
