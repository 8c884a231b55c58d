// One connection to a Haarmony database file (SQLite, WAL).
//
// Opening creates and migrates the file where it is absent or older, each migration and the
// version number in one transaction; it refuses a file that is not ours (kNotADatabase,
// without writing a byte to it) and one from a newer version (kNewerVersion, naming both).
//
// Errors   kNotFound for an absent file opened read-only; kConflict for one of an older
//          version opened read-only; kUnavailable where it stays locked for longer than
//          kBusyTimeoutMs; kIo for the rest. All name the path.
// Threads  one connection, one thread at a time; open one for each thread. Never carry one
//          across fork().
// Source   schema/README.md describes every table and what survives a loss of power.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "engine/core/result.h"
#include "schema/statement.h"

struct sqlite3;

namespace haarmony::schema {

// PRAGMA application_id of our files: "Haar" in ASCII.
inline constexpr std::int32_t kApplicationId = 0x48616172;

// How long a statement waits for another process's write lock.
inline constexpr int kBusyTimeoutMs = 5000;

// The version that the migrations compiled into this program lead to.
[[nodiscard]] int current_version();

class Database {
  public:
    enum class Mode { kReadWriteCreate, kReadOnly };

    [[nodiscard]] static Result<Database> open(const std::string& path, Mode mode);

    Database(Database&&) noexcept;
    Database& operator=(Database&&) noexcept;
    ~Database();

    // Changes whenever another connection has committed: cheap enough to poll. What this
    // connection commits itself does not change it.
    [[nodiscard]] Result<std::int64_t> data_version();

    [[nodiscard]] sqlite3* handle() const;  // for the stores of this folder only

  private:
    struct Close {
        void operator()(sqlite3* handle) const;
    };
    using Handle = std::unique_ptr<sqlite3, Close>;
    Database(Handle handle, Statement data_version);

    Handle handle_;
    Statement data_version_;  // after handle_: finalized before the connection closes
};

}  // namespace haarmony::schema
