// The sums of the 64 pixels of a square over space and time: each of all of the finest pixels
// that it stands for, in all frames.
//   sum_kernel.h -> [space_sums.h] -> exact_mean.h
//
// Shape   filled quadrant by quadrant: from the square below it, or from sums over time alone,
//         where there is nothing finer.
// Errors  none; a wrong argument is a caller's bug and asserts.
// Source  sec. 5.3.1, AverageChildren(); ERRATA of the project, video 14, 15.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/video/sum_brick.h"
#include "engine/video/sum_kernel.h"

namespace haarmony::video {

class SpaceSums {
  public:
    // begin() and the quadrants fill it; to clear it first would cost as much again.
    SpaceSums() {}

    // Each pixel stands for so many samples: 4^levels_below in each of the frames.
    // `opaque`: all that is filled in will be (is_opaque(), or short sums).
    void begin(std::uint64_t frames, int levels_below, bool opaque);
    // Quadrant q of a brick of sums over time.
    void take(const ShortSums& sums, std::size_t q);
    void take(const NarrowSums& sums, std::size_t q);
    void take(const WideSums& sums, std::size_t q);
    // All four quadrants. Requires: begin() was told that these are the finest pixels.
    void take_finest(const ShortSums& sums);
    void take_finest(const NarrowSums& sums);
    void take_finest(const WideSums& sums);
    // The square below quadrant q.
    void take(const SpaceSums& below, std::size_t q);

    // Whether every sample was opaque, as far as is known.
    [[nodiscard]] bool is_opaque() const { return is_opaque_; }
    [[nodiscard]] std::uint64_t samples() const { return frames_ << log2_area_; }
    [[nodiscard]] PixelSum at(std::size_t i) const;
    void mean_into(PixelWords& means) const;

  private:
    template <typename Sums>
    void take_planes(const Sums& sums, std::size_t q);
    template <typename Sums>
    void take_each(const Sums& sums, std::size_t q);
    void weigh(std::size_t q);
    void put(std::size_t at, const PixelSum& sum);

    std::uint64_t frames_;
    int log2_area_;
    bool is_opaque_;  // then narrow_ has sums of colour alone, and no plane a
    bool is_wide_;
    NarrowSums narrow_;
    WideSums wide_;
};

}  // namespace haarmony::video
