// Base64 as RFC 4648 section 4 has it, and nothing more lenient: padded, no line breaks, no
// other alphabet, and the unused bits of the last group are zero.
//
// Errors  kInvalidArgument naming the first position that is wrong.
// Threads const-safe.
#pragma once

#include <string>
#include <string_view>

#include "engine/core/result.h"

namespace haarmony::server {

[[nodiscard]] Result<std::string> decode_base64(std::string_view text);
[[nodiscard]] std::string encode_base64(std::string_view bytes);

}  // namespace haarmony::server
