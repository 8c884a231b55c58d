// One blocking GET, for a process that asks whether its server is well.
//
// Errors  kUnavailable naming the address: no connection, no answer in time, or an answer
//         that is not HTTP.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "engine/core/result.h"

namespace haarmony::http {

// The status of `target` on host:port. All of it takes at most `timeout`, but for looking up
// a host's name.
[[nodiscard]] Result<int> probe(const std::string& host,
                                std::uint16_t port,
                                const std::string& target,
                                std::chrono::milliseconds timeout);

}  // namespace haarmony::http
