// Three square channels of one picture, as every step up to the signature passes them on
// (image search, between the steps):
//   resample.h -> color_space.h -> haar.h -> truncation.h -> signature.h
//
// Shape   three planes (R, G, B or Y, I, Q), each kSide x kSide floats, row-major.
//         192 KiB: it belongs on the heap.
#pragma once

#include <array>

#include "engine/image/signature.h"

namespace haarmony::image {

using Plane = std::array<float, kCoefficientCount>;
using ColorPlanes = std::array<Plane, kChannels>;

}  // namespace haarmony::image
