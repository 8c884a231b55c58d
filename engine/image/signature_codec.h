// Signatures as bytes (in the database) and as text (in addresses and replies).
//
// Shape   see engine/image/FORMATS.md, "Signature", byte by byte.
// Errors  decoding validates everything: length, version, algorithm, colour space,
//         decomposition, decode rule, counts, ranges, repeated indices; kInvalidArgument
//         or, for a version above ours, kNewerVersion.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/image/signature.h"

namespace haarmony::image {

[[nodiscard]] std::vector<std::uint8_t> encode_signature(const Signature& signature);
[[nodiscard]] Result<Signature> decode_signature(std::span<const std::uint8_t> bytes);

// The same bytes in unpadded base64url, safe in an address.
[[nodiscard]] std::string signature_to_text(const Signature& signature);
[[nodiscard]] Result<Signature> signature_from_text(std::string_view text);

// The open form of the REST interface: averages as real numbers in the channel's unit,
// signed indices in falling order of magnitude. Any average and list that a picture could
// not have (outside the channel's range, index 0 or beyond 16383, an index twice, more than
// kMaxCoefficients) is refused by name.
struct OpenSignature {
    std::array<double, kChannels> average{};
    std::array<std::vector<int>, kChannels> coefficients;
};
[[nodiscard]] OpenSignature to_open(const Signature& signature);
[[nodiscard]] Result<Signature> from_open(const OpenSignature& open);

}  // namespace haarmony::image
