#include "schema/database.h"

#include <sqlite3.h>

#include <chrono>
#include <utility>

#include "schema/file_header.h"
#include "schema/migrate.h"
#include "schema/sqlite_error.h"
#include "schema/uri_words.h"

namespace haarmony::schema {
namespace {

// FULL, not NORMAL: schema/README.md, "Durability". The log is truncated to 64 MiB once a
// long reader has let it grow. Pages of 4 KiB: the cache holds the upper levels of every
// index of a million pictures.
constexpr const char* kSettings =
    "PRAGMA synchronous = FULL;"
    "PRAGMA foreign_keys = ON;"
    "PRAGMA wal_autocheckpoint = 1000;"
    "PRAGMA journal_size_limit = 67108864;"
    "PRAGMA cache_size = -16384;"
    "PRAGMA cell_size_check = ON;";

constexpr int kRetryMs = 5;

Result<void> execute(sqlite3* handle, const char* sql) {
    const int result = sqlite3_exec(handle, sql, nullptr, nullptr, nullptr);
    if (result != SQLITE_OK) return sqlite_error(handle, result);
    return {};
}

// SQLite reads ":memory:", "file:..." and "" as something else than a path.
std::string plain_path(const std::string& path) {
    return path.starts_with('/') ? path : "./" + path;
}

Result<void> set_checkpoint_on_close(sqlite3* handle, bool enabled) {
    const int result = sqlite3_db_config(
        handle, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, enabled ? 0 : 1, nullptr);
    if (result != SQLITE_OK) return sqlite_error(handle, result);
    return {};
}

// The switch needs the file to itself for a moment, and SQLite does not wait for that: two
// processes that create the same file meet here.
Result<void> use_write_ahead_log(sqlite3* handle) {
    const auto deadline =
        std::chrono::steady_clock::now() + std::chrono::milliseconds(kBusyTimeoutMs);
    for (;;) {
        Result<Statement> statement =
            Statement::prepare(handle, "PRAGMA journal_mode = WAL");
        if (!statement) return std::move(statement).error();
        Result<bool> row = statement->step();
        if (row) {
            if (statement->text(0) == "wal") return {};
            return Error{ErrorCode::kIo, "this file system allows no write-ahead log"};
        }
        if (row.error().code != ErrorCode::kUnavailable ||
            std::chrono::steady_clock::now() >= deadline) {
            return std::move(row).error();
        }
        sqlite3_sleep(kRetryMs);
    }
}

Result<void> prepare_for_writing(sqlite3* handle) {
    if (sqlite3_db_readonly(handle, "main") != 0) {
        return Error{ErrorCode::kIo, "the file cannot be written"};
    }
    Result<void> done = migrate(handle, migrations());
    if (done) done = use_write_ahead_log(handle);
    return done;
}

Result<void> prepare_for_reading(sqlite3* handle) {
    const Result<int> version = stored_version(handle, current_version());
    if (!version) return version.error();
    if (*version == 0) return Error{ErrorCode::kNotFound, "an empty file, no database"};
    if (*version != current_version()) {
        return Error{ErrorCode::kConflict,
                     "has schema version " + std::to_string(*version) +
                         ", older than this program's " +
                         std::to_string(current_version()) +
                         "; opening it for writing migrates it"};
    }
    return {};
}

}  // namespace

int current_version() { return static_cast<int>(migrations().size()); }

void Database::Close::operator()(sqlite3* handle) const {
    // v2: a statement that outlives its connection keeps it, instead of leaking it.
    sqlite3_close_v2(handle);
}

Database::Database(Handle handle, Statement data_version)
    : handle_(std::move(handle)), data_version_(std::move(data_version)) {}
Database::Database(Database&&) noexcept = default;
Database& Database::operator=(Database&& other) noexcept {
    // The statement before its connection.
    data_version_ = std::move(other.data_version_);
    handle_ = std::move(other.handle_);
    return *this;
}
Database::~Database() = default;

Result<Database> Database::open(const std::string& path, Mode mode) {
    if (path.empty() || path.find('\0') != std::string::npos) {
        return Error{ErrorCode::kInvalidArgument,
                     "not a path of a database: \"" + std::string(path.c_str()) + "\""};
    }
    const std::string file = plain_path(path);
    const Result<FilePresence> presence = inspect_file(file, current_version());
    if (!presence) return presence.error();
    if (*presence == FilePresence::kAbsent && mode == Mode::kReadOnly) {
        return Error{ErrorCode::kNotFound, path + ": no such database"};
    }

    const auto failed = [&](Error error) {
        // Some messages carry the path already.
        return error.message.find(path) != std::string::npos
                   ? error
                   : while_doing(path, std::move(error));
    };
    const int flags =
        (mode == Mode::kReadOnly ? SQLITE_OPEN_READONLY
                                 : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE) |
        SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_EXRESCODE;
    sqlite3* opened = nullptr;
    const int result = sqlite3_open_v2(file.c_str(), &opened, flags, nullptr);
    Handle handle(opened);  // to be closed even when opening failed
    if (result != SQLITE_OK) return failed(sqlite_error(opened, result));
    sqlite3_busy_timeout(opened, kBusyTimeoutMs);

    // A database that is refused below stays as it is, its log not moved into it.
    Result<void> ready = set_checkpoint_on_close(opened, false);
    if (ready) ready = register_uri_words(opened);
    if (ready) {
        ready = mode == Mode::kReadOnly ? prepare_for_reading(opened)
                                        : prepare_for_writing(opened);
    }
    if (ready) ready = set_checkpoint_on_close(opened, true);
    if (ready) ready = execute(opened, kSettings);
    if (!ready) return failed(std::move(ready).error());

    Result<Statement> data_version = Statement::prepare(opened, "PRAGMA data_version");
    if (!data_version) return failed(std::move(data_version).error());
    return Database(std::move(handle), std::move(data_version).value());
}

Result<std::int64_t> Database::data_version() {
    const Result<bool> row = data_version_.step();
    if (!row) return row.error();
    const std::int64_t version = data_version_.integer(0);
    data_version_.reset();
    return version;
}

sqlite3* Database::handle() const { return handle_.get(); }

}  // namespace haarmony::schema
