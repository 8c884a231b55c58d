#include "schema/statement.h"

#include <sqlite3.h>

#include <cassert>
#include <utility>

#include "schema/sqlite_error.h"

namespace haarmony::schema {
void Statement::Finalize::operator()(sqlite3_stmt* statement) const {
    // Repeats the last step's failure, which step() has reported.
    sqlite3_finalize(statement);
}

Result<Statement> Statement::prepare(sqlite3* database, std::string_view sql) {
    sqlite3_stmt* statement = nullptr;
    const int result = sqlite3_prepare_v3(database,
                                          sql.data(),
                                          static_cast<int>(sql.size()),
                                          SQLITE_PREPARE_PERSISTENT,
                                          &statement,
                                          nullptr);
    if (result != SQLITE_OK) return sqlite_error(database, result);
    assert(statement != nullptr);
    return Statement(statement);
}

void Statement::note(int result_code) {
    if (bind_result_ == SQLITE_OK) bind_result_ = result_code;
}

void Statement::bind(int parameter, std::int64_t value) {
    note(sqlite3_bind_int64(statement_.get(), parameter, value));
}

void Statement::bind(int parameter, std::string_view text) {
    // A null pointer would bind NULL; an empty view may hold one.
    note(sqlite3_bind_text64(statement_.get(),
                             parameter,
                             text.empty() ? "" : text.data(),
                             text.size(),
                             SQLITE_STATIC,
                             SQLITE_UTF8));
}

void Statement::bind(int parameter, std::span<const std::uint8_t> bytes) {
    const void* start = bytes.empty() ? static_cast<const void*>("") : bytes.data();
    note(sqlite3_bind_blob64(
        statement_.get(), parameter, start, bytes.size(), SQLITE_STATIC));
}

void Statement::bind_real(int parameter, double value) {
    note(sqlite3_bind_double(statement_.get(), parameter, value));
}

Result<bool> Statement::step() {
    sqlite3* database = sqlite3_db_handle(statement_.get());
    if (bind_result_ != SQLITE_OK) return sqlite_error(database, bind_result_);
    const int result = sqlite3_step(statement_.get());
    if (result == SQLITE_ROW) return true;
    if (result == SQLITE_DONE) {
        sqlite3_reset(statement_.get());
        return false;
    }
    Error error = sqlite_error(database, result);
    sqlite3_reset(statement_.get());
    return error;
}

Result<void> Statement::run() {
    Result<bool> row = step();
    if (!row) return std::move(row).error();
    assert(!*row);
    return {};
}

Result<std::optional<std::int64_t>> Statement::run_returning() {
    Result<bool> row = step();
    if (!row) return std::move(row).error();
    if (!*row) return std::optional<std::int64_t>();
    const std::int64_t value = integer(0);
    // To its end: the work of a statement with RETURNING is complete only then.
    Result<bool> more = step();
    if (!more) return std::move(more).error();
    assert(!*more);
    return std::optional<std::int64_t>(value);
}

void Statement::reset() {
    sqlite3_reset(statement_.get());
    sqlite3_clear_bindings(statement_.get());
    bind_result_ = SQLITE_OK;
}

std::int64_t Statement::integer(int column) const {
    return sqlite3_column_int64(statement_.get(), column);
}

double Statement::real(int column) const {
    return sqlite3_column_double(statement_.get(), column);
}

std::string_view Statement::text(int column) const {
    // The pointer first: asking for it may convert and so change the length.
    const auto* start =
        reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
    const int length = sqlite3_column_bytes(statement_.get(), column);
    return start == nullptr ? std::string_view{}
                            : std::string_view(start, static_cast<std::size_t>(length));
}

std::span<const std::uint8_t> Statement::bytes(int column) const {
    const auto* start =
        static_cast<const std::uint8_t*>(sqlite3_column_blob(statement_.get(), column));
    const int length = sqlite3_column_bytes(statement_.get(), column);
    return {start, static_cast<std::size_t>(start == nullptr ? 0 : length)};
}

bool Statement::is_null(int column) const {
    return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
}

StatementCache::Loan::Loan(StatementCache& cache, std::string sql, Statement statement)
    : cache_(&cache), sql_(std::move(sql)), statement_(std::move(statement)) {}

StatementCache::Loan::Loan(Loan&& other) noexcept
    : cache_(std::exchange(other.cache_, nullptr)),
      sql_(std::move(other.sql_)),
      statement_(std::move(other.statement_)) {}

StatementCache::Loan::~Loan() {
    if (cache_ == nullptr) return;
    statement_.reset();
    // Where an inner use of the same SQL came back first, this one is finalized.
    cache_->idle_.try_emplace(std::move(sql_), std::move(statement_));
}

Result<StatementCache::Loan> StatementCache::borrow(std::string_view sql) {
    std::string key(sql);
    if (auto idle = idle_.extract(key)) {
        return Loan(*this, std::move(key), std::move(idle.mapped()));
    }
    Result<Statement> prepared = Statement::prepare(database_, sql);
    if (!prepared) return std::move(prepared).error();
    return Loan(*this, std::move(key), std::move(prepared).value());
}

Result<void> StatementCache::run(std::string_view sql) {
    Result<Loan> statement = borrow(sql);
    if (!statement) return std::move(statement).error();
    return (*statement)->run();
}

Result<void> StatementCache::run(std::string_view sql, std::int64_t number) {
    Result<Loan> statement = borrow(sql);
    if (!statement) return std::move(statement).error();
    (*statement)->bind(1, number);
    return (*statement)->run();
}

}  // namespace haarmony::schema
