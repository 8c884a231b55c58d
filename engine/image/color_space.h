// RGB to the colour space that a signature is made in (image search, step 1 of 5):
//   resample.h -> [color_space.h] -> haar.h -> truncation.h -> signature.h
//
// Shape   channel 0 is the intensity, the one that Table 4.1's weights of Y are meant for
//         (V of HSV, L* of Lab and Luv); RGB, which has none, stays R, G, B.
// Units   R, G, B, Y, V in [0, 1]; I and Q in their own ranges; L*a*b* and L*u*v* divided by
//         100; hue is an angle and would jump at red, so HSV is V, S cos H, S sin H.
// Scale   R = G = B gives exactly no chroma in every space that has any: a grey picture has
//         no chroma coefficients, not even of rounding noise.
// Errors  none.
// Source  sec. 4.2.2 (item 1); sec. 4.6 for Lab and Luv; the NTSC matrix of YIQ, which the
//         dissertation does not print.
#pragma once

#include <string_view>

#include "engine/image/color_planes.h"
#include "engine/image/signature_kind.h"

namespace haarmony::image {

inline constexpr double kMaxI = 0.595716;
inline constexpr double kMaxQ = 0.522591;

// The values that a channel takes over the whole cube of R, G and B in [0, 1].
struct ChannelRange {
    double lowest = 0;
    double highest = 0;
};
// Requires: 0 <= channel < kChannels.
[[nodiscard]] ChannelRange channel_range(ColorSpace space, int channel);

// "Y", "S cos H", "L*" and the like, for messages. Requires: 0 <= channel < kChannels.
[[nodiscard]] std::string_view channel_name(ColorSpace space, int channel);

// Replaces R, G, B (sRGB, as the picture has them) by the channels of the space.
// Requires: every value in [0, 1]. Cost: one pass; the cube roots of Lab and Luv are the
// dearest part.
void convert(ColorSpace space, ColorPlanes& planes);

// Each of them alone. Requires: as convert().
void rgb_to_yiq(ColorPlanes& planes);
void rgb_to_hsv(ColorPlanes& planes);

}  // namespace haarmony::image
