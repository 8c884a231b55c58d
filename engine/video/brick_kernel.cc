#include "engine/video/brick_kernel.h"

#include <algorithm>
#include <bit>
#include <cstdlib>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/video/brick_kernel.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace haarmony::video {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kBytes = sizeof(Brick);

HWY_INLINE std::uint8_t* BytesOf(Brick& brick) {
    return reinterpret_cast<std::uint8_t*>(brick.data());
}
HWY_INLINE const std::uint8_t* BytesOf(const Brick& brick) {
    return reinterpret_cast<const std::uint8_t*>(brick.data());
}

#if HWY_TARGET == HWY_SCALAR

// The twin of the vector code, from the definition.
std::uint32_t Deviation(const Brick& a, const Brick& b) {
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < kBytes; ++i) {
        const int off = static_cast<std::int8_t>(BytesOf(a)[i] - BytesOf(b)[i]);
        sum += static_cast<std::uint32_t>(std::abs(off));
    }
    return sum;
}

void Shift(const Brick& base, const Brick& to, const Brick& from, Brick& out) {
    for (std::size_t i = 0; i < kBytes; ++i) {
        const int moved = BytesOf(base)[i] + BytesOf(to)[i] - BytesOf(from)[i];
        BytesOf(out)[i] = static_cast<std::uint8_t>(std::clamp(moved, 0, 255));
    }
}

std::uint8_t ThreeToOne(std::uint8_t nearer, std::uint8_t farther) {
    return static_cast<std::uint8_t>((nearer + (nearer + farther + 1) / 2 + 1) / 2);
}

void Smooth(const Brick& coarse, int quadrant, Brick& out) {
    const int left = 4 * (quadrant & 1);
    const int top = 4 * (quadrant >> 1);
    // The pixel that one lies in, or the nearest beside it.
    const auto at = [&](int x, int y) {
        return coarse[std::clamp(y, 0, kBrickSide - 1) * kBrickSide +
                      std::clamp(x, 0, kBrickSide - 1)];
    };
    for (int y = 0; y < kBrickSide; ++y) {
        for (int x = 0; x < kBrickSide; ++x) {
            const int u = left + x / 2;
            const int v = top + y / 2;
            const auto across = [&](int row, std::uint8_t Rgba::*channel) {
                return ThreeToOne(at(u, row).*channel,
                                  at(x % 2 == 0 ? u - 1 : u + 1, row).*channel);
            };
            for (const auto channel : {&Rgba::r, &Rgba::g, &Rgba::b, &Rgba::a}) {
                out[y * kBrickSide + x].*channel = ThreeToOne(
                    across(v, channel), across(y % 2 == 0 ? v - 1 : v + 1, channel));
            }
        }
    }
}

int ClassOf(std::uint8_t residual) {
    const int off = static_cast<std::int8_t>(residual);
    return off == 0                ? 0
           : off == -1             ? 1
           : off >= -2 && off <= 1 ? 2
           : off >= -4 && off <= 3 ? 3
           : off >= -8 && off <= 7 ? 4
                                   : 5;
}

Left PackResiduals(const Brick& brick, const Brick& predicted, PackedRows& rows) {
    Residuals apart;
    Residuals following;
    int sum_apart = 0;
    int sum_following = 0;
    for (int i = 0; i < kBrickPixels; ++i) {
        const Rgba is = brick[i];
        const Rgba was = predicted[i];
        const int keep = is.a == 0 ? 0 : 255;
        const int green = is.g - was.g;
        const std::array<int, kPlanes> off = {
            green & keep, (is.r - was.r) & keep, (is.b - was.b) & keep, is.a - was.a};
        for (int plane = 0; plane < kPlanes; ++plane) {
            const int less =
                plane == 1 || plane == 2 ? (off[plane] - green) & keep : off[plane];
            apart[plane * kBrickPixels + i] = static_cast<std::uint8_t>(off[plane]);
            following[plane * kBrickPixels + i] = static_cast<std::uint8_t>(less);
            sum_apart += std::abs(static_cast<std::int8_t>(off[plane]));
            sum_following += std::abs(static_cast<std::int8_t>(less));
        }
    }
    Left left;
    left.follows_green = sum_following < sum_apart;
    left.opaque = std::all_of(
        brick.begin(), brick.end(), [](Rgba pixel) { return pixel.a == 255; });
    const Residuals& chosen = left.follows_green ? following : apart;
    for (int row = 0; row < kRows; ++row) {
        const std::uint8_t* const at = chosen.data() + row * kBrickSide;
        int row_class = 0;
        for (int x = 0; x < kBrickSide; ++x)
            row_class = std::max(row_class, ClassOf(at[x]));
        const int bits = kRowBytes[row_class];  // for each residual
        std::uint64_t bytes = 0;
        for (int x = 0; x < kBrickSide; ++x)
            bytes |= (at[x] & ((std::uint64_t{1} << bits) - 1)) << bits * x;
        rows.bytes[row] = bytes;
        rows.row_class[row] = row_class;
        if (row_class > 0) (row < 3 * kBrickSide ? left.colors : left.alpha) = true;
    }
    return left;
}

