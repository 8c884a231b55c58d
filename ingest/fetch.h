// The bytes behind a web address (ingest, for pictures given by address):
//   [fetch] -> decode -> describe.
//
// The address comes from a stranger and we stand inside somebody's network, so that every
// connection, redirects included, is checked where it is made: against the address of the
// socket, not against the name, which may resolve to something else a moment later.
// Proxies of the environment are ignored for the same reason.
//
// Errors  kInvalidArgument (not an http or https address), kForbidden (not a public
//         address), kNotFound (404, 410), kTooLarge (names the limit), kUnavailable
//         (everything else that a server or the network does).
// Threads const-safe; blocks for at most `total`.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/result.h"

namespace haarmony::ingest {

struct FetchOptions {
    std::int64_t max_bytes = 64 << 20;
    std::chrono::milliseconds connect{5'000};
    std::chrono::milliseconds total{30'000};
    int max_redirects = 5;
    bool allow_private_addresses = false;  // for intranets
};

[[nodiscard]] Result<std::vector<std::uint8_t>> fetch(const std::string& url,
                                                      const FetchOptions& options);

}  // namespace haarmony::ingest
