#include "engine/image/bit_sums.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <numeric>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/image/bit_sums.cc"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again for each target.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace haarmony::image::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Words = BitSums::Plane;

// What earlier columns carry into one column. The column before gives at most five (its
// twos, and one for each pair and for the odd one of up to seven rows left over), the second
// before one (its fours), the third before one for each eight of its rows.
class Carries {
  public:
    // A column adds n <= kMaxRows + 6 + n / 8 rows, so n / 8 + 6 <= kMaxRows / 7 + 7.
    static constexpr std::size_t kMost = kMaxRows / 7 + 7;

    HWY_INLINE std::uint64_t* add() {
        assert(count_ < kMost);
        return words_[count_++].data();
    }
    HWY_INLINE const std::uint64_t* get(std::size_t i) const { return words_[i].data(); }
    HWY_INLINE std::size_t count() const { return count_; }
    HWY_INLINE void clear() { count_ = 0; }

  private:
    std::size_t count_ = 0;
    alignas(64) std::array<Words, kMost> words_;
};

// Makes `sum` the ones of three bits at each place, and returns their twos.
template <class V>
HWY_INLINE V FullAdd(V& sum, V a, V b) {
    const V differ = hn::Xor(a, b);
    const V carry = hn::OrAnd(hn::And(differ, sum), a, b);
    sum = hn::Xor(differ, sum);
    return carry;
}

// Eight rows join the sums; what is too much goes to `eights` (Harley and Seal's counter):
// one carry three columns on, where pairs would leave four in the next column.
HWY_INLINE void AddEight(const std::uint64_t* const* rows,
                         std::size_t words,
                         std::uint64_t* HWY_RESTRICT ones,
                         std::uint64_t* HWY_RESTRICT twos,
                         std::uint64_t* HWY_RESTRICT fours,
                         std::uint64_t* HWY_RESTRICT eights) {
    const hn::CappedTag<std::uint64_t, kBlockWords> d;
    for (std::size_t w = 0; w < words; w += hn::Lanes(d)) {
        auto one = hn::Load(d, ones + w);
        auto two = hn::Load(d, twos + w);
        auto four = hn::Load(d, fours + w);
        const auto row = [&](std::size_t i)
                             HWY_ATTR { return hn::LoadU(d, rows[i] + w); };
        const auto two_a = FullAdd(one, row(0), row(1));
        const auto two_b = FullAdd(one, row(2), row(3));
        const auto four_a = FullAdd(two, two_a, two_b);
        const auto two_c = FullAdd(one, row(4), row(5));
        const auto two_d = FullAdd(one, row(6), row(7));
        const auto four_b = FullAdd(two, two_c, two_d);
        hn::Store(FullAdd(four, four_a, four_b), d, eights + w);
        hn::Store(one, d, ones + w);
        hn::Store(two, d, twos + w);
        hn::Store(four, d, fours + w);
    }
}

// Two rows join the ones; what is too much goes to `twos`.
HWY_INLINE void AddTwo(const std::uint64_t* a,
                       const std::uint64_t* b,
                       std::size_t words,
                       std::uint64_t* HWY_RESTRICT ones,
                       std::uint64_t* HWY_RESTRICT twos) {
    const hn::CappedTag<std::uint64_t, kBlockWords> d;
    for (std::size_t w = 0; w < words; w += hn::Lanes(d)) {
        auto one = hn::Load(d, ones + w);
        hn::Store(FullAdd(one, hn::LoadU(d, a + w), hn::LoadU(d, b + w)), d, twos + w);
        hn::Store(one, d, ones + w);
    }
}