void AddResiduals(const Residuals& residuals,
                  const Brick& predicted,
                  bool follows_green,
                  bool opaque,
                  Brick& brick) {
    for (int i = 0; i < kBrickPixels; ++i) {
        const int green = residuals[i];
        const int follow = follows_green ? green : 0;
        const Rgba was = predicted[i];
        Rgba pixel;
        pixel.g = static_cast<std::uint8_t>(was.g + green);
        pixel.r = static_cast<std::uint8_t>(was.r + residuals[kBrickPixels + i] + follow);
        pixel.b =
            static_cast<std::uint8_t>(was.b + residuals[2 * kBrickPixels + i] + follow);
        pixel.a =
            opaque ? 255
                   : static_cast<std::uint8_t>(was.a + residuals[3 * kBrickPixels + i]);
        brick[i] = canonical(pixel);
    }
}

#else

// Capped, so that a brick is whole vectors wherever vectors may be longer.
const hn::CappedTag<std::uint8_t, 64> k8;
const hn::RebindToSigned<decltype(k8)> kI8;
const hn::Repartition<std::uint32_t, decltype(k8)> k32;
const hn::Repartition<std::uint64_t, decltype(k8)> k64;
using V8 = hn::Vec<decltype(k8)>;
using V32 = hn::Vec<decltype(k32)>;
using V64 = hn::Vec<decltype(k64)>;

HWY_INLINE V64 Magnitudes(V8 residuals) {
    return hn::SumsOf8(hn::BitCast(k8, hn::Abs(hn::BitCast(kI8, residuals))));
}
HWY_INLINE std::uint32_t Total(V64 sums) {
    return static_cast<std::uint32_t>(hn::GetLane(hn::SumOfLanes(k64, sums)));
}

std::uint32_t Deviation(const Brick& a, const Brick& b) {
    V64 sums = hn::Zero(k64);
    for (std::size_t i = 0; i < kBytes; i += hn::Lanes(k8)) {
        const V8 off =
            hn::Sub(hn::LoadU(k8, BytesOf(a) + i), hn::LoadU(k8, BytesOf(b) + i));
        sums = hn::Add(sums, Magnitudes(off));
    }
    return Total(sums);
}

void Shift(const Brick& base, const Brick& to, const Brick& from, Brick& out) {
    for (std::size_t i = 0; i < kBytes; i += hn::Lanes(k8)) {
        const V8 start = hn::LoadU(k8, BytesOf(base) + i);
        const V8 plus = hn::LoadU(k8, BytesOf(to) + i);
        const V8 minus = hn::LoadU(k8, BytesOf(from) + i);
        // One of the two differences is 0.
        const V8 up = hn::SaturatedAdd(start, hn::SaturatedSub(plus, minus));
        const V8 moved = hn::SaturatedSub(up, hn::SaturatedSub(minus, plus));
        hn::StoreU(moved, k8, BytesOf(out) + i);
    }
}

const hn::Full128<std::uint8_t> kFour;  // pixels
const hn::Full128<std::uint32_t> kFourWords;
using Four = hn::Vec<decltype(kFour)>;

