// What a query's terms weigh, by key: for pictures that are compared one by one.
//   query.h -> [term_weights.h] -> segment_search.h, tail.h
//
// Shape   a small hash table, and before it a bit map that most of what pictures have does
//         not pass: 12 KB, where a weight for every key would be 384.
// Errors  none; a wrong shape is a caller's bug and asserts.
// Threads const-thread-safe.
// Source  sec. 4.3.2, Figure 4.2.
#pragma once

#include <array>
#include <cassert>
#include <cstdint>

#include "engine/image/query.h"

namespace haarmony::image {

class TermWeights {
  public:
    // Requires: no key of an average; at most as many different ones as a query has.
    void add(std::uint32_t key, std::int32_t weight) {
        assert(key % kCoefficientCount != 0);
        seen_[key % kSeen / 64] |= std::uint64_t{1} << (key % 64);
        std::size_t at = place(key);
        while (keys_[at] != kFree && keys_[at] != key) at = (at + 1) % kSize;
        keys_[at] = key;
        weights_[at] += weight;
    }

    // 0 for a key that is none of the query's.
    [[nodiscard]] std::int32_t of(std::uint32_t key) const {
        return (seen_[key % kSeen / 64] >> (key % 64) & 1U) != 0 ? look_up(key) : 0;
    }

  private:
    [[nodiscard]] std::int32_t look_up(std::uint32_t key) const {
        for (std::size_t at = place(key);; at = (at + 1) % kSize) {
            if (keys_[at] == key) return weights_[at];
            if (keys_[at] == kFree) return 0;
        }
    }
    static std::size_t place(std::uint32_t key) { return (key * 0x9E3779B1U) >> 22; }

    static constexpr std::size_t kSeen = std::size_t{1} << 15;
    static constexpr std::size_t kSize = std::size_t{1} << 10;
    static_assert(kSize > 3 * kChannels * kMaxCoefficients);
    static constexpr std::uint32_t kFree = 0;
    std::array<std::uint64_t, kSeen / 64> seen_{};
    std::array<std::uint32_t, kSize> keys_{};
    std::array<std::int32_t, kSize> weights_{};
};

}  // namespace haarmony::image