HWY_INLINE void AddOne(const std::uint64_t* a,
                       std::size_t words,
                       std::uint64_t* HWY_RESTRICT ones,
                       std::uint64_t* HWY_RESTRICT twos) {
    const hn::CappedTag<std::uint64_t, kBlockWords> d;
    for (std::size_t w = 0; w < words; w += hn::Lanes(d)) {
        const auto one = hn::Load(d, ones + w);
        const auto row = hn::LoadU(d, a + w);
        hn::Store(hn::And(one, row), d, twos + w);
        hn::Store(hn::Xor(one, row), d, ones + w);
    }
}

HWY_INLINE void Clear(std::size_t words, std::uint64_t* plane) {
    const hn::CappedTag<std::uint64_t, kBlockWords> d;
    for (std::size_t w = 0; w < words; w += hn::Lanes(d))
        hn::Store(hn::Zero(d), d, plane + w);
}

void AddRows(const BitSumPlan& plan,
             const std::uint64_t* const* rows,
             std::size_t offset,
             int blocks,
             int first_planes,
             BitSums& sums) {
    const std::size_t words = std::size_t(blocks) * kBlockWords;
    Carries ring[4];  // a column's carries go one, two and three columns on
    const std::uint64_t* in[kMaxRows + Carries::kMost];
    for (int p = 0; p < plan.planes(); ++p) {
        Carries& here = ring[p % 4];
        Carries& next = ring[(p + 1) % 4];
        std::size_t count = 0;
        for (const std::uint16_t row : plan.column(p)) in[count++] = rows[row] + offset;
        for (std::size_t i = 0; i < here.count(); ++i) in[count++] = here.get(i);
        std::uint64_t* const ones = sums.planes[p].data();
        if (p >= first_planes) Clear(words, ones);
        std::size_t i = 0;
        if (count >= 8) {
            std::uint64_t* const twos = next.add();
            std::uint64_t* const fours = ring[(p + 2) % 4].add();
            Clear(words, twos);
            Clear(words, fours);
            for (; i + 8 <= count; i += 8)
                AddEight(&in[i], words, ones, twos, fours, ring[(p + 3) % 4].add());
        }
        for (; i + 2 <= count; i += 2) AddTwo(in[i], in[i + 1], words, ones, next.add());
        if (i < count) AddOne(in[i], words, ones, next.add());
        here.clear();
    }
}

void Unpack(const BitSums& sums, int planes, int block, std::uint16_t* out) {
    const hn::CappedTag<std::uint16_t, 16> d;
    const std::size_t lanes = hn::Lanes(d);
    alignas(64) std::uint16_t bit_of_lane[16];
    for (std::size_t lane = 0; lane < 16; ++lane)
        bit_of_lane[lane] = static_cast<std::uint16_t>(1U << lane);
    const std::size_t first_word = std::size_t(block) * kBlockWords;
    for (std::size_t slot = 0; slot < kBlockSlots; slot += lanes) {
        // The number of lanes divides 16, so these slots are in one 16-bit piece.
        const auto bits = hn::LoadU(d, bit_of_lane + slot % 16);
        auto sum = hn::Zero(d);
        for (int p = 0; p < planes; ++p) {
            const std::uint64_t word =
                sums.planes[p][first_word + slot / 64] >> (slot % 64 / 16 * 16);
            const auto piece = hn::Set(d, static_cast<std::uint16_t>(word));
            const auto value = hn::Set(d, static_cast<std::uint16_t>(1U << p));
            sum =
                hn::Or(sum, hn::And(value, hn::VecFromMask(d, hn::TestBit(piece, bits))));
        }
        hn::StoreU(sum, d, out + slot);
    }
}

}  // namespace
}  // namespace haarmony::image::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace haarmony::image {

HWY_EXPORT(AddRows);
HWY_EXPORT(Unpack);

