// The contexts of a chunk's symbols: what a symbol is about, and how much it is likely to
// deviate from its prediction. Symbols of similar contexts share one table of frequencies.
//   [symbol_context.h] -> symbol_coder.h -> brick_coder.h, layer_coder.h, time_node_coder.h
//
// Shape   one numbering for all chunks, in the order below; MRV.md has it as a table.
#pragma once

namespace haarmony::video {

// Colour residuals: by kind of prediction, plane (green; red and blue) and activity.
inline constexpr int kActivities =
    9;  // 0 .. 7 by the residuals around, 8: the first pixel
inline constexpr int kColorPlanes = 2;
enum class Residual { kPlain, kCorner, kMirror, kMirrorSame, kMirrorBelow, kMirrorAbove };
inline constexpr int kResidualKinds = 6;

inline constexpr int kColorContext = 0;
inline constexpr int kAlphaContext =
    kColorContext + kResidualKinds * kColorPlanes * kActivities;
inline constexpr int kModeContext = kAlphaContext + kActivities;  // by the mode before
inline constexpr int kReferences = 6;
inline constexpr int kAlphaModeContext = kModeContext + kReferences;
inline constexpr int kAlphaModes = 3;
inline constexpr int kBrickRefContext = kAlphaModeContext + kAlphaModes;
inline constexpr int kRefKinds = 6;
inline constexpr int kChildRefContext = kBrickRefContext + kRefKinds;
inline constexpr int kExplicitContext = kChildRefContext + kRefKinds;  // 5 bytes of a ref
inline constexpr int kExplicitBytes = 5;
inline constexpr int kRootContext = kExplicitContext + kExplicitBytes;
inline constexpr int kBoundsContext =
    kRootContext + kRefKinds;                            // 4 bytes of a coordinate
inline constexpr int kApexContext = kBoundsContext + 5;  // colour, alpha; by edge rule
inline constexpr int kContexts = kApexContext + 4;

[[nodiscard]] constexpr int color_context(Residual kind, int color_plane) {
    return kColorContext +
           (static_cast<int>(kind) * kColorPlanes + color_plane) * kActivities;
}

}  // namespace haarmony::video
