// The twelve operators of Porter and Duff, on pixels and on whole frames.
//   image_tree.h -> [composite.h] -> compose.h
//
// Scale    Fa and Fb in 0 .. 255; the result's alpha is (Fa aA + Fb aB) / 255, its colour
//          the mean weighted with Fa aA and Fb aB, each rounded once, half up; clear is
//          clear.
// Errors   parse_operator names the word that is no operator, param op.
// Source   sec. 5.3.3, CompositePixels(), CompositeFrames(), on leaf frames; ERRATA of
//          the project, video 22 to 24.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "engine/core/result.h"
#include "engine/video/image_tree.h"
#include "engine/video/ops/leaf_tree.h"

namespace haarmony::video {

enum class Operator : std::uint8_t {
    kNeither,
    kA,
    kB,
    kAOverB,
    kBOverA,
    kAInB,
    kBInA,
    kAOutB,
    kBOutA,
    kAAtopB,
    kBAtopA,
    kXor,
};
inline constexpr std::array<std::string_view, 12> kOperatorNames = {"clear",
                                                                    "a",
                                                                    "b",
                                                                    "a_over_b",
                                                                    "b_over_a",
                                                                    "a_in_b",
                                                                    "b_in_a",
                                                                    "a_out_b",
                                                                    "b_out_a",
                                                                    "a_atop_b",
                                                                    "b_atop_a",
                                                                    "xor"};

[[nodiscard]] constexpr std::string_view name_of(Operator op) {
    return kOperatorNames[static_cast<std::size_t>(op)];
}
[[nodiscard]] Result<Operator> parse_operator(std::string_view name);

[[nodiscard]] Rgba composite(Rgba a, Rgba b, Operator op);

// Frames of the same space levels, walked in lock-step: what is flat in both stays flat.
// Cost: linear in the squares of both.
// Requires: `out` is neither of them.
Visited composite(const ImageTree& a, const ImageTree& b, Operator op, ImageTree& out);

}  // namespace haarmony::video
