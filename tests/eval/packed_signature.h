// Signatures as a speed run keeps millions of them: 60 coefficients a channel, no slack.
//
// Shape   376 bytes, trivially copyable. What a channel has beyond kPackedCoefficients is
//         dropped; entries at and after `count` are 0, so that equal signatures are equal
//         bytes.
// Units   those of engine/image/signature.h; the kind is the default one.
// Errors  none.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <type_traits>

#include "engine/image/signature.h"

namespace haarmony::eval {

inline constexpr int kPackedCoefficients = 60;

struct PackedSignature {
    std::array<std::int32_t, image::kChannels> average{};
    std::array<std::uint8_t, image::kChannels> count{};
    std::uint8_t low_information = 0;  // 0 or 1
    std::array<std::array<std::int16_t, kPackedCoefficients>, image::kChannels> indices{};

    // The m largest of a channel, or all there are. Requires: m >= 0.
    [[nodiscard]] std::span<const std::int16_t> largest(int channel, int m) const;
    friend bool operator==(const PackedSignature&, const PackedSignature&) = default;
};
static_assert(std::is_trivially_copyable_v<PackedSignature>);
static_assert(sizeof(PackedSignature) == 376);

// Requires: the default kind.
[[nodiscard]] PackedSignature pack(const image::Signature& signature);

// What pack() was given, but for the coefficients it drops.
[[nodiscard]] image::Signature unpack(const PackedSignature& packed);

}  // namespace haarmony::eval
