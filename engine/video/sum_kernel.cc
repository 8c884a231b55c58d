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

template <bool kOpaque, bool kSet>
HWY_INLINE void Accumulate(const PixelWords& pixels,
                           std::uint32_t repeats,
                           SumPlanes& sums) {
    const U byte = hn::Set(kU, 255);
    const U times = hn::Set(kU, repeats);
    const auto keep = [&sums](std::size_t plane, std::size_t i, U value) {
        std::uint32_t* const at = sums[plane].data() + i;
        hn::StoreU(kSet ? value : hn::Add(hn::LoadU(kU, at), value), kU, at);
    };
    for (std::size_t i = 0; i < kBrickPixels; i += hn::Lanes(kU)) {
        const U pixel = hn::LoadU(kU, pixels.data() + i);
        U r = hn::And(pixel, byte);
        U g = hn::And(hn::ShiftRight<8>(pixel), byte);
        U b = hn::And(hn::ShiftRight<16>(pixel), byte);
        if (kOpaque) {
            if (repeats != 1) {
                r = hn::Mul(r, times);
                g = hn::Mul(g, times);
                b = hn::Mul(b, times);
            }
        } else {
            U a = hn::ShiftRight<24>(pixel);
            if (repeats != 1) a = hn::Mul(a, times);
            r = hn::Mul(r, a);
            g = hn::Mul(g, a);
            b = hn::Mul(b, a);
            keep(3, i, a);
        }
        keep(0, i, r);
        keep(1, i, g);
        keep(2, i, b);
    }
}

void SetPixels(const PixelWords& pixels, std::uint32_t repeats, SumPlanes& sums) {
    Accumulate<false, true>(pixels, repeats, sums);
}
void AddPixels(const PixelWords& pixels, std::uint32_t repeats, SumPlanes& sums) {
    Accumulate<false, false>(pixels, repeats, sums);
}
void SetOpaque(const PixelWords& pixels, std::uint32_t repeats, SumPlanes& sums) {
    Accumulate<true, true>(pixels, repeats, sums);
}
void AddOpaque(const PixelWords& pixels, std::uint32_t repeats, SumPlanes& sums) {
    Accumulate<true, false>(pixels, repeats, sums);
}

void AddPlanes(const SumPlanes& added, std::size_t planes, SumPlanes& sums) {
    for (std::size_t plane = 0; plane < planes; ++plane) {
        const std::uint32_t* HWY_RESTRICT from = added[plane].data();
        std::uint32_t* HWY_RESTRICT to = sums[plane].data();
        for (std::size_t i = 0; i < kBrickPixels; i += hn::Lanes(kU)) {
            hn::StoreU(
                hn::Add(hn::LoadU(kU, to + i), hn::LoadU(kU, from + i)), kU, to + i);
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

void Halve(const SumPlanes& sums,
           std::size_t planes,
           std::size_t corner,
           SumPlanes& above) {
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

HWY_INLINE I LoadSums(const SumPlanes& sums, std::size_t plane, std::size_t i) {
    return hn::BitCast(kI, hn::LoadU(kU, sums[plane].data() + i));
}

HWY_INLINE I Joined(I r, I g, I b, I a) {
    return hn::Or(hn::Or(r, hn::ShiftLeft<8>(g)),
                  hn::Or(hn::ShiftLeft<16>(b), hn::ShiftLeft<24>(a)));
}

HWY_INLINE void StoreWords(I words, PixelWords& means, std::size_t i) {
    hn::StoreU(hn::BitCast(kU, words), kU, means.data() + i);
}

void MeanOf(const SumPlanes& sums, std::uint32_t samples, PixelWords& means) {
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
void MeanOfOpaque(const SumPlanes& sums, std::uint32_t samples, PixelWords& means) {
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

HWY_EXPORT(SetPixels);
HWY_EXPORT(AddPixels);
HWY_EXPORT(SetOpaque);
HWY_EXPORT(AddOpaque);
HWY_EXPORT(AddPlanes);
HWY_EXPORT(Halve);
HWY_EXPORT(MeanOf);
HWY_EXPORT(MeanOfOpaque);

static_assert(std::endian::native == std::endian::little);

}  // namespace

void set_pixels(const Brick& pixels, std::uint32_t repeats, SumPlanes& sums) {
    HWY_DYNAMIC_DISPATCH(SetPixels)(std::bit_cast<PixelWords>(pixels), repeats, sums);
}

void add_pixels(const Brick& pixels, std::uint32_t repeats, SumPlanes& sums) {
    HWY_DYNAMIC_DISPATCH(AddPixels)(std::bit_cast<PixelWords>(pixels), repeats, sums);
}

void set_opaque(const Brick& pixels, std::uint32_t repeats, SumPlanes& sums) {
    HWY_DYNAMIC_DISPATCH(SetOpaque)(std::bit_cast<PixelWords>(pixels), repeats, sums);
}

void add_opaque(const Brick& pixels, std::uint32_t repeats, SumPlanes& sums) {
    HWY_DYNAMIC_DISPATCH(AddOpaque)(std::bit_cast<PixelWords>(pixels), repeats, sums);
}

void add_planes(const SumPlanes& added, std::size_t planes, SumPlanes& sums) {
    assert(planes <= sums.size());
    HWY_DYNAMIC_DISPATCH(AddPlanes)(added, planes, sums);
}

void halve(const SumPlanes& sums,
           std::size_t planes,
           std::size_t corner,
           SumPlanes& above) {
    assert(planes <= sums.size());
    HWY_DYNAMIC_DISPATCH(Halve)(sums, planes, corner, above);
}

void mean_of(const SumPlanes& sums, std::uint32_t samples, PixelWords& means) {
    assert(samples >= 1 && samples <= kMostSamples);
    HWY_DYNAMIC_DISPATCH(MeanOf)(sums, samples, means);
}

void mean_of_opaque(const SumPlanes& sums, std::uint32_t samples, PixelWords& means) {
    assert(samples >= 1 && samples <= kMostOpaqueSamples);
    HWY_DYNAMIC_DISPATCH(MeanOfOpaque)(sums, samples, means);
}

}  // namespace haarmony::video
#endif  // HWY_ONCE
