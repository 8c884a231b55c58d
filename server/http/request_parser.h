// One HTTP/1.x request out of bytes that arrive in any pieces (RFC 9112); no sockets.
//
// The head first: the caller looks at it, decides how large the body may be, and goes on
// with begin_body(). After kBad the connection cannot be used any further.
//
// Limits  kMaxRequestLine (414), kMaxHead (431), the body limit (413).
// Errors  400 for malformed framing, among it every form of two lengths in one request;
//         501 for transfer codings other than chunked, 505 for other versions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "server/http/message.h"
#include "server/http/problem.h"

namespace haarmony::http {

inline constexpr std::size_t kMaxRequestLine = 8'192;
inline constexpr std::size_t kMaxHead = 16'384;

class RequestParser {
  public:
    enum class State { kHead, kHeadDone, kBody, kDone, kBad };

    RequestParser();
    ~RequestParser();
    RequestParser(const RequestParser&) = delete;
    RequestParser& operator=(const RequestParser&) = delete;

    // Takes what it can from the front of `bytes` and returns how much that is; the rest
    // must be given again, with more behind it. In kHeadDone, kDone and kBad takes nothing.
    std::size_t feed(std::string_view bytes);
    [[nodiscard]] State state() const;

    // Requires: kHeadDone. Leads to kBody, to kDone if there is none, or to kBad with 413.
    void begin_body(std::uint64_t limit);

    // To kBad: what the session itself found wrong with the request.
    void refuse(Problem problem);
    [[nodiscard]] const Problem& problem() const;  // requires: kBad

    // Method, path, query, headers and request id from kHeadDone on, the body from kDone on;
    // before, what could be read of them.
    [[nodiscard]] Request& request();

    [[nodiscard]] bool is_http_1_0() const;  // false as long as nothing is known
    // Require: the head is done.
    [[nodiscard]] bool keep_alive() const;
    [[nodiscard]] bool has_body() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace haarmony::http
