// Bytes as unpadded base64url text, safe in an address (RFC 4648, section 5).
//
// Errors  decoding refuses padding, foreign characters, an impossible length and left-over
//         bits that are not zero, so that one string of bytes has one text; the message
//         continues a sentence ("has character '=' ...").
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"

namespace haarmony::image {

[[nodiscard]] constexpr std::size_t base64url_length(std::size_t bytes) {
    return (4 * bytes + 2) / 3;
}

[[nodiscard]] std::string base64url_encode(std::span<const std::uint8_t> bytes);
[[nodiscard]] Result<std::vector<std::uint8_t>> base64url_decode(std::string_view text);

}  // namespace haarmony::image
