#include "engine/video/sum_kernel.h"

#include <bit>
#include <cassert>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/video/sum_kernel.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace haarmony::video {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Capped, so that a brick is whole vectors wherever vectors may be longer.
const hn::CappedTag<std::uint32_t, 16> kU;
const hn::RebindToSigned<decltype(kU)> kI;
const hn::RebindToFloat<decltype(kU)> kF;
using U = hn::Vec<decltype(kU)>;
using I = hn::Vec<decltype(kI)>;
using F = hn::Vec<decltype(kF)>;

struct Channels {
    U r, g, b, a;
};

HWY_INLINE Channels LoadPixels(const PixelWords& pixels, std::size_t i) {
    const U byte = hn::Set(kU, 255);
    const U pixel = hn::LoadU(kU, pixels.data() + i);
    return {hn::And(pixel, byte),
            hn::And(hn::ShiftRight<8>(pixel), byte),
            hn::And(hn::ShiftRight<16>(pixel), byte),
            hn::ShiftRight<24>(pixel)};
}

void AddOpaque(const PixelWords& pixels, std::uint32_t repeats, ShortSums& sums) {
    const hn::Rebind<std::uint16_t, decltype(kU)> d;
    const U times = hn::Set(kU, repeats);
    for (std::size_t i = 0; i < kBrickPixels; i += hn::Lanes(kU)) {
        const auto add = [&](std::size_t plane, U value) {
            if (repeats != 1) value = hn::Mul(value, times);
            std::uint16_t* const at = sums[plane].data() + i;
            const auto added = hn::DemoteTo(d, hn::BitCast(kI, value));
            hn::StoreU(hn::Add(hn::LoadU(d, at), added), d, at);
        };
        const Channels pixel = LoadPixels(pixels, i);
        add(0, pixel.r);
        add(1, pixel.g);
        add(2, pixel.b);
    }
}

void AddPixels(const PixelWords& pixels, std::uint32_t repeats, NarrowSums& sums) {
    const U times = hn::Set(kU, repeats);
    for (std::size_t i = 0; i < kBrickPixels; i += hn::Lanes(kU)) {
        const auto add = [&](std::size_t plane, U value) {
            std::uint32_t* const at = sums[plane].data() + i;
            hn::StoreU(hn::Add(hn::LoadU(kU, at), value), kU, at);
        };
        const Channels pixel = LoadPixels(pixels, i);
        const U weight = hn::Mul(pixel.a, times);
        add(0, hn::Mul(pixel.r, weight));
        add(1, hn::Mul(pixel.g, weight));
        add(2, hn::Mul(pixel.b, weight));
        add(3, weight);
    }
}

void Widen(const ShortSums& sums, NarrowSums& wider) {
    const hn::Rebind<std::uint16_t, decltype(kU)> d;
    for (std::size_t plane = 0; plane < sums.size(); ++plane) {
        const std::uint16_t* HWY_RESTRICT from = sums[plane].data();
        std::uint32_t* HWY_RESTRICT to = wider[plane].data();
        for (std::size_t i = 0; i < kBrickPixels; i += hn::Lanes(kU)) {
            hn::StoreU(hn::PromoteTo(kU, hn::LoadU(d, from + i)), kU, to + i);
        }
    }
}

#if HWY_TARGET == HWY_SCALAR
// The four sums of two rows of eight in pairs.
void HalveRows(const std::uint32_t* upper, std::uint32_t* out) {
    const std::uint32_t* const lower = upper + kBrickSide;
    for (int x = 0; x < kBrickSide / 2; ++x) {
        out[x] = upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1];
    }
}
#else
HWY_INLINE void HalveRows(const std::uint32_t* HWY_RESTRICT upper,
                          std::uint32_t* HWY_RESTRICT out) {
    const hn::CappedTag<std::uint32_t, 4> d;
    const std::uint32_t* const lower = upper + kBrickSide;
    const auto left = hn::Add(hn::LoadU(d, upper), hn::LoadU(d, lower));
    const auto right = hn::Add(hn::LoadU(d, upper + 4), hn::LoadU(d, lower + 4));
    hn::StoreU(
        hn::Add(hn::ConcatEven(d, right, left), hn::ConcatOdd(d, right, left)), d, out);
}
#endif

void Halve(const NarrowSums& sums,
           std::size_t planes,
           std::size_t corner,
           NarrowSums& above) {
    for (std::size_t plane = 0; plane < planes; ++plane) {
        const std::uint32_t* from = sums[plane].data();
        std::uint32_t* to = above[plane].data() + corner;
        for (int y = 0; y < kBrickSide / 2;
             ++y, from += 2 * kBrickSide, to += kBrickSide) {
            HalveRows(from, to);
        }
    }
}

// floor(dividend / divisor), which is at most 255 (so that the floats' estimate is off by one
// at most, and 256 divisors are below 2^31).
HWY_INLINE I Quotient(I dividend, I divisor, F reciprocal) {
    const I estimate =
        hn::ConvertTo(kI, hn::Mul(hn::ConvertTo(kF, dividend), reciprocal));
    const I rest = hn::Sub(dividend, hn::Mul(estimate, divisor));
    // A mask as a number is -1.
    const I below = hn::VecFromMask(kI, hn::Lt(rest, hn::Zero(kI)));
    const I above = hn::VecFromMask(kI, hn::Not(hn::Lt(rest, divisor)));
    return hn::Sub(hn::Add(estimate, below), above);
}

