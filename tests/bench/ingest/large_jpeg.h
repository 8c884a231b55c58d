// JPEGs of about four megapixels, made from smaller pictures.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/image_view.h"

namespace haarmony::bench {

inline constexpr double kLargePixels = 4e6;

// The picture enlarged to kLargePixels by linear interpolation, as a JPEG of quality 90.
// `grain` is the deviation of the noise that is added to each sample, in levels of 255: what
// is interpolated alone is smoother than what a camera sees. Requires: 1 or 3 channels.
[[nodiscard]] std::vector<std::uint8_t> large_jpeg(const ImageView& picture,
                                                   double grain,
                                                   unsigned seed);

}  // namespace haarmony::bench
