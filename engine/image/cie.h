// RGB to CIE L*a*b* and L*u*v*, both divided by 100 (image search, part of step 1 of 5):
//   resample.h -> color_space.h, [cie.h] -> haar.h -> truncation.h -> signature.h
//
// Everything is written with differences between X, Y and Z, each divided by its white, so
// that R = G = B gives a* = b* = u* = v* = 0 exactly. The cube root is our own: the
// library's may differ between machines, and signatures may not.
//
// Units   R, G, B in [0, 1] with the sRGB curve; L* / 100 in [0, 1].
// Scale   white is D65, the sum of the primaries: white has L* = 100.
// Errors  none.
// Source  CIE 15:2004 for the spaces; IEC 61966-2-1 for the curve and the primaries.
#pragma once

#include "engine/image/color_planes.h"

namespace haarmony::image {

// Replaces R, G, B by L*, a*, b* or L*, u*, v*. Requires: every value in [0, 1].
void rgb_to_lab(ColorPlanes& planes);
void rgb_to_luv(ColorPlanes& planes);

}  // namespace haarmony::image
