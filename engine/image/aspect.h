// The shape of a picture as one term of the metric: the difference of the logarithms of
// width / height.
//
// Units   natural logarithm times 2^24 (kAverageOne), rounded: as the averages.
// Source  sec. 4.6, "Aspect ratio".
#pragma once

#include <cmath>
#include <cstdint>

#include "engine/image/signature.h"

namespace haarmony::image {

// Requires: width, height >= 1. Turning a picture by 90 degrees changes the sign alone.
[[nodiscard]] inline std::int32_t log_aspect(int width, int height) {
    const double logarithm = std::log(double(width)) - std::log(double(height));
    return static_cast<std::int32_t>(std::lround(logarithm * double{kAverageOne}));
}

}  // namespace haarmony::image
