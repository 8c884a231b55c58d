// The first 100 bytes of a database file, read before SQLite opens it, so that a file that
// is not ours is refused without a byte, a -wal or a -shm being written.
//
// Shape    SQLite's file format: magic at 0, user_version at 60, application_id at 68.
// Errors   kNotADatabase for any file that is not ours; kNewerVersion for one of a newer
//          version; kIo for a directory and what cannot be read. All name the path.
// Threads  any.
#pragma once

#include <string>

#include "engine/core/result.h"

namespace haarmony::schema {

enum class FilePresence { kAbsent, kOurs };

// Whether `path` is absent (so counts a file without bytes, or one whose first transaction
// was cut off) or a database of ours that version `newest` of the schema may open. The -wal beside the file may hold a newer
// header: stored_version() in migrate.h looks again through SQLite.
[[nodiscard]] Result<FilePresence> inspect_file(const std::string& path, int newest);

}  // namespace haarmony::schema
