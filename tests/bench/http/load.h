// Clients that ask a running daemon for pictures like a stored one, one after another over
// connections that are kept open, and note how long they waited.
//
// Units   milliseconds.
// Errors  std::runtime_error where the daemon is not there, or answers anything but 200.
// Threads one for each connection, within run_load().
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace haarmony::bench {

struct LoadOptions {
    std::uint16_t port = 8080;
    int connections = 1;
    int requests = 1000;          // over all connections
    std::int64_t largest_id = 1;  // ids are drawn from [1, largest_id]
    int limit = 20;
    unsigned seed = 1;
};

struct Waited {
    double total = 0;   // from the first byte sent to the last one received
    double took = 0;    // "took_ms" of the answer
    double search = 0;  // "search" of its Server-Timing: the engine alone
};

// In the order of connections, and of time within each. Requires: all numbers >= 1.
[[nodiscard]] std::vector<Waited> run_load(const LoadOptions& options);

// The number behind `name`; std::runtime_error naming both where there is none.
[[nodiscard]] double number_after(std::string_view text, std::string_view name);

}  // namespace haarmony::bench
