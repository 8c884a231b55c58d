// Signatures as bytes (in the database) and as text (in addresses and replies).
//
// Shape   see engine/image/FORMATS.md, "Signature", byte by byte.
// Errors  decoding validates everything: length, version, algorithm, colour space,
//         decomposition, decode rule, counts, ranges, repeated indices; kInvalidArgument
//         or, for a version above ours, kNewerVersion.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/image/signature.h"

namespace haarmony::image {

// The rule by which the pixels were won from the picture's file (ingest/decode.h); written
// into every signature and compared on reading. It rises when that rule changes, because
// signatures of different rules compare a little worse (about 3 % of the coefficients).
inline constexpr std::uint8_t kDecodeRule = 1;

// The longest and the shortest signature, in bytes.
inline constexpr std::size_t kSignatureHeaderBytes = 24;
inline constexpr std::size_t kMaxSignatureBytes =
    kSignatureHeaderBytes + std::size_t{2} * kChannels * kMaxCoefficients;

[[nodiscard]] std::vector<std::uint8_t> encode_signature(const Signature& signature);
[[nodiscard]] Result<Signature> decode_signature(std::span<const std::uint8_t> bytes);

// The same bytes in unpadded base64url, safe in an address.
[[nodiscard]] std::string signature_to_text(const Signature& signature);
[[nodiscard]] Result<Signature> signature_from_text(std::string_view text);

// The open form of the REST interface: the kind (YIQ, standard, unless it is set), averages
// as real numbers in the channel's unit, signed indices in falling order of magnitude. Any
// average and list that a picture could not have (outside the channel's range, index 0 or
// beyond 16383, an index twice, more than kMaxCoefficients) is refused by name.
struct OpenSignature {
    SignatureKind kind;
    std::array<double, kChannels> average{};
    std::array<std::vector<int>, kChannels> coefficients;
};
[[nodiscard]] OpenSignature to_open(const Signature& signature);
// low_information cannot be told from the open form: it is set where no channel has any
// coefficient.
[[nodiscard]] Result<Signature> from_open(const OpenSignature& open);

}  // namespace haarmony::image
