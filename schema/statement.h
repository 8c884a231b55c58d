// One prepared SQL statement with typed parameters and columns, and a cache of them.
//
// Shape    parameters count from 1, columns from 0, as in SQLite.
// Errors   a failed bind is reported by the next step(); messages are SQLite's.
// Threads  as the connection: one at a time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>

#include "engine/core/result.h"

struct sqlite3;
struct sqlite3_stmt;

namespace haarmony::schema {

class Statement {
  public:
    [[nodiscard]] static Result<Statement> prepare(sqlite3* database,
                                                   std::string_view sql);

    // Text and bytes are not copied: they must live until the next reset().
    void bind(int parameter, std::int64_t value);
    void bind(int parameter, std::string_view text);
    void bind(int parameter, std::span<const std::uint8_t> bytes);
    // A name of its own: an int would fit both numbers equally well. NaN binds null.
    void bind_real(int parameter, double value);

    // True with a row, false at the end (then the statement is reset).
    [[nodiscard]] Result<bool> step();
    // For a statement that gives no rows.
    [[nodiscard]] Result<void> run();
    // For a statement that writes at most one row and returns an integer of it: that
    // integer, or nothing where no row was written.
    [[nodiscard]] Result<std::optional<std::int64_t>> run_returning();
    // Back to the start, all parameters null.
    void reset();

    // Require: step() returned true. Views last until the next step() or reset().
    [[nodiscard]] std::int64_t integer(int column) const;
    [[nodiscard]] double real(int column) const;
    [[nodiscard]] std::string_view text(int column) const;
    [[nodiscard]] std::span<const std::uint8_t> bytes(int column) const;
    [[nodiscard]] bool is_null(int column) const;

  private:
    struct Finalize {
        void operator()(sqlite3_stmt* statement) const;
    };
    explicit Statement(sqlite3_stmt* statement) : statement_(statement) {}
    void note(int result_code);

    std::unique_ptr<sqlite3_stmt, Finalize> statement_;
    int bind_result_ = 0;
};

// Keeps each statement prepared between uses. A statement in use is out of the cache, so
// that a visitor may use the same SQL again while an outer scan stands on a row.
class StatementCache {
  public:
    // On loan from the cache; goes back, reset, when it dies.
    class Loan {
      public:
        Loan(StatementCache& cache, std::string sql, Statement statement);
        Loan(Loan&& other) noexcept;
        Loan& operator=(Loan&&) = delete;
        ~Loan();
        Statement* operator->() { return &statement_; }
        Statement& operator*() { return statement_; }

      private:
        StatementCache* cache_;  // null in a moved-from loan
        std::string sql_;
        Statement statement_;
    };

    explicit StatementCache(sqlite3* database) : database_(database) {}
    StatementCache(const StatementCache&) = delete;
    StatementCache& operator=(const StatementCache&) = delete;

    [[nodiscard]] Result<Loan> borrow(std::string_view sql);
    // Borrows and runs a statement without parameters and rows.
    [[nodiscard]] Result<void> run(std::string_view sql);
    // The same of one whose only parameter is a number.
    [[nodiscard]] Result<void> run(std::string_view sql, std::int64_t number);
    [[nodiscard]] sqlite3* database() const { return database_; }

  private:
    sqlite3* database_;
    std::unordered_map<std::string, Statement> idle_;
};

}  // namespace haarmony::schema
