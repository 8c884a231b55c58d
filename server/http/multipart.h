// multipart/form-data, strictly (RFC 7578): every part named, every byte accounted for.
//
// Errors  kInvalidArgument naming what is wrong (boundary missing, part without a name,
//         text after the end, more than kMaxParts parts).
// Threads const-safe.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"

namespace haarmony::http {

inline constexpr int kMaxParts = 64;

struct Part {
    std::string name;
    std::string file_name;     // as sent; never used to open anything
    std::string content_type;  // empty if absent
    std::string_view body;     // into the request's body
};

// `content_type` is the request's header, with its boundary parameter.
[[nodiscard]] Result<std::vector<Part>> parse_multipart(std::string_view content_type,
                                                        std::string_view body);

}  // namespace haarmony::http
