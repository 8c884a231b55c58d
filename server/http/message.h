// What a handler gets and gives: no sockets, no Beast.
//
// Shape   Request: the target split and percent-decoded; the query parameters in order.
//         Response: a body is bytes, a range of a file, or a source of chunks that the
//         session drains (events, streams).
// Threads values; a ChunkSource is pulled by one thread at a time, not always the same.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace haarmony::http {

// Header names compare without case.
struct HeaderLess {
    using is_transparent = void;
    bool operator()(std::string_view a, std::string_view b) const;
};
using Headers = std::map<std::string, std::string, HeaderLess>;

struct Request {
    std::string method;                                      // "GET", "POST", ...
    std::string path;                                        // decoded, starts with '/'
    std::vector<std::pair<std::string, std::string>> query;  // decoded, in order
    std::map<std::string, std::string> path_parameters;      // from the route's {names}
    Headers headers;
    std::string body;
    std::string request_id;
    std::string remote;           // "address:port" of the client, for logs
    std::stop_token cancelled{};  // asked once nobody waits for the answer any more

    [[nodiscard]] std::string_view header(
        std::string_view name) const;  // empty if absent
};

struct FileRange {
    std::string path;  // on the server's disk; never shown
    std::uint64_t offset = 0;
    std::uint64_t length = 0;
};

// Returns the next chunk, or nothing at the end. An empty chunk means "nothing yet": it is
// asked again after ListenerOptions::poll_interval, or never if the server is stopping. It
// must not wait for long, as streams share a few threads. An exception breaks the
// connection off, so that the client sees that the body is not whole.
using ChunkSource = std::function<std::optional<std::string>()>;

struct Response {
    int status = 200;
    Headers headers;
    std::variant<std::string, FileRange, ChunkSource> body;
    // How soon a ChunkSource that has nothing yet is asked again; 0: as the listener says.
    std::chrono::milliseconds poll_interval{0};
};

using Handler = std::function<Response(const Request&)>;

}  // namespace haarmony::http
