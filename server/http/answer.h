// What a handler's response becomes on its way to the connection: compressed or not, whole,
// a range or "not modified", and a file opened to be read piece by piece.
//
//   router -> [answer] -> session
//
// Errors   a file that cannot be opened is reported to `failed` and answered with a problem.
// Threads  any; the handler runs here.
#pragma once

#include <cstdint>
#include <optional>

#include "server/http/message.h"
#include "server/http/router.h"

namespace haarmony::http {

struct Answer {
    Response response;
    // Nothing: a stream whose length is not known.
    std::optional<std::uint64_t> content_length;
};

[[nodiscard]] Answer answer(const Router& router,
                            Request& request,
                            const FailureReport& failed);

}  // namespace haarmony::http
