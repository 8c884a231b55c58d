// What is kept of one picture: its average colour and its largest wavelet coefficients
// (image search, step 3 of 5):
//   color_space.h -> haar.h -> [signature.h] -> segment_layout.h -> query.h
//
// Shape   three channels of one colour space; per channel up to kMaxCoefficients signed indices in
//         falling order of magnitude, ties by smaller index, so that every smaller m is
//         a prefix. A signed index is row * 128 + column, 1..16383, negative where the
//         coefficient is. A coefficient of exactly zero is never stored.
// Units   averages are fixed point: the channel's mean times 2^24, rounded.
// Errors  none at run time; a wrong shape is a caller's bug and asserts.
// Source  sec. 4.3.1; ERRATA of the project: zero coefficients, ties.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/image_view.h"
#include "engine/image/signature_kind.h"

namespace haarmony::image {

inline constexpr int kSide = 128;
inline constexpr int kCoefficientCount = kSide * kSide;
inline constexpr int kChannels = 3;
inline constexpr int kMaxCoefficients = 100;
inline constexpr int kAverageFractionBits = 24;
inline constexpr std::int64_t kAverageOne = std::int64_t{1} << kAverageFractionBits;

// The wavelet energy (the variance of the 128 x 128 cells, summed over Y, I and Q, whatever
// the signature's own kind, so that a picture is judged the same in every kind) below which a picture says too little to call another one its duplicate: a deviation of one
// level in 255, which is what rounding and compression leave on an empty page.
inline constexpr double kLowInformationEnergy = 1.0 / (255.0 * 255.0);

struct ChannelSignature {
    std::int32_t average = 0;
    std::uint8_t count = 0;
    std::array<std::int16_t, kMaxCoefficients>
        indices{};  // only [0, count) means anything

    // The m largest, or all there are. Requires: m >= 0.
    [[nodiscard]] std::span<const std::int16_t> largest(int m) const;
    friend bool operator==(const ChannelSignature& a, const ChannelSignature& b);
};

struct Signature {
    SignatureKind kind;
    std::array<ChannelSignature, kChannels> channels;
    bool low_information = false;  // less wavelet energy than kLowInformationEnergy

    friend bool operator==(const Signature&, const Signature&) = default;
};

// The signature of a picture of any size: area average to 128 x 128, the colour space of the
// kind, Haar, truncation. What is transparent does not count, see mask.h; a picture with
// nothing painted counts as black.
// Requires: width, height >= 1. Cost: one pass over the pixels.
[[nodiscard]] Signature make_signature(const ImageView& picture,
                                       const SignatureKind& kind);

// Of the kind YIQ, standard.
[[nodiscard]] Signature make_signature(const ImageView& picture);

// One signature for each kind, in their order, each what make_signature() gives.
// Requires: as there. Cost: one pass over the pixels for all of them; a colour space is
// converted to once where its kinds stand side by side.
[[nodiscard]] std::vector<Signature> make_signatures(
    const ImageView& picture,
    std::span<const SignatureKind> kinds);

}  // namespace haarmony::image
