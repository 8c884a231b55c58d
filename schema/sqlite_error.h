// SQLite's result codes as our errors.
//
// Errors  busy and locked are kUnavailable, a repeated unique value kConflict, any other
//         broken constraint kInvalidArgument, too long a value kTooLarge, bytes that are no
//         database kNotADatabase, all else kIo. Out of memory throws std::bad_alloc.
#pragma once

#include <string_view>

#include "engine/core/result.h"

struct sqlite3;

namespace haarmony::schema {

// The error behind `result_code`, which the last call on `database` returned, with what
// SQLite says about it.
[[nodiscard]] Error sqlite_error(sqlite3* database, int result_code);

// The same error, its message preceded by what was being done.
[[nodiscard]] Error while_doing(std::string_view doing, Error error);

}  // namespace haarmony::schema