BitSumPlan::BitSumPlan(std::span<const std::uint32_t> weights,
                       std::uint32_t most_before) {
    assert(weights.size() <= kMaxRows);
    const std::uint64_t total =
        std::accumulate(weights.begin(), weights.end(), std::uint64_t{most_before});
    planes_ = static_cast<int>(std::bit_width(total));
    assert(planes_ <= kMaxPlanes);
    for (int p = 0; p < planes_; ++p) {
        begin_[p] = rows_.size();
        for (std::size_t row = 0; row < weights.size(); ++row) {
            if ((weights[row] >> p & 1U) != 0)
                rows_.push_back(static_cast<std::uint16_t>(row));
        }
        begin_[p + 1] = rows_.size();
    }
}

void add_rows(const BitSumPlan& plan,
              std::span<const std::uint64_t* const> rows,
              std::size_t offset,
              int blocks,
              int first_planes,
              BitSums& sums) {
    assert(blocks >= 1 && blocks <= kBlocksAtOnce);
    assert(first_planes <= plan.planes());
    HWY_DYNAMIC_DISPATCH(AddRows)
    (plan, rows.data(), offset, blocks, first_planes, sums);
}

void add_rows_scalar(const BitSumPlan& plan,
                     std::span<const std::uint64_t* const> rows,
                     std::size_t offset,
                     int blocks,
                     int first_planes,
                     BitSums& sums) {
    const std::size_t words = std::size_t(blocks) * kBlockWords;
    for (int p = first_planes; p < plan.planes(); ++p)
        std::fill_n(sums.planes[p].begin(), words, std::uint64_t{0});
    for (int first = 0; first < plan.planes(); ++first) {
        for (const std::uint16_t row : plan.column(first)) {
            for (std::size_t word = 0; word < words; ++word) {
                std::uint64_t carry = rows[row][offset + word];
                for (int p = first; carry != 0; ++p) {
                    const std::uint64_t sum = sums.planes[p][word];
                    sums.planes[p][word] = sum ^ carry;
                    carry &= sum;
                }
            }
        }
    }
}

// From the lowest place up: a one in the bound must be met by a one, or outdone above.
BlockBits at_least(const BitSums& sums, int planes_used, int block, std::uint32_t bound) {
    assert(block >= 0 && block < kBlocksAtOnce);
    BlockBits result{};
    if (bound >> planes_used != 0) return result;  // beyond what the planes can say
    result.fill(~std::uint64_t{0});
    for (int p = 0; p < planes_used; ++p) {
        const std::uint64_t* const plane =
            sums.planes[p].data() + std::size_t(block) * kBlockWords;
        const bool one = (bound >> p & 1U) != 0;
        for (std::size_t word = 0; word < kBlockWords; ++word) {
            result[word] = one ? result[word] & plane[word] : result[word] | plane[word];
        }
    }
    return result;
}

namespace {

// Each bit of a byte, four times over.
constexpr std::array<std::uint32_t, 256> kFourfold = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
        for (int bit = 0; bit < 8; ++bit) {
            if ((byte >> bit & 1U) != 0) table[byte] |= 0xFU << (4 * bit);
        }
    }
    return table;
}();

}  // namespace

void spread(const BitSums& groups,
            int planes_used,
            int from,
            int quarter,
            int to,
            BitSums& out) {
    assert(quarter >= 0 && quarter < 4);
    const std::size_t source = std::size_t(from) * kBlockWords + std::size_t(quarter);
    for (int p = 0; p < planes_used; ++p) {
        const std::uint64_t word = groups.planes[p][source];
        std::uint64_t* const target =
            out.planes[p].data() + std::size_t(to) * kBlockWords;
        for (int i = 0; i < kBlockWords; ++i) {
            const std::uint64_t low = kFourfold[word >> (16 * i) & 0xFFU];
            const std::uint64_t high = kFourfold[word >> (16 * i + 8) & 0xFFU];
            target[i] = low | high << 32;
        }
    }
}

void unpack(const BitSums& sums, int planes_used, int block, UnpackedSums& out) {
    HWY_DYNAMIC_DISPATCH(Unpack)(sums, planes_used, block, out.data());
}

}  // namespace haarmony::image
#endif  // HWY_ONCE
