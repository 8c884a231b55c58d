// A handwritten stroke distilled into a few signed details, as pictures are for a search.
//   fit.h, frame.h -> [stroke_signature.h] -> stroke_index.h
//
// The stroke is taken at equal distances, moved to its mean, made upright and of unit size;
// the curve fitted to that is decomposed, and of its details the largest are kept, as where
// they are and their sign. HANDWRITING.md has how well that finds words again.
//
// Shape    a term is + or - (1 + 2 * (2^j - 1 + k) + axis): row k of D^j, axis 0 along the
//          frame's first direction and 1 across it; ascending by its size without the sign.
// Errors   none; a stroke of no length has no terms.
// Threads  const-thread-safe.
// Source   sec. 6.3, "Cursive handwriting recognition"; sec. 4.2.2 (truncation and
//          quantization).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/curve/frame.h"
#include "engine/curve/points.h"

namespace haarmony::curve {

inline constexpr int kSignatureLevel = 7;  // D^0 .. D^6
inline constexpr std::size_t kSignatureTerms = 60;
inline constexpr std::size_t kSignatureKeys = 2 * ((1 << kSignatureLevel) - 1);

struct StrokeSignature {
    std::vector<std::int16_t> terms;
    friend bool operator==(const StrokeSignature&, const StrokeSignature&) = default;
};

// `count` points at equal distances along the stroke, x and y: their mean is 0, their mean
// square 1, and steps in x and y are uncorrelated, which a slant (x grows with y) undoes.
// A stroke of no length is all 0. Requires: at least 2 finite samples, count >= 2.
[[nodiscard]] Points normalized_stroke(const Points& samples, std::size_t count);

// Of details in frames of this kind; kNormalized ones do not turn with the stroke. Signatures
// of different kinds do not compare. Requires: at least 2 finite samples.
[[nodiscard]] StrokeSignature stroke_signature(const Points& samples, Frame frame);

}  // namespace haarmony::curve
