// Who may ask: the keys of --api-key-file, and the test of a request against them.
//
// Shape   one key a line: "read:KEY" may read and search, "write:KEY" or "KEY" alone may do
//         everything. Blank lines and lines that start with '#' are left out. A key is made
//         of visible ASCII characters.
// Errors  parse: kInvalidArgument naming the line; admit: 401 without a known key, 403 for
//         a reading key that writes.
// Threads const-safe. Keys are kept and compared as hashes, in a time that does not depend
//         on which one is right.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "server/http/message.h"
#include "server/http/problem.h"

namespace haarmony::server {

class ApiKeys {
  public:
    // At least one key, or it is an error: a file that was meant to close the door does.
    [[nodiscard]] static Result<ApiKeys> parse(std::string_view text);

    // "Authorization: Bearer KEY" or "X-Api-Key: KEY"; nothing where the request may pass.
    [[nodiscard]] std::optional<http::Problem> admit(const http::Request& request) const;

  private:
    struct Key {
        std::string hash;
        bool writes = false;
    };

    std::vector<Key> keys_;
};

}  // namespace haarmony::server
