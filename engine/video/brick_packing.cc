#include "engine/video/brick_packing.h"

#include <bit>
#include <cassert>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/video/brick_packing.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace haarmony::video {
namespace HWY_NAMESPACE {

constexpr std::size_t kRowColors = 3 * kBrickSide;

#if HWY_TARGET == HWY_SCALAR

Rgba PixelAt(const PackedBrick& brick, std::size_t i) {
    const std::uint8_t* color = brick.colors->byte.data() + 3 * i;
    const std::uint8_t alpha = brick.alphas == nullptr ? 255 : brick.alphas->byte[i];
    return {color[0], color[1], color[2], alpha};
}

bool PackColors(const Brick& brick, BrickColors& colors) {
    bool opaque = true;
    std::uint8_t* out = colors.byte.data();
    for (const Rgba pixel : brick) {
        *out++ = pixel.r;
        *out++ = pixel.g;
        *out++ = pixel.b;
        opaque = opaque && pixel.a == 255;
    }
    return opaque;
}

void PutBricks(const BrickPut* puts, std::size_t count, std::ptrdiff_t stride) {
    for (const BrickPut* put = puts; put != puts + count; ++put) {
        for (std::size_t i = 0; i < kBrickPixels; ++i) {
            const auto y = static_cast<std::ptrdiff_t>(i / kBrickSide);
            put->out[y * stride + static_cast<std::ptrdiff_t>(i % kBrickSide)] =
                PixelAt(put->brick, i);
        }
    }
}

void PutDoubled(const PackedBrick& brick,
                std::size_t corner,
                Rgba* out,
                std::ptrdiff_t stride) {
    for (std::size_t y = 0; y < kBrickSide; ++y, out += stride) {
        for (std::size_t x = 0; x < kBrickSide; ++x) {
            out[x] = PixelAt(brick, corner + y / 2 * kBrickSide + x / 2);
        }
    }
}

bool SamePixels(const PackedBrick& packed, const Brick& brick) {
    for (std::size_t i = 0; i < kBrickPixels; ++i) {
        if (PixelAt(packed, i) != brick[i]) return false;
    }
    return true;
}

#else

namespace hn = hwy::HWY_NAMESPACE;

// Four pixels at a time, whatever the machine: half a row.
const hn::FixedTag<std::uint8_t, 16> kBytes;
const hn::FixedTag<std::uint32_t, 4> kPixels;
using Bytes = hn::Vec<decltype(kBytes)>;
using Pixels = hn::Vec<decltype(kPixels)>;

// Indices of bytes for TableLookupBytesOr0().
using Table = std::array<std::uint8_t, 16>;
constexpr std::uint8_t kZero = 0x80;

constexpr Table Spread(std::uint8_t first) {
    Table table{};
    for (std::uint8_t i = 0; i < 16; ++i) {
        table[i] =
            i % 4 == 3 ? kZero : static_cast<std::uint8_t>(first + i / 4 * 3 + i % 4);
    }
    return table;
}
// From the byte of the four pixels' colours that is `first`, to the place `begin`.
constexpr Table Gather(std::uint8_t first, std::uint8_t begin) {
    Table table{};
    for (std::uint8_t i = 0; i < 16; ++i) {
        const int color = first + i - begin;
        table[i] = i < begin || color >= 12
                       ? kZero
                       : static_cast<std::uint8_t>(color / 3 * 4 + color % 3);
    }
    return table;
}

HWY_INLINE Bytes Load(const Table& table) { return hn::LoadU(kBytes, table.data()); }

// The half of a row of colours that begins at `color`, and of alphas at `alpha`. The right
// half is read with the four bytes before it, so that nothing behind the row is.
template <bool kRight, bool kOpaque>
HWY_INLINE Pixels HalfRow(const std::uint8_t* color, const std::uint8_t* alpha) {
    static constexpr Table kSpread = Spread(kRight ? 4 : 0);
    const Bytes colors = hn::LoadU(kBytes, color - (kRight ? 4 : 0));
    const Pixels spread =
        hn::BitCast(kPixels, hn::TableLookupBytesOr0(colors, Load(kSpread)));
    if constexpr (kOpaque) return hn::Or(spread, hn::Set(kPixels, 0xFF00'0000));
    const hn::Rebind<std::uint8_t, decltype(kPixels)> four;
    const Pixels alphas = hn::PromoteTo(kPixels, hn::LoadU(four, alpha));
    return hn::Or(spread, hn::ShiftLeft<24>(alphas));
}

HWY_INLINE void Store(Pixels pixels, Rgba* out) {
    hn::StoreU(hn::BitCast(kBytes, pixels), kBytes, reinterpret_cast<std::uint8_t*>(out));
}
HWY_INLINE Bytes Load(const Rgba* pixels) {
    return hn::LoadU(kBytes, reinterpret_cast<const std::uint8_t*>(pixels));
}

bool PackColors(const Brick& brick, BrickColors& colors) {
    static constexpr Table kLeft = Gather(0, 0);
    static constexpr Table kLeftEnd = Gather(8, 0);
    static constexpr Table kRight = Gather(0, 4);
    Bytes all = hn::Set(kBytes, 255);
    std::uint8_t* out = colors.byte.data();
    for (std::size_t i = 0; i < kBrickPixels; i += kBrickSide, out += kRowColors) {
        const Bytes left = Load(&brick[i]);
        const Bytes right = Load(&brick[i + kBrickSide / 2]);
        all = hn::And(all, hn::And(left, right));
        // The second store writes the last four bytes of the left half again.
        hn::StoreU(hn::TableLookupBytesOr0(left, Load(kLeft)), kBytes, out);
        hn::StoreU(hn::Or(hn::TableLookupBytesOr0(left, Load(kLeftEnd)),
                          hn::TableLookupBytesOr0(right, Load(kRight))),
                   kBytes,
                   out + 8);
    }
    const Pixels opaque = hn::Set(kPixels, 0xFF00'0000);
    return hn::AllTrue(kPixels,
                       hn::Eq(hn::And(hn::BitCast(kPixels, all), opaque), opaque));
}

template <bool kOpaque>
HWY_INLINE void PutBrick(const PackedBrick& brick, Rgba* out, std::ptrdiff_t stride) {
    const std::uint8_t* color = brick.colors->byte.data();
    const std::uint8_t* alpha = kOpaque ? nullptr : brick.alphas->byte.data();
    for (int y = 0; y < kBrickSide; ++y, color += kRowColors, out += stride) {
        Store(HalfRow<false, kOpaque>(color, alpha), out);
        if constexpr (!kOpaque) alpha += kBrickSide / 2;
        Store(HalfRow<true, kOpaque>(color + kRowColors / 2, alpha),
              out + kBrickSide / 2);
        if constexpr (!kOpaque) alpha += kBrickSide / 2;
    }
}

void PutBricks(const BrickPut* puts, std::size_t count, std::ptrdiff_t stride) {
    for (const BrickPut* put = puts; put != puts + count; ++put) {
        if (put->brick.alphas == nullptr)
            PutBrick<true>(put->brick, put->out, stride);
        else
            PutBrick<false>(put->brick, put->out, stride);
    }
}

template <bool kRight, bool kOpaque>
HWY_INLINE void PutDoubledHalf(const std::uint8_t* color,
                               const std::uint8_t* alpha,
                               Rgba* out,
                               std::ptrdiff_t stride) {
    for (int y = 0; y < kBrickSide / 2; ++y, color += kRowColors, out += 2 * stride) {
        const Pixels four = HalfRow<kRight, kOpaque>(color, alpha);
        const Pixels left = hn::InterleaveLower(kPixels, four, four);
        const Pixels right = hn::InterleaveUpper(kPixels, four, four);
        for (Rgba* row : {out, out + stride}) {
            Store(left, row);
            Store(right, row + kBrickSide / 2);
        }
        if constexpr (!kOpaque) alpha += kBrickSide;
    }
}

void PutDoubled(const PackedBrick& brick,
                std::size_t corner,
                Rgba* out,
                std::ptrdiff_t stride) {
    const bool right = corner % kBrickSide != 0;
    const std::uint8_t* color = brick.colors->byte.data() + 3 * corner;
    if (brick.alphas == nullptr) {
        right ? PutDoubledHalf<true, true>(color, nullptr, out, stride)
              : PutDoubledHalf<false, true>(color, nullptr, out, stride);
    } else {
        const std::uint8_t* alpha = brick.alphas->byte.data() + corner;
        right ? PutDoubledHalf<true, false>(color, alpha, out, stride)
              : PutDoubledHalf<false, false>(color, alpha, out, stride);
    }
}

template <bool kOpaque>
HWY_INLINE bool SameAs(const PackedBrick& packed, const Brick& brick) {
    const std::uint8_t* color = packed.colors->byte.data();
    const std::uint8_t* alpha = kOpaque ? nullptr : packed.alphas->byte.data();
    for (std::size_t i = 0; i < kBrickPixels; i += kBrickSide, color += kRowColors) {
        const Pixels left = HalfRow<false, kOpaque>(color, alpha);
        if constexpr (!kOpaque) alpha += kBrickSide / 2;
        const Pixels right = HalfRow<true, kOpaque>(color + kRowColors / 2, alpha);
        if constexpr (!kOpaque) alpha += kBrickSide / 2;
        const auto same = hn::And(
            hn::Eq(left, hn::BitCast(kPixels, Load(&brick[i]))),
            hn::Eq(right, hn::BitCast(kPixels, Load(&brick[i + kBrickSide / 2]))));
        if (!hn::AllTrue(kPixels, same)) return false;
    }
    return true;
}

bool SamePixels(const PackedBrick& packed, const Brick& brick) {
    return packed.alphas == nullptr ? SameAs<true>(packed, brick)
                                    : SameAs<false>(packed, brick);
}

#endif  // HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace haarmony::video
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace haarmony::video {
namespace {

HWY_EXPORT(PackColors);
HWY_EXPORT(PutBricks);
HWY_EXPORT(PutDoubled);
HWY_EXPORT(SamePixels);

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t kHalf = kBrickSide / 2;

// Where quadrant q begins.
std::size_t corner_of(int q) {
    assert(q >= 0 && q < 4);
    return (static_cast<std::size_t>(q) >> 1) * kHalf * kBrickSide +
           (static_cast<std::size_t>(q) & 1) * kHalf;
}

// The alphas of half a row.
std::uint32_t four_alphas(const BrickAlphas* alphas, std::size_t pixel) {
    std::uint32_t four = 0xFFFF'FFFF;
    if (alphas != nullptr) std::memcpy(&four, alphas->byte.data() + pixel, sizeof(four));
    return four;
}

}  // namespace

bool pack(const Brick& brick, BrickColors& colors, BrickAlphas& alphas) {
    const bool opaque = HWY_DYNAMIC_DISPATCH(PackColors)(brick, colors);
    if (opaque) return true;
    for (std::size_t i = 0; i < brick.size(); ++i) alphas.byte[i] = brick[i].a;
    return false;
}

void put_bricks(std::span<const BrickPut> puts, std::ptrdiff_t stride) {
    HWY_DYNAMIC_DISPATCH(PutBricks)(puts.data(), puts.size(), stride);
}

void put_doubled(const PackedBrick& brick, int q, Rgba* out, std::ptrdiff_t stride) {
    HWY_DYNAMIC_DISPATCH(PutDoubled)(brick, corner_of(q), out, stride);
}

bool same_pixels(const PackedBrick& packed, const Brick& brick) {
    return HWY_DYNAMIC_DISPATCH(SamePixels)(packed, brick);
}

bool same_pixels(const PackedBrick& a, const PackedBrick& b) {
    if (std::memcmp(a.colors, b.colors, sizeof(BrickColors)) != 0) return false;
    if (a.alphas == nullptr || b.alphas == nullptr) return a.alphas == b.alphas;
    return std::memcmp(a.alphas, b.alphas, sizeof(BrickAlphas)) == 0;
}

bool same_quadrant(const PackedBrick& a, const PackedBrick& b, int q) {
    const std::size_t corner = corner_of(q);
    for (std::size_t y = 0; y < kHalf; ++y) {
        const std::size_t pixel = corner + y * kBrickSide;
        if (std::memcmp(a.colors->byte.data() + 3 * pixel,
                        b.colors->byte.data() + 3 * pixel,
                        3 * kHalf) != 0) {
            return false;
        }
        if (four_alphas(a.alphas, pixel) != four_alphas(b.alphas, pixel)) return false;
    }
    return true;
}

}  // namespace haarmony::video
#endif  // HWY_ONCE
