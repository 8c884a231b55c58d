// The text of a uri for the word index: percent-decoded, without its scheme.
//
// Errors   none: what is no percent-encoding stays as it is.
// Threads  any.
#pragma once

#include <string>
#include <string_view>

#include "engine/core/result.h"

struct sqlite3;

namespace haarmony::schema {

// "file:///my%20cat.jpg" gives "/my cat.jpg"; a decoded NUL becomes a space.
[[nodiscard]] std::string uri_words(std::string_view uri);

// Makes it the SQL function haarmony_words(uri) of a connection. The triggers of
// 0004_text_search.sql call it: a connection without it can neither insert a picture nor
// change a uri.
[[nodiscard]] Result<void> register_uri_words(sqlite3* database);

}  // namespace haarmony::schema
