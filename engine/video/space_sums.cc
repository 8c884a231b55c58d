#include "engine/video/space_sums.h"

#include <array>
#include <bit>
#include <cassert>

namespace haarmony::video {
namespace {

constexpr std::size_t kSide = kBrickSide;
constexpr std::size_t kHalf = kBrickSide / 2;

// Pixel i of quadrant q.
constexpr std::size_t in_quadrant(std::size_t q, std::size_t i) {
    return quadrant_corner(q) + i / kHalf * kSide + i % kHalf;
}

}  // namespace

void SpaceSums::begin(std::uint64_t frames, int levels_below, bool opaque) {
    frames_ = frames;
    log2_area_ = 2 * levels_below;
    is_opaque_ = opaque && samples() <= kMostOpaqueSamples;
    is_wide_ = !is_opaque_ && samples() > kMostSamples;
}

void SpaceSums::take(const ShortSums& sums, std::size_t q) {
    if (!is_opaque_) return take_each(sums, q);
    take_planes(sums, q);
}

void SpaceSums::take(const NarrowSums& sums, std::size_t q) {
    assert(!is_opaque_);
    if (is_wide_) return take_each(sums, q);
    take_planes(sums, q);
}

void SpaceSums::take(const WideSums& sums, std::size_t q) {
    assert(is_wide_);
    take_each(sums, q);
}

void SpaceSums::take_finest(const ShortSums& sums) {
    assert(is_opaque_ && log2_area_ == 0);
    widen(sums, narrow_);
}

void SpaceSums::take_finest(const NarrowSums& sums) {
    assert(!is_opaque_ && !is_wide_ && log2_area_ == 0);
    narrow_ = sums;
}

void SpaceSums::take_finest(const WideSums& sums) {
    assert(is_wide_ && log2_area_ == 0);
    wide_ = sums;
}

void SpaceSums::take(const SpaceSums& below, std::size_t q) {
    if (is_wide_) {
        std::array<PixelSum, kBrickPixels> finer;
        for (std::size_t i = 0; i < finer.size(); ++i) finer[i] = below.at(i);
        for (std::size_t i = 0; i < kBrickPixels / 4; ++i) {
            put(in_quadrant(q, i),
                sum_of_four(finer.data(), kSide, i % kHalf, i / kHalf));
        }
        return;
    }
    assert(!below.is_wide_ && (below.is_opaque_ || !is_opaque_));
    halve(below.narrow_, below.is_opaque_ ? 3 : 4, quadrant_corner(q), narrow_);
    if (below.is_opaque_ && !is_opaque_) weigh(q);
}

PixelSum SpaceSums::at(std::size_t i) const {
    if (is_wide_) return sum_at(wide_, frames_, i);
    if (!is_opaque_) return sum_at(narrow_, frames_, i);
    const auto weighed = [this, i](std::size_t plane) {
        return std::uint64_t{255} * narrow_[plane][i];
    };
    return {weighed(0), weighed(1), weighed(2), 255 * samples()};
}

void SpaceSums::mean_into(PixelWords& means) const {
    if (is_wide_) {
        for (std::size_t i = 0; i < kBrickPixels; ++i) {
            means[i] = std::bit_cast<std::uint32_t>(mean(at(i), samples()));
        }
    } else if (is_opaque_) {
        mean_of_opaque(narrow_, static_cast<std::uint32_t>(samples()), means);
    } else {
        mean_of(narrow_, static_cast<std::uint32_t>(samples()), means);
    }
}

template <typename Sums>
void SpaceSums::take_planes(const Sums& sums, std::size_t q) {
    for (std::size_t plane = 0; plane < sums.size(); ++plane) {
        const auto* const from = sums[plane].data() + quadrant_corner(q);
        std::uint32_t* const to = narrow_[plane].data() + quadrant_corner(q);
        for (std::size_t y = 0; y < kHalf; ++y) {
            for (std::size_t x = 0; x < kHalf; ++x) {
                to[y * kSide + x] = std::uint32_t{from[y * kSide + x]} << log2_area_;
            }
        }
    }
}

template <typename Sums>
void SpaceSums::take_each(const Sums& sums, std::size_t q) {
    for (std::size_t i = 0; i < kBrickPixels / 4; ++i) {
        const std::size_t at = in_quadrant(q, i);
        const PixelSum sum = sum_at(sums, frames_, at);
        put(at,
            {sum.r << log2_area_,
             sum.g << log2_area_,
             sum.b << log2_area_,
             sum.a << log2_area_});
    }
}

// Sums of opaque pixels in a quadrant become sums as those of any.
void SpaceSums::weigh(std::size_t q) {
    const auto alpha = static_cast<std::uint32_t>(255 * samples());
    for (std::size_t i = 0; i < kBrickPixels / 4; ++i) {
        const std::size_t at = in_quadrant(q, i);
        for (std::size_t plane = 0; plane < 3; ++plane) narrow_[plane][at] *= 255;
        narrow_[3][at] = alpha;
    }
}

void SpaceSums::put(std::size_t at, const PixelSum& sum) {
    const std::array<std::uint64_t, 4> channels = {sum.r, sum.g, sum.b, sum.a};
    for (std::size_t plane = 0; plane < channels.size(); ++plane) {
        if (is_wide_) {
            wide_[plane][at] = channels[plane];
        } else {
            narrow_[plane][at] = static_cast<std::uint32_t>(channels[plane]);
        }
    }
}

}  // namespace haarmony::video
