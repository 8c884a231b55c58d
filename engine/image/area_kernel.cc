#include "engine/image/area_kernel.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/image/area_kernel.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// Shared by all targets: read once, by the first of them.
#ifndef HAARMONY_ENGINE_IMAGE_AREA_KERNEL
#define HAARMONY_ENGINE_IMAGE_AREA_KERNEL
namespace haarmony::image {
namespace {

void sum_samples(const std::uint8_t* top,
                 std::ptrdiff_t stride,
                 std::size_t samples,
                 const Overlap& rows,
                 std::uint32_t whole,
                 std::uint32_t* sums) {
    for (std::size_t i = 0; i < samples; ++i) {
        const std::uint8_t* sample = top + i;
        std::uint32_t sum = rows.first_weight * *sample;
        for (int y = rows.first + 1; y <= rows.last; ++y) {
            sample += stride;
            sum += (y == rows.last ? rows.last_weight : whole) * *sample;
        }
        sums[i] = sum;
    }
}

template <int kDepth>
void sum_cells(const std::uint32_t* sums,
               std::span<const Overlap> across,
               std::uint32_t whole,
               std::uint32_t* cells) {
    for (const Overlap& column : across) {
        for (int c = 0; c < kDepth; ++c) {
            std::uint32_t between = 0;
            for (int x = column.first + 1; x < column.last; ++x) {
                between += sums[x * kDepth + c];
            }
            *cells++ = column.first_weight * sums[column.first * kDepth + c] +
                       whole * between +
                       column.last_weight * sums[column.last * kDepth + c];
        }
    }
}

}  // namespace
}  // namespace haarmony::image
#endif

