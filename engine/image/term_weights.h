// What a query's terms weigh, by key: for pictures that are compared one by one.
//   query.h -> [term_weights.h] -> segment_search.h, tail.h
//
// Shape   a small hash table, and before it what most of the coefficients that pictures have
//         do not pass: for one of them a bit map, for many at once 256 bits for each
//         channel, in which a coefficient must find two bits set. 12 KB, where a weight for
//         every key would be 384.
// Errors  none; a wrong shape is a caller's bug and asserts.
// Threads const-thread-safe; the vector code is chosen once for the machine.
// Source  sec. 4.3.2, Figure 4.2.
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <span>

#include "engine/image/query.h"

namespace haarmony::image {

// A set of signed indices of which some that are not in it pass, too. Two bytes are made of an
// index, and each must be in a set of its own: its lower half chooses one of 16 rows, its
// upper half one of 16 columns, eight of them in each of two tables.
struct IndexSieve {
    using Table = std::array<std::uint8_t, 16>;
    alignas(16) std::array<std::array<Table, 2>, 2> tables{};  // [byte][column / 8][row]

    // The upper byte of a product hangs on all bits of the index.
    static constexpr std::array<std::uint16_t, 2> kFactors = {0x9E37, 0x6A6D};

    void add(std::int16_t signed_index) {
        for (std::size_t i = 0; i < kFactors.size(); ++i) {
            const Place place = place_of(signed_index, i);
            tables[i][place.table][place.row] |= place.bit;
        }
    }
    [[nodiscard]] bool may_have(std::int16_t signed_index) const {
        const auto has = [&](std::size_t i) {
            const Place place = place_of(signed_index, i);
            return (tables[i][place.table][place.row] & place.bit) != 0;
        };
        return has(0) && has(1);
    }

  private:
    struct Place {
        std::size_t table = 0;
        std::size_t row = 0;
        std::uint8_t bit = 0;
    };
    static Place place_of(std::int16_t signed_index, std::size_t i) {
        const std::uint32_t bits = static_cast<std::uint16_t>(signed_index);
        const std::uint32_t byte = bits * kFactors[i] >> 8 & 0xFFU;
        return {byte >> 7, byte & 15U, static_cast<std::uint8_t>(1U << (byte >> 4 & 7U))};
    }
};

class TermWeights {
  public:
    // Requires: no key of an average; at most as many different ones as a query has.
    void add(std::uint32_t key, std::int32_t weight) {
        assert(key % kCoefficientCount != 0);
        seen_[key % kSeen / 64] |= std::uint64_t{1} << (key % 64);
        std::size_t at = place(key);
        while (entries_[at].key != kFree && entries_[at].key != key)
            at = (at + 1) % kSize;
        entries_[at].key = key;
        entries_[at].weight += weight;
        const auto index = static_cast<std::int16_t>(key % kCoefficientCount);
        const bool negative = key / kCoefficientCount % 2 != 0;
        sieves_[key / (2 * kCoefficientCount)].add(negative ? std::int16_t(-index)
                                                            : index);
    }

    // 0 for a key that is none of the query's.
    [[nodiscard]] std::int32_t of(std::uint32_t key) const {
        return (seen_[key % kSeen / 64] >> (key % 64) & 1U) != 0 ? look_up(key) : 0;
    }

    // What all of these coefficients of a channel weigh. Requires: 0 <= channel < kChannels.
    [[nodiscard]] std::int64_t sum(int channel,
                                   std::span<const std::int16_t> signed_indices) const;

    // The same, one by one: the scalar twin of the vector code.
    [[nodiscard]] std::int64_t sum_scalar(
        int channel,
        std::span<const std::int16_t> signed_indices) const;

  private:
    static constexpr std::uint32_t kFree = 0;  // an average's
    struct Entry {
        std::uint32_t key = kFree;
        std::int32_t weight = 0;
    };

    [[nodiscard]] std::int32_t look_up(std::uint32_t key) const {
        for (std::size_t at = place(key);; at = (at + 1) % kSize) {
            if (entries_[at].key == key) return entries_[at].weight;
            if (entries_[at].key == kFree) return 0;
        }
    }
    static std::size_t place(std::uint32_t key) { return (key * 0x9E3779B1U) >> 22; }

    static constexpr std::size_t kSeen = std::size_t{1} << 15;
    static constexpr std::size_t kSize = std::size_t{1} << 10;
    static_assert(kSize > 3 * kChannels * kMaxCoefficients);
    std::array<IndexSieve, kChannels> sieves_{};
    std::array<std::uint64_t, kSeen / 64> seen_{};
    std::array<Entry, kSize> entries_{};
};

}  // namespace haarmony::image