HWY_INLINE Four ThreeToOne(Four nearer, Four farther) {
    return hn::AverageRound(nearer, hn::AverageRound(nearer, farther));
}

// Four pixels of a row of eight, those to their left and to their right: within the brick, or
// the nearest that is.
struct Beside {
    Four left, here, right;
};
template <bool kRightHalf>
HWY_INLINE Beside LoadBeside(const std::uint8_t* row) {
    const hn::Vec<decltype(kFourWords)> here = hn::BitCast(
        kFourWords, hn::LoadU(kFour, row + (kRightHalf ? 4 * sizeof(Rgba) : 0)));
    if constexpr (kRightHalf) {
        const auto moved = hn::ShiftRightLanes<1>(kFourWords, here);
        const auto inside = hn::FirstN(kFourWords, 3);
        return {hn::LoadU(kFour, row + 3 * sizeof(Rgba)),
                hn::BitCast(kFour, here),
                hn::BitCast(kFour, hn::IfThenElse(inside, moved, here))};
    } else {
        const auto moved = hn::ShiftLeftLanes<1>(kFourWords, here);
        const auto outside = hn::FirstN(kFourWords, 1);
        return {hn::BitCast(kFour, hn::IfThenElse(outside, here, moved)),
                hn::BitCast(kFour, here),
                hn::LoadU(kFour, row + sizeof(Rgba))};
    }
}

template <bool kRightHalf>
HWY_INLINE void SmoothHalf(const std::uint8_t* coarse, int top, std::uint8_t* to) {
    std::array<Four, 6> left;
    std::array<Four, 6> right;
    for (int y = 0; y < 6; ++y) {
        const int row = std::min(std::max(top + y - 1, 0), kBrickSide - 1);
        const Beside of = LoadBeside<kRightHalf>(coarse + static_cast<std::size_t>(row) *
                                                              kBrickSide * sizeof(Rgba));
        const auto even = hn::BitCast(kFourWords, ThreeToOne(of.here, of.left));
        const auto odd = hn::BitCast(kFourWords, ThreeToOne(of.here, of.right));
        left[y] = hn::BitCast(kFour, hn::InterleaveLower(kFourWords, even, odd));
        right[y] = hn::BitCast(kFour, hn::InterleaveUpper(kFourWords, even, odd));
    }
    for (std::size_t y = 1; y < 5; ++y) {
        for (const std::size_t beside : {y - 1, y + 1}) {
            hn::StoreU(ThreeToOne(left[y], left[beside]), kFour, to);
            hn::StoreU(ThreeToOne(right[y], right[beside]), kFour, to + 16);
            to += 32;
        }
    }
}

void Smooth(const Brick& coarse, int quadrant, Brick& out) {
    const int top = 4 * (quadrant >> 1);
    if ((quadrant & 1) != 0) {
        SmoothHalf<true>(BytesOf(coarse), top, BytesOf(out));
    } else {
        SmoothHalf<false>(BytesOf(coarse), top, BytesOf(out));
    }
}

// Green, where red and blue stand.
HWY_INLINE V8 GreenOf(V8 pixels) {
    const V32 green = hn::And(hn::BitCast(k32, pixels), hn::Set(k32, 0xFF00U));
    return hn::BitCast(k8, hn::Or(hn::ShiftRight<8>(green), hn::ShiftLeft<8>(green)));
}
// All bits, but those of the colours of clear pixels.
HWY_INLINE V8 NotClear(V8 pixels) {
    const V32 alpha = hn::Set(k32, 0xFF000000U);
    const V32 own = hn::And(hn::BitCast(k32, pixels), alpha);
    const V32 clear = hn::VecFromMask(k32, hn::Eq(own, hn::Zero(k32)));
    return hn::BitCast(k8, hn::Or(hn::Not(clear), alpha));
}

