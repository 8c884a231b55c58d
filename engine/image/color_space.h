// RGB to YIQ (image search, step 1 of 5):
//   resample.h -> [color_space.h] -> haar.h -> truncation.h -> signature.h
//
// Written with differences to G, so that R = G = B gives Y = G and I = Q = 0 exactly: a
// grey picture has no chroma coefficients, not even of rounding noise.
//
// Units   R, G, B in [0, 1]; Y in [0, 1], I in [-kMaxI, kMaxI], Q in [-kMaxQ, kMaxQ].
// Errors  none.
// Source  sec. 4.2.2 (item 1) chooses YIQ; the matrix is that of the NTSC primaries, which
//         the dissertation does not print.
#pragma once

#include "engine/image/color_planes.h"

namespace haarmony::image {

inline constexpr double kMaxI = 0.595716;
inline constexpr double kMaxQ = 0.522591;

// Replaces R, G, B by Y, I, Q.
void rgb_to_yiq(ColorPlanes& planes);

}  // namespace haarmony::image