HWY_INLINE I LoadSums(const NarrowSums& sums, std::size_t plane, std::size_t i) {
    return hn::BitCast(kI, hn::LoadU(kU, sums[plane].data() + i));
}

HWY_INLINE I Joined(I r, I g, I b, I a) {
    return hn::Or(hn::Or(r, hn::ShiftLeft<8>(g)),
                  hn::Or(hn::ShiftLeft<16>(b), hn::ShiftLeft<24>(a)));
}

HWY_INLINE void StoreWords(I words, PixelWords& means, std::size_t i) {
    hn::StoreU(hn::BitCast(kU, words), kU, means.data() + i);
}

void MeanOf(const NarrowSums& sums, std::uint32_t samples, PixelWords& means) {
    const I one = hn::Set(kI, 1);
    const I count = hn::Set(kI, static_cast<std::int32_t>(samples));
    const I half_count = hn::Set(kI, static_cast<std::int32_t>(samples / 2));
    const F per_count = hn::Set(kF, 1.0F / static_cast<float>(samples));
    for (std::size_t i = 0; i < kBrickPixels; i += hn::Lanes(kU)) {
        const I a = LoadSums(sums, 3, i);
        const I alpha = Quotient(hn::Add(a, half_count), count, per_count);
        const I divisor = hn::Max(a, one);
        const I half = hn::ShiftRight<1>(divisor);
        const F reciprocal = hn::Div(hn::Set(kF, 1.0F), hn::ConvertTo(kF, divisor));
        const auto channel = [&](std::size_t plane) {
            return Quotient(hn::Add(LoadSums(sums, plane, i), half), divisor, reciprocal);
        };
        const I words = Joined(channel(0), channel(1), channel(2), alpha);
        StoreWords(hn::IfThenZeroElse(hn::Eq(alpha, hn::Zero(kI)), words), means, i);
    }
}

// By shifting, where the number of samples is a power of two: most time nodes cover one.
void MeanOfOpaque(const NarrowSums& sums, std::uint32_t samples, PixelWords& means) {
    const I opaque = hn::Set(kI, 255);
    const I half = hn::Set(kI, static_cast<std::int32_t>(samples / 2));
    if (std::has_single_bit(samples)) {
        const int log2 = std::countr_zero(samples);
        for (std::size_t i = 0; i < kBrickPixels; i += hn::Lanes(kU)) {
            const auto channel = [&](std::size_t plane) {
                return hn::ShiftRightSame(hn::Add(LoadSums(sums, plane, i), half), log2);
            };
            StoreWords(Joined(channel(0), channel(1), channel(2), opaque), means, i);
        }
        return;
    }
    const I count = hn::Set(kI, static_cast<std::int32_t>(samples));
    const F per_count = hn::Set(kF, 1.0F / static_cast<float>(samples));
    for (std::size_t i = 0; i < kBrickPixels; i += hn::Lanes(kU)) {
        const auto channel = [&](std::size_t plane) {
            return Quotient(hn::Add(LoadSums(sums, plane, i), half), count, per_count);
        };
        StoreWords(Joined(channel(0), channel(1), channel(2), opaque), means, i);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace haarmony::video
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace haarmony::video {
namespace {

HWY_EXPORT(AddOpaque);
HWY_EXPORT(AddPixels);
HWY_EXPORT(Widen);
HWY_EXPORT(Halve);
HWY_EXPORT(MeanOf);
HWY_EXPORT(MeanOfOpaque);

static_assert(std::endian::native == std::endian::little);

}  // namespace

void add_opaque(const Brick& pixels, std::uint32_t repeats, ShortSums& sums) {
    assert(repeats >= 1 && repeats <= kMostShortFrames);
    HWY_DYNAMIC_DISPATCH(AddOpaque)(std::bit_cast<PixelWords>(pixels), repeats, sums);
}

void add_pixels(const Brick& pixels, std::uint32_t repeats, NarrowSums& sums) {
    assert(repeats >= 1 && repeats <= kMostNarrowFrames);
    HWY_DYNAMIC_DISPATCH(AddPixels)(std::bit_cast<PixelWords>(pixels), repeats, sums);
}

void widen(const ShortSums& sums, NarrowSums& wider) {
    HWY_DYNAMIC_DISPATCH(Widen)(sums, wider);
}

void halve(const NarrowSums& sums,
           std::size_t planes,
           std::size_t corner,
           NarrowSums& above) {
    assert(planes <= sums.size());
    HWY_DYNAMIC_DISPATCH(Halve)(sums, planes, corner, above);
}

void mean_of(const NarrowSums& sums, std::uint32_t samples, PixelWords& means) {
    assert(samples >= 1 && samples <= kMostSamples);
    HWY_DYNAMIC_DISPATCH(MeanOf)(sums, samples, means);
}

void mean_of_opaque(const NarrowSums& sums, std::uint32_t samples, PixelWords& means) {
    assert(samples >= 1 && samples <= kMostOpaqueSamples);
    HWY_DYNAMIC_DISPATCH(MeanOfOpaque)(sums, samples, means);
}

}  // namespace haarmony::video
#endif  // HWY_ONCE
