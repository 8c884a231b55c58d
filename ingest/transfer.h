// Linear light to sRGB bytes, for sources that store light itself (OpenEXR, float TIFF,
// PNG with gamma 1).
//
// Units   in: linear, 0 = black, 1 = white; out: 0..255.
// Errors  none: below 0 and not-a-number are 0, above 1 is 255.
// Threads const-safe.
// Source  IEC 61966-2-1.
#pragma once

#include <cstdint>

namespace haarmony::ingest {

[[nodiscard]] std::uint8_t linear_to_srgb(float linear);

}  // namespace haarmony::ingest
