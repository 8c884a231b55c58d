// Numbered migrations: from any older version, or from nothing, to the current one.
//
// Each migration and its version number are one transaction; processes that open the same
// file at the same moment take turns, and each looks at the version again when its turn
// comes.
//
// Units   version n is what migration n leaves behind; 0 is a database with nothing in it.
// Errors  kNotADatabase and kNewerVersion as in database.h; kUnavailable where another
//         process migrates for longer than the busy timeout; else SQLite's, naming the
//         migration. The database then stands at the last version that was completed.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "engine/core/result.h"

struct sqlite3;

namespace haarmony::schema {

struct Migration {
    int version;
    std::string_view name;
    const char* sql;
};

// Those of schema/*.sql, built into the library: 1, 2, ... without a gap.
[[nodiscard]] std::span<const Migration> migrations();

// The version of an open database, 0 for an empty one, as the write-ahead log has it.
// Refuses what is not ours and what is above `newest`.
[[nodiscard]] Result<int> stored_version(sqlite3* database, int newest);

// Requires: `steps` are numbered 1, 2, ...; no transaction is open.
[[nodiscard]] Result<void> migrate(sqlite3* database, std::span<const Migration> steps);

// The two refusals, worded in one place.
[[nodiscard]] Error foreign_database(const std::string& path,
                                     std::int32_t application_id);
[[nodiscard]] Error newer_version(const std::string& path, int version, int newest);

}  // namespace haarmony::schema
