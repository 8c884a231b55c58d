// What to say of bytes that are not read here.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "engine/core/result.h"

namespace haarmony::ingest {

// kUnsupportedFormat with what the bytes are (sniff.h), or how they begin where nobody knows.
// `thing` is what was expected: "picture".
[[nodiscard]] Error unsupported_format(std::span<const std::uint8_t> bytes,
                                       std::string_view thing);

}  // namespace haarmony::ingest