HWY_BEFORE_NAMESPACE();
namespace haarmony::image {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

// The twin of the vector code, from the definition.
void SumBand(const std::uint8_t* top,
             std::ptrdiff_t stride,
             std::size_t samples,
             const Overlap& rows,
             std::uint32_t whole,
             std::uint32_t* sums) {
    sum_samples(top, stride, samples, rows, whole, sums);
}

void SumCells3(const std::uint32_t* sums,
               std::span<const Overlap> across,
               AreaSums::Widths,
               std::uint32_t whole,
               std::uint32_t* cells) {
    sum_cells<3>(sums, across, whole, cells);
}

#else

const hn::ScalableTag<std::uint16_t> kD16;
const hn::ScalableTag<std::uint32_t> kD32;
using V16 = hn::Vec<decltype(kD16)>;
using V32 = hn::Vec<decltype(kD32)>;

// The most rows whose bytes can be added up in 16 bits.
constexpr int kRowsIn16Bits = 257;

// Samples 4i, 4i + 1, 4i + 2 and 4i + 3 of a run of bytes, in a vector each: bytes are never
// widened one by one, only masked and shifted where they lie.
struct Quarters {
    V32 q0, q1, q2, q3;
};

// Bytes 2i and 2i + 1.
struct Halves {
    V16 even, odd;
};

HWY_INLINE Halves load_halves(const std::uint8_t* bytes) {
    const hn::Repartition<std::uint8_t, decltype(kD16)> d8;
    const V16 both = hn::BitCast(kD16, hn::LoadU(d8, bytes));
    return {hn::And(both, hn::Set(kD16, 0xFF)), hn::ShiftRight<8>(both)};
}

HWY_INLINE Quarters widen(const Halves& halves) {
    const V32 even = hn::BitCast(kD32, halves.even);
    const V32 odd = hn::BitCast(kD32, halves.odd);
    const V32 low = hn::Set(kD32, 0xFFFF);
    return {hn::And(even, low),
            hn::And(odd, low),
            hn::ShiftRight<16>(even),
            hn::ShiftRight<16>(odd)};
}

HWY_INLINE void add(Quarters& sum, const Quarters& more) {
    sum.q0 = hn::Add(sum.q0, more.q0);
    sum.q1 = hn::Add(sum.q1, more.q1);
    sum.q2 = hn::Add(sum.q2, more.q2);
    sum.q3 = hn::Add(sum.q3, more.q3);
}

HWY_INLINE Quarters weighted(const Halves& halves, std::uint32_t weight) {
    const V16 factor = hn::Set(kD16, static_cast<std::uint16_t>(weight));
    return widen({hn::Mul(halves.even, factor), hn::Mul(halves.odd, factor)});
}

// A run of samples of all rows of a band.
HWY_INLINE void sum_run(const std::uint8_t* top,
                        std::ptrdiff_t stride,
                        const Overlap& rows,
                        std::uint32_t whole,
                        std::uint32_t* HWY_RESTRICT sums) {
    Quarters sum = weighted(load_halves(top), rows.first_weight);
    if (rows.last > rows.first) {
        const std::uint8_t* const bottom = top + (rows.last - rows.first) * stride;
        add(sum, weighted(load_halves(bottom), rows.last_weight));
        const V32 factor = hn::Set(kD32, whole);
        // Counted: rows may lie in any order in memory.
        const std::uint8_t* row = top;
        for (int left = rows.last - rows.first - 1; left > 0;) {
            Halves between = load_halves(row += stride);
            const int more = std::min(left, kRowsIn16Bits) - 1;
            for (int i = 0; i < more; ++i) {
                const Halves next = load_halves(row += stride);
                between.even = hn::Add(between.even, next.even);
                between.odd = hn::Add(between.odd, next.odd);
            }
            left -= more + 1;
            Quarters wide = widen(between);
            wide.q0 = hn::Mul(wide.q0, factor);
            wide.q1 = hn::Mul(wide.q1, factor);
            wide.q2 = hn::Mul(wide.q2, factor);
            wide.q3 = hn::Mul(wide.q3, factor);
            add(sum, wide);
        }
    }
    hn::StoreInterleaved4(sum.q0, sum.q1, sum.q2, sum.q3, kD32, sums);
}

void SumBand(const std::uint8_t* top,
             std::ptrdiff_t stride,
             std::size_t samples,
             const Overlap& rows,
             std::uint32_t whole,
             std::uint32_t* HWY_RESTRICT sums) {
    const std::size_t run = 2 * hn::Lanes(kD16);
    if (samples < run) {
        return sum_samples(top, stride, samples, rows, whole, sums);
    }
    for (std::size_t i = 0; i + run <= samples; i += run) {
        sum_run(top + i, stride, rows, whole, sums + i);
    }
    // What is left over, and as much before it as makes a run.
    const std::size_t last = samples - run;
    sum_run(top + last, stride, rows, whole, sums + last);
}

// One lane a channel, and one that belongs to the next pixel and is overwritten by the next
// cell: `sums` and `cells` have room for it.
const hn::FixedTag<std::uint32_t, 4> kD4;
using V4 = hn::Vec<decltype(kD4)>;

HWY_INLINE V4 weighted_pixel(const std::uint32_t* pixel, std::uint32_t weight) {
    return hn::Mul(hn::LoadU(kD4, pixel), hn::Set(kD4, weight));
}

// Cells of at most three pixels: always three terms, a weight of 0 where there is none.
// Whether a cell has two or three changes from cell to cell, and no jump could foretell it.
void sum_narrow(const std::uint32_t* HWY_RESTRICT sums,
                std::span<const Overlap> across,
                std::uint32_t whole,
                std::uint32_t* HWY_RESTRICT cells) {
    for (const Overlap& column : across) {
        const std::uint32_t* const first = sums + std::ptrdiff_t{column.first} * 3;
        const std::uint32_t* const last = sums + std::ptrdiff_t{column.last} * 3;
        const bool has_middle = column.last - column.first > 1;
        const V4 ends = hn::Add(weighted_pixel(first, column.first_weight),
                                weighted_pixel(last, column.last_weight));
        const V4 middle =
            weighted_pixel(last - (has_middle ? 3 : 0), has_middle ? whole : 0);
        hn::StoreU(hn::Add(ends, middle), kD4, cells);
        cells += 3;
    }
}

// Cells of three to five pixels, likewise.
void sum_medium(const std::uint32_t* HWY_RESTRICT sums,
                std::span<const Overlap> across,
                std::uint32_t whole,
                std::uint32_t* HWY_RESTRICT cells) {
    const V4 factor = hn::Set(kD4, whole);
    for (const Overlap& column : across) {
        const std::uint32_t* const first = sums + std::ptrdiff_t{column.first} * 3;
        const int between = column.last - column.first - 1;
        const V4 ends = hn::Add(weighted_pixel(first, column.first_weight),
                                weighted_pixel(first + std::ptrdiff_t{3} * (between + 1),
                                               column.last_weight));
        // The pixel after the first one between, and the one after that, where they exist.
        const V4 second =
            weighted_pixel(first + (between > 1 ? 6 : 0), between > 1 ? 1 : 0);
        const V4 third =
            weighted_pixel(first + (between > 2 ? 9 : 0), between > 2 ? 1 : 0);
        const V4 middle = hn::Add(hn::LoadU(kD4, first + 3), hn::Add(second, third));
        hn::StoreU(hn::Add(ends, hn::Mul(middle, factor)), kD4, cells);
        cells += 3;
    }
}

void sum_wide(const std::uint32_t* HWY_RESTRICT sums,
              std::span<const Overlap> across,
              std::uint32_t whole,
              std::uint32_t* HWY_RESTRICT cells) {
    const V4 factor = hn::Set(kD4, whole);
    for (const Overlap& column : across) {
        const std::uint32_t* pixel = sums + std::ptrdiff_t{column.first} * 3;
        V4 total = weighted_pixel(pixel, column.first_weight);
        V4 between = hn::Zero(kD4);
        for (int x = column.first + 1; x < column.last; ++x) {
            pixel += 3;
            between = hn::Add(between, hn::LoadU(kD4, pixel));
        }
        const std::uint32_t* const last = sums + std::ptrdiff_t{column.last} * 3;
        total = hn::Add(total, weighted_pixel(last, column.last_weight));
        hn::StoreU(hn::Add(total, hn::Mul(between, factor)), kD4, cells);
        cells += 3;
    }
}

void SumCells3(const std::uint32_t* HWY_RESTRICT sums,
               std::span<const Overlap> across,
               AreaSums::Widths widths,
               std::uint32_t whole,
               std::uint32_t* HWY_RESTRICT cells) {
    if (widths.most <= 2) {
        sum_narrow(sums, across, whole, cells);
    } else if (widths.fewest >= 2 && widths.most <= 4) {
        sum_medium(sums, across, whole, cells);
    } else {
        sum_wide(sums, across, whole, cells);
    }
}

#endif  // HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace haarmony::image
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace haarmony::image {
namespace {

HWY_EXPORT(SumBand);
HWY_EXPORT(SumCells3);

// A vector of four lanes may begin at the last sample.
constexpr std::size_t kSpareLanes = 3;

}  // namespace

Overlap overlap(int cell, int cells, int length) {
    const int begin = cell * length;
    const int end = begin + length;
    Overlap result;
    result.first = begin / cells;
    result.last = (end - 1) / cells;
    result.first_weight =
        static_cast<std::uint32_t>(std::min(end, (result.first + 1) * cells) - begin);
    if (result.last > result.first) {
        result.last_weight = static_cast<std::uint32_t>(end - result.last * cells);
    }
    return result;
}

bool AreaSums::fits(const ImageView& picture) {
    return std::int64_t{255} * picture.width * picture.height < std::int64_t{1} << 31;
}

AreaSums::AreaSums(const ImageView& picture, int columns, int rows)
    : picture_(picture), columns_(columns), rows_(rows) {
    assert(picture.pixels != nullptr && fits(picture));
    assert(picture.channels == 1 || picture.channels == 3);
    assert(columns >= 1 && columns <= kMaxAreaCells);
    assert(rows >= 1 && rows <= kMaxAreaCells);
    for (int i = 0; i < columns; ++i) {
        across_.push_back(overlap(i, columns, picture.width));
        const int steps = across_.back().last - across_.back().first;
        widths_.fewest = i == 0 ? steps : std::min(widths_.fewest, steps);
        widths_.most = std::max(widths_.most, steps);
    }
    const std::size_t channels = static_cast<std::size_t>(picture.channels);
    band_.resize(picture.width * channels + kSpareLanes);
    cells_.resize(columns * channels + kSpareLanes);
}

std::span<const std::uint32_t> AreaSums::row(int row) {
    assert(row >= 0 && row < rows_);
    const Overlap down = overlap(row, rows_, picture_.height);
    const std::size_t channels = static_cast<std::size_t>(picture_.channels);
    HWY_DYNAMIC_DISPATCH(SumBand)
    (picture_.row(down.first),
     picture_.row_stride,
     picture_.width * channels,
     down,
     static_cast<std::uint32_t>(rows_),
     band_.data());
    const auto whole = static_cast<std::uint32_t>(columns_);
    if (channels == 3) {
        HWY_DYNAMIC_DISPATCH(SumCells3)
        (band_.data(), across_, widths_, whole, cells_.data());
    } else {
        sum_cells<1>(band_.data(), across_, whole, cells_.data());
    }
    return {cells_.data(), columns_ * channels};
}

}  // namespace haarmony::image
#endif  // HWY_ONCE
