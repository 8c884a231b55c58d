#include "engine/image/term_weights.h"

#include <algorithm>
#include <bit>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/image/term_weights.cc"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again for each target.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace haarmony::image::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

std::uint64_t FindPassing(const IndexSieve& sieve,
                          const std::int16_t* at,
                          std::size_t count) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < count; ++i)
        bits |= std::uint64_t{sieve.may_have(at[i])} << i;
    return bits;
}

#else

// Which of Lanes(d) indices may be in the set: one bit each.
template <class D>
HWY_INLINE std::uint64_t Passing(D d, const IndexSieve& sieve, const std::int16_t* at) {
    const hn::RebindToUnsigned<D> d16;
    const hn::Repartition<std::uint8_t, D> d8;
    alignas(16) static constexpr std::array<IndexSieve::Table, 2> kBit = {
        {{1, 2, 4, 8, 16, 32, 64, 128},
         {0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 4, 8, 16, 32, 64, 128}}};
    const auto index = hn::BitCast(d16, hn::LoadU(d, at));
    const auto product = [&](std::size_t i) HWY_ATTR {
        return hn::Mul(index, hn::Set(d16, IndexSieve::kFactors[i]));
    };
    // The first byte is the lower one of its lane, the second the upper.
    const auto upper_byte = hn::Set(d16, std::uint16_t{0xFF00});
    const auto bytes =
        hn::Or(hn::ShiftRight<8>(product(0)), hn::And(product(1), upper_byte));
    const auto half = hn::Set(d16, std::uint16_t{0x0F0F});
    const auto row = hn::And(bytes, half);
    const auto column = hn::BitCast(d8, hn::And(hn::ShiftRight<4>(bytes), half));
    const auto look_up = [&](const auto& table, auto place) HWY_ATTR {
        return hn::TableLookupBytesOr0(hn::LoadDup128(d8, table.data()), place);
    };
    // What belongs to the other byte's tables is out of range, and gives 0.
    const auto first_row =
        hn::BitCast(d8, hn::Or(row, hn::Set(d16, std::uint16_t{0x8000})));
    const auto second_row =
        hn::BitCast(d8, hn::Or(row, hn::Set(d16, std::uint16_t{0x0080})));
    const auto columns_of = [&](std::size_t part) HWY_ATTR {
        const auto its_columns = hn::Or(look_up(sieve.tables[0][part], first_row),
                                        look_up(sieve.tables[1][part], second_row));
        return hn::And(its_columns, look_up(kBit[part], column));
    };
    const auto absent = hn::Eq(hn::Or(columns_of(0), columns_of(1)), hn::Zero(d8));
    const auto any_absent = hn::BitCast(d16, hn::VecFromMask(d8, absent));
    std::uint64_t bits = 0;
    std::uint8_t stored[8] = {};
    hn::StoreMaskBits(d16, hn::Eq(any_absent, hn::Zero(d16)), stored);
    std::memcpy(&bits, stored, sizeof bits);
    return bits;
}

// The same of any number of indices, of at least one vector and at most 64; the last vector
// ends with them.
template <class D>
HWY_INLINE std::uint64_t AllPassing(D d,
                                    const IndexSieve& sieve,
                                    const std::int16_t* at,
                                    std::size_t count) {
    const std::size_t lanes = hn::Lanes(d);
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i + lanes <= count; i += lanes)
        bits |= Passing(d, sieve, at + i) << i;
    if (count % lanes != 0)
        bits |= Passing(d, sieve, at + count - lanes) << (count - lanes);
    return bits;
}

std::uint64_t FindPassing(const IndexSieve& sieve,
                          const std::int16_t* at,
                          std::size_t count) {
    const hn::CappedTag<std::int16_t, 16> wide;
    const hn::CappedTag<std::int16_t, 8> narrow;
    if (count >= hn::Lanes(wide)) return AllPassing(wide, sieve, at, count);
    if (count >= hn::Lanes(narrow)) return AllPassing(narrow, sieve, at, count);
    return (std::uint64_t{1} << count) - 1;
}

#endif  // HWY_SCALAR

}  // namespace
}  // namespace haarmony::image::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace haarmony::image {

HWY_EXPORT(FindPassing);

std::int64_t TermWeights::sum(int channel,
                              std::span<const std::int16_t> signed_indices) const {
    constexpr std::size_t kAtOnce = 64;
    std::int64_t sum = 0;
    while (!signed_indices.empty()) {
        const std::size_t count = std::min(signed_indices.size(), kAtOnce);
        std::uint64_t passing = HWY_DYNAMIC_DISPATCH(FindPassing)(
            sieves_[std::size_t(channel)], signed_indices.data(), count);
        for (; passing != 0; passing &= passing - 1) {
            const std::int16_t index =
                signed_indices[std::size_t(std::countr_zero(passing))];
            sum += look_up(coefficient_key(channel, index));
        }
        signed_indices = signed_indices.subspan(count);
    }
    return sum;
}

std::int64_t TermWeights::sum_scalar(int channel,
                                     std::span<const std::int16_t> signed_indices) const {
    std::int64_t sum = 0;
    for (const std::int16_t index : signed_indices)
        sum += of(coefficient_key(channel, index));
    return sum;
}

}  // namespace haarmony::image
#endif  // HWY_ONCE
