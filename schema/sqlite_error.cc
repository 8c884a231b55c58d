#include "schema/sqlite_error.h"

#include <sqlite3.h>

#include <new>
#include <utility>

namespace haarmony::schema {
namespace {

ErrorCode code_of(int result_code) {
    if (result_code == SQLITE_CONSTRAINT_UNIQUE ||
        result_code == SQLITE_CONSTRAINT_PRIMARYKEY) {
        return ErrorCode::kConflict;
    }
    // The low byte is the primary code, the rest says where it happened.
    switch (result_code & 0xff) {
        case SQLITE_BUSY:
        case SQLITE_LOCKED:
        case SQLITE_PROTOCOL:  // lost a race for the write-ahead log's locks
            return ErrorCode::kUnavailable;
        case SQLITE_CONSTRAINT:
        case SQLITE_MISMATCH:
            return ErrorCode::kInvalidArgument;
        case SQLITE_TOOBIG:
            return ErrorCode::kTooLarge;
        case SQLITE_NOTADB:
            return ErrorCode::kNotADatabase;
        default:
            return ErrorCode::kIo;
    }
}

}  // namespace

Error sqlite_error(sqlite3* database, int result_code) {
    if ((result_code & 0xff) == SQLITE_NOMEM) throw std::bad_alloc();
    // The connection remembers only its last failure; a code from elsewhere has no text there.
    const bool is_last = sqlite3_extended_errcode(database) == result_code;
    std::string message =
        is_last ? sqlite3_errmsg(database) : sqlite3_errstr(result_code);
    message += " (SQLite " + std::to_string(result_code) + ")";
    return Error{code_of(result_code), std::move(message)};
}

Error while_doing(std::string_view doing, Error error) {
    error.message.insert(0, std::string(doing) + ": ");
    return error;
}

}  // namespace haarmony::schema
