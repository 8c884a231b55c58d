// The channel that has given Haar coefficients (beside image search: showing what two
// signatures have in common):
//   haar.h -> [haar_inverse.h]
//
// Shape   row-major, side x side, side a power of two in [1, kMaxSide]; as decompose() leaves
//         them.
// Scale   the inverse of decompose(), up to roundings.
// Errors  none at run time; a wrong shape is a caller's bug and asserts.
// Source  sec. 2.3, synthesis; sec. 4.3.1 ("sufficient for reconstructing").
#pragma once

#include <span>

#include "engine/image/haar.h"

namespace haarmony::image {

// Replaces the coefficients by the channel. Requires: plane.size() == side * side.
// Cost: linear in it, without allocation.
void recompose(std::span<float> plane, int side, Decomposition decomposition);

}  // namespace haarmony::image
