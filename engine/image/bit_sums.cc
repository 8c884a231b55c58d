#include "engine/image/bit_sums.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <numeric>
#include <type_traits>

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

constexpr std::size_t kLineWords = 8;  // of a line of the cache

// What earlier columns carry into one column. The column before gives at most three (its
// twos, those of a pair and of an odd row), the second before two (its fours, and those of
// four rows), the third before one for each eight of its rows.
class Carries {
  public:
    // A column adds n <= kMaxRows + 5 + n / 8 rows, so n / 8 + 5 <= kMaxRows / 7 + 6.
    static constexpr std::size_t kMost = kMaxRows / 7 + 6;

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

// The planes of one place and the two above it, while rows are added at that place.
template <class V>
struct Counter {
    V ones;
    V twos;
    V fours;
};

// Four rows join; what is too much are fours.
template <class D, class V>
HWY_INLINE V
AddFour(D d, const std::uint64_t* const* rows, std::size_t w, Counter<V>& c) {
    const auto row = [&](std::size_t i) HWY_ATTR { return hn::LoadU(d, rows[i] + w); };
    const V two_a = FullAdd(c.ones, row(0), row(1));
    const V two_b = FullAdd(c.ones, row(2), row(3));
    return FullAdd(c.twos, two_a, two_b);
}

// What one place adds up: its rows, and where its carries go, one, two and three places up.
struct Column {
    const std::uint64_t* const* rows;
    std::size_t count;
    Carries* twos;
    Carries* fours;
    Carries* eights;
};

// Harley and Seal's counter: eight rows leave one carry three places up, where pairs would
// leave four in the next one.
void AddColumn(const Column& column, std::size_t words, bool add, std::uint64_t* ones) {
    const hn::CappedTag<std::uint64_t, kBlockWords> d;
    const std::size_t eights = column.count / 8;
    const bool four = column.count % 8 >= 4;
    const std::size_t pairs = column.count % 4 / 2;
    const bool odd = column.count % 2 != 0;
    const bool has_twos = column.count >= 4;
    const bool has_fours = column.count >= 8;
    std::uint64_t* eight_carries[kMaxRows / 8 + Carries::kMost / 8 + 1];
    for (std::size_t i = 0; i < eights; ++i) eight_carries[i] = column.eights->add();
    std::uint64_t* const four_of_four = four ? column.fours->add() : nullptr;
    std::uint64_t* const fours = has_fours ? column.fours->add() : nullptr;
    std::uint64_t* const twos = has_twos ? column.twos->add() : nullptr;
    std::uint64_t* const two_of_pair = pairs != 0 ? column.twos->add() : nullptr;
    std::uint64_t* const two_of_odd = odd ? column.twos->add() : nullptr;
    for (std::size_t w = 0; w < words; w += hn::Lanes(d)) {
        using V = decltype(hn::Zero(d));
        Counter<V> c{add ? hn::Load(d, ones + w) : hn::Zero(d), hn::Zero(d), hn::Zero(d)};
        const std::uint64_t* const* rows = column.rows;
        for (std::size_t i = 0; i < eights; ++i, rows += 8) {
            const V four_a = AddFour(d, rows, w, c);
            const V four_b = AddFour(d, rows + 4, w, c);
            hn::Store(FullAdd(c.fours, four_a, four_b), d, eight_carries[i] + w);
        }
        if (four) {
            hn::Store(AddFour(d, rows, w, c), d, four_of_four + w);
            rows += 4;
        }
        if (pairs != 0) {
            const V two =
                FullAdd(c.ones, hn::LoadU(d, rows[0] + w), hn::LoadU(d, rows[1] + w));
            hn::Store(two, d, two_of_pair + w);
            rows += 2;
        }
        if (odd) {
            const V row = hn::LoadU(d, rows[0] + w);
            hn::Store(hn::And(c.ones, row), d, two_of_odd + w);
            c.ones = hn::Xor(c.ones, row);
        }
        hn::Store(c.ones, d, ones + w);
        if (has_twos) hn::Store(c.twos, d, twos + w);
        if (has_fours) hn::Store(c.fours, d, fours + w);
    }
}

// A share of the rows at each plane: all at once would be more than can be on its way.
HWY_INLINE void AskFor(const Ahead& ahead,
                       const std::uint64_t* const* begin,
                       const std::uint64_t* const* end) {
    constexpr int kForReading = 0;
    constexpr int kSecondLevel = 2;  // the first one holds what is being added
    const std::size_t words = std::size_t(ahead.blocks) * kBlockWords;
    for (const std::uint64_t* const* row = begin; row < end; ++row) {
        for (std::size_t w = 0; w < words; w += kLineWords)
            __builtin_prefetch(*row + ahead.offset + w, kForReading, kSecondLevel);
    }
}

void AddRows(const BitSumPlan& plan,
             const std::uint64_t* const* rows,
             std::size_t row_count,
             std::size_t offset,
             int blocks,
             int first_planes,
             const Ahead& ahead,
             BitSums& sums) {
    const std::size_t words = std::size_t(blocks) * kBlockWords;
    Carries ring[4];  // a column's carries go one, two and three columns on
    const std::uint64_t* in[kMaxRows + Carries::kMost];
    for (int p = 0; p < plan.planes(); ++p) {
        const auto share = [&](int plane) {
            return rows + row_count * std::size_t(plane) / std::size_t(plan.planes());
        };
        AskFor(ahead, share(p), share(p + 1));
        Carries& here = ring[p % 4];
        std::size_t count = 0;
        for (const std::uint16_t row : plan.column(p)) in[count++] = rows[row] + offset;
        for (std::size_t i = 0; i < here.count(); ++i) in[count++] = here.get(i);
        const Column column{
            in, count, &ring[(p + 1) % 4], &ring[(p + 2) % 4], &ring[(p + 3) % 4]};
        AddColumn(column, words, p < first_planes, sums.planes[p].data());
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

// The lowest 16 bits of each piece, each four times.
template <class V>
HWY_INLINE V Fourfold(V piece) {
    const hn::DFromV<V> d;
    const auto apart = [&](auto shift, V bits, std::uint64_t kept) HWY_ATTR {
        return hn::And(hn::Or(bits, hn::ShiftLeft<shift>(bits)), hn::Set(d, kept));
    };
    V bits = apart(std::integral_constant<int, 24>(), piece, 0x000000FF000000FFU);
    bits = apart(std::integral_constant<int, 12>(), bits, 0x000F000F000F000FU);
    bits = apart(std::integral_constant<int, 6>(), bits, 0x0303030303030303U);
    bits = apart(std::integral_constant<int, 3>(), bits, 0x1111111111111111U);
    return hn::Sub(hn::ShiftLeft<4>(bits), bits);
}

void Spread(const BitSums& groups,
            int planes,
            int from,
            int quarter,
            int to,
            BitSums& out) {
    const hn::CappedTag<std::uint64_t, kBlockWords> d;
    alignas(64) static constexpr std::uint64_t kShift[kBlockWords] = {0, 16, 32, 48};
    const auto lowest = hn::Set(d, std::uint64_t{0xFFFF});
    const std::size_t at = std::size_t(from) * kBlockWords + std::size_t(quarter);
    for (int p = 0; p < planes; ++p) {
        const auto word = hn::Set(d, groups.planes[p][at]);
        std::uint64_t* const target =
            out.planes[p].data() + std::size_t(to) * kBlockWords;
        for (std::size_t i = 0; i < kBlockWords; i += hn::Lanes(d)) {
            const auto piece = hn::And(hn::Shr(word, hn::Load(d, kShift + i)), lowest);
            hn::Store(Fourfold(piece), d, target + i);
        }
    }
}

}  // namespace
}  // namespace haarmony::image::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace haarmony::image {

HWY_EXPORT(AddRows);
HWY_EXPORT(Spread);
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
              const Ahead& ahead,
              BitSums& sums) {
    assert(blocks >= 1 && blocks <= kBlocksAtOnce);
    assert(first_planes <= plan.planes());
    HWY_DYNAMIC_DISPATCH(AddRows)
    (plan, rows.data(), rows.size(), offset, blocks, first_planes, ahead, sums);
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

void spread(const BitSums& groups,
            int planes_used,
            int from,
            int quarter,
            int to,
            BitSums& out) {
    assert(quarter >= 0 && quarter < 4);
    HWY_DYNAMIC_DISPATCH(Spread)(groups, planes_used, from, quarter, to, out);
}

void unpack(const BitSums& sums, int planes_used, int block, UnpackedSums& out) {
    HWY_DYNAMIC_DISPATCH(Unpack)(sums, planes_used, block, out.data());
}

}  // namespace haarmony::image
#endif  // HWY_ONCE