// Rows of one plane, eight residuals a lane of 64 bits. Returns their classes.
HWY_INLINE V64 PackPlane(V8 residuals,
                         std::uint64_t* HWY_RESTRICT bytes,
                         std::uint64_t* HWY_RESTRICT row_class) {
    const auto value = hn::BitCast(kI8, residuals);
    const auto zero = hn::Zero(kI8);
    const auto width = hn::Xor(value, hn::VecFromMask(kI8, hn::Lt(value, zero)));
    // A mask as a number is -1.
    const auto above = [&](std::int8_t most) {
        return hn::VecFromMask(kI8, hn::Gt(width, hn::Set(kI8, most)));
    };
    const auto none = hn::VecFromMask(kI8, hn::Eq(value, zero));
    const auto masks = hn::Add(hn::Add(above(0), above(1)), hn::Add(above(3), above(7)));
    V8 most = hn::BitCast(k8, hn::Sub(hn::Add(hn::Set(kI8, 1), none), masks));
    const auto folded = [&](V64 moved) { return hn::Max(most, hn::BitCast(k8, moved)); };
    most = folded(hn::ShiftRight<32>(hn::BitCast(k64, most)));
    most = folded(hn::ShiftRight<16>(hn::BitCast(k64, most)));
    most = folded(hn::ShiftRight<8>(hn::BitCast(k64, most)));
    const V64 found = hn::And(hn::BitCast(k64, most), hn::Set(k64, 0xFF));

    const V64 whole = hn::BitCast(k64, residuals);
    const auto masked = [](V64 vector, std::uint64_t mask) {
        return hn::And(vector, hn::Set(k64, mask));
    };
    V64 ones = masked(whole, 0x8040'2010'0804'0201U);
    ones = hn::Or(ones, hn::ShiftRight<32>(ones));
    ones = hn::Or(ones, hn::ShiftRight<16>(ones));
    ones = hn::Or(ones, hn::ShiftRight<8>(ones));
    V64 twos = masked(whole, 0x0303'0303'0303'0303U);
    twos = masked(hn::Or(twos, hn::ShiftRight<6>(twos)), 0x000F'000F'000F'000FU);
    twos = masked(hn::Or(twos, hn::ShiftRight<12>(twos)), 0x0000'00FF'0000'00FFU);
    twos = hn::Or(twos, hn::ShiftRight<24>(twos));
    V64 fours = masked(whole, 0x0F0F'0F0F'0F0F'0F0FU);
    fours = masked(hn::Or(fours, hn::ShiftRight<4>(fours)), 0x00FF'00FF'00FF'00FFU);
    fours = masked(hn::Or(fours, hn::ShiftRight<8>(fours)), 0x0000'FFFF'0000'FFFFU);
    fours = hn::Or(fours, hn::ShiftRight<16>(fours));
    const auto is = [&](std::uint64_t one) { return hn::Eq(found, hn::Set(k64, one)); };
    V64 packed = hn::IfThenElse(is(5), whole, fours);
    packed = hn::IfThenElse(is(2), twos, packed);
    packed = hn::IfThenElse(is(1), ones, packed);
    hn::StoreU(packed, k64, bytes);
    hn::StoreU(found, k64, row_class);
    return found;
}

Left PackResiduals(const Brick& brick, const Brick& predicted, PackedRows& rows) {
    alignas(64) std::array<std::uint8_t, kBytes> apart;
    alignas(64) std::array<std::uint8_t, kBytes> following;
    V64 sum_apart = hn::Zero(k64);
    V64 sum_following = hn::Zero(k64);
    V8 all = hn::Set(k8, 255);
    for (std::size_t i = 0; i < kBytes; i += hn::Lanes(k8)) {
        const V8 pixels = hn::LoadU(k8, BytesOf(brick) + i);
        const V8 off = hn::Sub(pixels, hn::LoadU(k8, BytesOf(predicted) + i));
        const V8 keep = NotClear(pixels);
        all = hn::And(all, pixels);
        const V8 one = hn::And(off, keep);
        const V8 other = hn::And(hn::Sub(off, GreenOf(off)), keep);
        hn::Store(one, k8, apart.data() + i);
        hn::Store(other, k8, following.data() + i);
        sum_apart = hn::Add(sum_apart, Magnitudes(one));
        sum_following = hn::Add(sum_following, Magnitudes(other));
    }
    const V32 alpha_bits = hn::Set(k32, 0xFF000000U);
    Left left;
    left.follows_green = Total(sum_following) < Total(sum_apart);
    left.opaque =
        hn::AllTrue(k32, hn::Eq(hn::And(hn::BitCast(k32, all), alpha_bits), alpha_bits));
    const std::uint8_t* const chosen =
        left.follows_green ? following.data() : apart.data();
    V64 colors = hn::Zero(k64);
    V64 alphas = hn::Zero(k64);
    for (std::size_t i = 0; i < kBrickPixels; i += hn::Lanes(k8)) {
        V8 red;
        V8 green;
        V8 blue;
        V8 alpha;
        hn::LoadInterleaved4(k8, chosen + 4 * i, red, green, blue, alpha);
        std::size_t row = i / kBrickSide;
        for (const V8& plane : {green, red, blue}) {
            colors = hn::Or(
                colors,
                PackPlane(plane, rows.bytes.data() + row, rows.row_class.data() + row));
            row += kBrickSide;
        }
        alphas = hn::Or(
            alphas,
            PackPlane(alpha, rows.bytes.data() + row, rows.row_class.data() + row));
    }
    left.colors = !hn::AllTrue(k64, hn::Eq(colors, hn::Zero(k64)));
    left.alpha = !hn::AllTrue(k64, hn::Eq(alphas, hn::Zero(k64)));
    return left;
}

void AddResiduals(const Residuals& residuals,
                  const Brick& predicted,
                  bool follows_green,
                  bool opaque,
                  Brick& brick) {
    const V8 follow = hn::Set(k8, static_cast<std::uint8_t>(follows_green ? 255 : 0));
    const V8 filled = hn::BitCast(k8, hn::Set(k32, opaque ? 0xFF000000U : 0));
    alignas(64) std::array<std::uint8_t, kBytes> off;
    for (std::size_t i = 0; i < kBrickPixels; i += hn::Lanes(k8)) {
        const auto plane = [&](std::size_t number) {
            return hn::LoadU(k8, residuals.data() + number * kBrickPixels + i);
        };
        const V8 green = plane(0);
        const V8 both = hn::And(green, follow);
        hn::StoreInterleaved4(hn::Add(plane(1), both),
                              green,
                              hn::Add(plane(2), both),
                              plane(3),
                              k8,
                              off.data() + 4 * i);
    }
    for (std::size_t i = 0; i < kBytes; i += hn::Lanes(k8)) {
        const V8 pixels = hn::Or(
            filled,
            hn::Add(hn::LoadU(k8, BytesOf(predicted) + i), hn::Load(k8, off.data() + i)));
        hn::StoreU(hn::And(pixels, NotClear(pixels)), k8, BytesOf(brick) + i);
    }
}

#endif  // HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace haarmony::video
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace haarmony::video {
namespace {

HWY_EXPORT(Deviation);
HWY_EXPORT(Shift);
HWY_EXPORT(Smooth);
HWY_EXPORT(PackResiduals);
HWY_EXPORT(AddResiduals);

static_assert(std::endian::native == std::endian::little);

}  // namespace

std::uint32_t deviation(const Brick& a, const Brick& b) {
    return HWY_DYNAMIC_DISPATCH(Deviation)(a, b);
}

void shift(const Brick& base, const Brick& to, const Brick& from, Brick& out) {
    HWY_DYNAMIC_DISPATCH(Shift)(base, to, from, out);
}

void smooth(const Brick& coarse, int quadrant, Brick& out) {
    HWY_DYNAMIC_DISPATCH(Smooth)(coarse, quadrant, out);
}

Left pack_residuals(const Brick& brick, const Brick& predicted, PackedRows& rows) {
    return HWY_DYNAMIC_DISPATCH(PackResiduals)(brick, predicted, rows);
}

void add_residuals(const Residuals& residuals,
                   const Brick& predicted,
                   bool follows_green,
                   bool opaque,
                   Brick& brick) {
    HWY_DYNAMIC_DISPATCH(AddResiduals)
    (residuals, predicted, follows_green, opaque, brick);
}

}  // namespace haarmony::video
#endif  // HWY_ONCE
