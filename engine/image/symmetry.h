// The eight symmetries of a square, applied to a signature: the picture itself is not needed
// (image search, beside signature.h).
//
// Scale   exact in both decompositions: a mirror or a turn moves the coefficients and changes
//         signs, but no magnitude, and the averages stay. The standard coefficients of turned
//         pixels may differ from it by roundings, because rows come before columns there.
// Shape   the order of an index list is kept. Equal magnitudes are then no longer in the
//         order of their indices, and of those that tie for the last place others may have
//         been kept than make_signature() would keep of the turned picture.
// Errors  none.
// Source  sec. 4.3.1; ties: ARCHITECTURE.md ("Errata").
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "engine/image/signature.h"

namespace haarmony::image {

// Turns are clockwise; mirror_x swaps left and right; the transposes mirror in the diagonal
// that starts in the upper left corner, or in the other one.
enum class Symmetry : std::uint8_t {
    kIdentity,
    kMirrorX,
    kMirrorY,
    kTurn90,
    kTurn180,
    kTurn270,
    kTranspose,
    kAntiTranspose,
};

inline constexpr std::array<Symmetry, 8> kSymmetries = {Symmetry::kIdentity,
                                                        Symmetry::kMirrorX,
                                                        Symmetry::kMirrorY,
                                                        Symmetry::kTurn90,
                                                        Symmetry::kTurn180,
                                                        Symmetry::kTurn270,
                                                        Symmetry::kTranspose,
                                                        Symmetry::kAntiTranspose};

// "identity", "mirror_x", "mirror_y", "turn_90", "turn_180", "turn_270", "transpose" or
// "anti_transpose".
[[nodiscard]] std::string_view symmetry_name(Symmetry symmetry);
[[nodiscard]] std::optional<Symmetry> symmetry_from_name(std::string_view name);

// The one that undoes it.
[[nodiscard]] Symmetry inverse(Symmetry symmetry);

// `first`, and `second` of what comes out.
[[nodiscard]] Symmetry compose(Symmetry first, Symmetry second);

// Whether width and height change places: quarter turns and transposes.
[[nodiscard]] bool swaps_sides(Symmetry symmetry);

// The signature of the picture to which the symmetry was applied. Cost: its coefficients.
[[nodiscard]] Signature transformed(const Signature& signature, Symmetry symmetry);

}  // namespace haarmony::image
