// The inner loops of the standard Haar decomposition and of truncation (image search, inside
// steps 2 and 3 of 5). Vector code chosen at run time; every choice does the same additions
// and multiplications in the same order, and gives the same bits.
//
// Shape   row-major, side x side, side a power of two in [1, kMaxSide].
// Errors  none; a wrong shape is a caller's bug and asserts.
// Threads const-safe.
#pragma once

#include <cstdint>
#include <span>

namespace haarmony::image {

// Every row by its means and half differences, coarse to fine.
void decompose_rows(std::span<float> plane, int side);

// Every column likewise, and each coefficient times scales[level][column]: level of the row,
// floor(log2) of its number, 0 for rows 0 and 1; `scales` has rows of kMaxSide.
void decompose_columns(std::span<float> plane, int side, const float* scales);

// Writes the places of the values whose magnitude is above the threshold, in rising order,
// and returns how many there are. Requires: values.size() <= 256; as much room in `places`.
[[nodiscard]] int places_above(std::span<const float> values,
                               float threshold,
                               std::uint8_t* places);

}  // namespace haarmony::image
