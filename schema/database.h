// One connection to a Haarmony database file (SQLite, WAL).
//
// Opening creates and migrates the file where it is absent or older, each migration and the
// version number in one transaction; it refuses a file that is not ours (kNotADatabase,
// without writing a byte to it) and one from a newer version (kNewerVersion, naming both).
//
// Threads  one connection, one thread at a time; open one for each thread.
// Source   schema/README.md describes every table.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "engine/core/result.h"

struct sqlite3;

namespace haarmony::schema {

// PRAGMA application_id of our files: "Haar" in ASCII.
inline constexpr std::int32_t kApplicationId = 0x48616172;

// The version that the migrations compiled into this program lead to.
[[nodiscard]] int current_version();

class Database {
  public:
    enum class Mode { kReadWriteCreate, kReadOnly };

    [[nodiscard]] static Result<Database> open(const std::string& path, Mode mode);

    Database(Database&&) noexcept;
    Database& operator=(Database&&) noexcept;
    ~Database();

    // Changes whenever another connection has committed: cheap enough to poll.
    [[nodiscard]] Result<std::int64_t> data_version();

    [[nodiscard]] sqlite3* handle() const;  // for the stores of this folder only

  private:
    explicit Database(sqlite3* handle);
    struct Close {
        void operator()(sqlite3* handle) const;
    };
    std::unique_ptr<sqlite3, Close> handle_;
};

}  // namespace haarmony::schema
