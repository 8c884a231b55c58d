// From the sums over cells to their means, as floats or bytes (image search, inside step 0 of
// 5): area_kernel.h -> [area_mean.h]. Vector code chosen at run time; every choice does the
// same roundings and gives the same bits.
//
// Units   sums as in area_kernel.h; what they are divided by is the caller's.
// Errors  none; a wrong shape is a caller's bug and asserts.
#pragma once

#include <cstdint>
#include <span>

namespace haarmony::image {

// out[i] = sums[i] / scale, each rounded to double and then to float.
// Requires: sums below 2^31; `out` as long as `sums`.
void divide(std::span<const std::uint32_t> sums, double scale, std::span<float> out);

// out[i] = sums[i] * scale in floats, rounded to the nearest byte.
// Requires: sums below 2^31; results below 255.5; `out` as long as `sums`.
void scale_to_bytes(std::span<const std::uint32_t> sums,
                    float scale,
                    std::span<std::uint8_t> out);

// Takes red, green and blue apart. Requires: interleaved.size() == 3 * red.size(), the three
// planes of one size.
void take_apart(std::span<const float> interleaved,
                std::span<float> red,
                std::span<float> green,
                std::span<float> blue);

}  // namespace haarmony::image
