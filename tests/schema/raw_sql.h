// SQL as a test writes it, beside the stores: fixtures, probes, oracles.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

struct sqlite3;

namespace haarmony::schema {

// Throw std::runtime_error with SQLite's message when the statement fails.
void run_sql(sqlite3* database, const std::string& sql);
[[nodiscard]] std::int64_t sql_integer(sqlite3* database, const std::string& sql);
[[nodiscard]] std::string sql_text(sqlite3* database, const std::string& sql);

// Overwrites the first page of a table or an index with bytes that are no page. Requires:
// nothing has the file open, and its log is empty.
void break_page(const std::string& path, const std::string& object);

// A connection with SQLite's own defaults, no busy timeout, and the one SQL function that
// the triggers need.
class RawConnection {
  public:
    explicit RawConnection(const std::string& path);
    [[nodiscard]] sqlite3* handle() const { return handle_.get(); }
    // Closes without moving the log into the file, as a killed process leaves it.
    void keep_log_on_close();

  private:
    struct Close {
        void operator()(sqlite3* handle) const;
    };
    std::unique_ptr<sqlite3, Close> handle_;
};

}  // namespace haarmony::schema
