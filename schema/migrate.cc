#include "schema/migrate.h"

#include <sqlite3.h>

#include <cassert>
#include <utility>

#include "schema/database.h"
#include "schema/sqlite_error.h"
#include "schema/statement.h"

namespace haarmony::schema {
namespace {

Result<void> execute(sqlite3* database, const char* sql) {
    const int result = sqlite3_exec(database, sql, nullptr, nullptr, nullptr);
    if (result != SQLITE_OK) return sqlite_error(database, result);
    return {};
}

Result<std::int64_t> query_integer(sqlite3* database, std::string_view sql) {
    Result<Statement> statement = Statement::prepare(database, sql);
    if (!statement) return std::move(statement).error();
    Result<bool> row = statement->step();
    if (!row) return std::move(row).error();
    assert(*row);
    return statement->integer(0);
}

std::string path_of(sqlite3* database) { return sqlite3_db_filename(database, "main"); }

// Rolls back unless committed.
class Transaction {
  public:
    explicit Transaction(sqlite3* database) : database_(database) {}
    Transaction(const Transaction&) = delete;
    Transaction& operator=(const Transaction&) = delete;
    ~Transaction() {
        if (sqlite3_get_autocommit(database_) == 0) {
            // Nothing more can be done about a failure; the journal undoes it later.
            static_cast<void>(execute(database_, "ROLLBACK"));
        }
    }
    [[nodiscard]] Result<void> begin(const char* sql) { return execute(database_, sql); }
    [[nodiscard]] Result<void> commit() { return execute(database_, "COMMIT"); }

  private:
    sqlite3* database_;
};

// Requires: a transaction is open, so that the three values belong together.
Result<int> version_in_transaction(sqlite3* database, int newest) {
    const auto objects = query_integer(database, "SELECT count(*) FROM sqlite_schema");
    if (!objects) return objects.error();
    const auto application = query_integer(database, "PRAGMA application_id");
    if (!application) return application.error();
    const auto version = query_integer(database, "PRAGMA user_version");
    if (!version) return version.error();

    const bool is_empty = *objects == 0 && *application == 0 && *version == 0;
    if (is_empty) return 0;
    if (*application != kApplicationId || *version < 1) {
        return foreign_database(path_of(database),
                                static_cast<std::int32_t>(*application));
    }
    if (*version > newest) {
        return newer_version(path_of(database), static_cast<int>(*version), newest);
    }
    return static_cast<int>(*version);
}

Result<void> apply(sqlite3* database, const Migration& step) {
    // The application's id first: were the first page to reach the file before the commit,
    // a crash would leave a file that is known as ours, with its journal beside it.
    if (step.version == 1) {
        const std::string mark =
            "PRAGMA application_id = " + std::to_string(kApplicationId);
        Result<void> marked = execute(database, mark.c_str());
        if (!marked) return marked;
    }
    Result<void> applied = execute(database, step.sql);
    if (!applied) return applied;
    // Foreign keys are not enforced while tables may be rebuilt; they are checked instead.
    const auto dangling =
        query_integer(database, "SELECT count(*) FROM pragma_foreign_key_check");
    if (!dangling) return dangling.error();
    if (*dangling != 0) {
        return Error{
            ErrorCode::kIo,
            "leaves " + std::to_string(*dangling) + " rows that refer to nothing"};
    }
    const std::string number = "PRAGMA user_version = " + std::to_string(step.version);
    return execute(database, number.c_str());
}

// Applies the next step, if there is one; returns the version before it.
Result<int> migrate_once(sqlite3* database, std::span<const Migration> steps) {
    const int newest = static_cast<int>(steps.size());
    // EXCLUSIVE: two processes that both hold a read lock and both want to write would
    // block each other; waiting before the first read, they queue.
    Transaction transaction(database);
    Result<void> begun = transaction.begin("BEGIN EXCLUSIVE");
    if (!begun) return std::move(begun).error();
    Result<int> version = version_in_transaction(database, newest);
    if (!version || *version == newest) return version;

    const Migration& step = steps[static_cast<std::size_t>(*version)];
    assert(step.version == *version + 1);
    Result<void> applied = apply(database, step);
    if (applied) applied = transaction.commit();
    if (!applied) {
        return while_doing(path_of(database) + ": migration " + std::string(step.name),
                           std::move(applied).error());
    }
    return version;
}

}  // namespace

Result<int> stored_version(sqlite3* database, int newest) {
    Transaction snapshot(database);
    Result<void> begun = snapshot.begin("BEGIN");
    if (!begun) return std::move(begun).error();
    return version_in_transaction(database, newest);
}

Result<void> migrate(sqlite3* database, std::span<const Migration> steps) {
    const int newest = static_cast<int>(steps.size());
    // Without the write lock first: a file that is up to date, or refused, opens while
    // another process is writing.
    Result<int> version = stored_version(database, newest);
    while (version && *version != newest) version = migrate_once(database, steps);
    if (!version) return std::move(version).error();
    return {};
}

Error foreign_database(const std::string& path, std::int32_t application_id) {
    return Error{ErrorCode::kNotADatabase,
                 path + ": a database of another program (application_id " +
                     std::to_string(application_id) + "), not of Haarmony"};
}

Error newer_version(const std::string& path, int version, int newest) {
    return Error{ErrorCode::kNewerVersion,
                 path + ": has schema version " + std::to_string(version) +
                     ", this program knows versions up to " + std::to_string(newest)};
}

}  // namespace haarmony::schema
