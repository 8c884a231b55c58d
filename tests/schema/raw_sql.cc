#include "tests/schema/raw_sql.h"

#include <sqlite3.h>

#include <fstream>
#include <stdexcept>

#include "schema/uri_words.h"
#include "tests/schema/pictures.h"

namespace haarmony::schema {
namespace {

struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Prepared = std::unique_ptr<sqlite3_stmt, Finalize>;

Prepared first_row(sqlite3* database, const std::string& sql) {
    sqlite3_stmt* statement = nullptr;
    sqlite3_prepare_v2(database, sql.c_str(), -1, &statement, nullptr);
    Prepared prepared(statement);
    if (statement == nullptr || sqlite3_step(statement) != SQLITE_ROW) {
        throw std::runtime_error(sql + ": " + sqlite3_errmsg(database));
    }
    return prepared;
}

}  // namespace

void run_sql(sqlite3* database, const std::string& sql) {
    if (sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) {
        throw std::runtime_error(sql + ": " + sqlite3_errmsg(database));
    }
}

std::int64_t sql_integer(sqlite3* database, const std::string& sql) {
    return sqlite3_column_int64(first_row(database, sql).get(), 0);
}

std::string sql_text(sqlite3* database, const std::string& sql) {
    const Prepared row = first_row(database, sql);
    const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(row.get(), 0));
    return text == nullptr ? std::string() : std::string(text);
}

void break_page(const std::string& path, const std::string& object) {
    std::int64_t page = 0;
    std::int64_t page_size = 0;
    {
        const RawConnection connection(path);
        page = sql_integer(
            connection.handle(),
            "SELECT rootpage FROM sqlite_schema WHERE name = '" + object + "'");
        page_size = sql_integer(connection.handle(), "PRAGMA page_size");
    }
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp((page - 1) * page_size);
    const auto noise = some_bytes(5, static_cast<std::size_t>(page_size));
    for (const std::uint8_t byte : noise) file.put(static_cast<char>(byte | 0x80));
}

void RawConnection::Close::operator()(sqlite3* handle) const { sqlite3_close(handle); }

RawConnection::RawConnection(const std::string& path) {
    sqlite3* opened = nullptr;
    const int result = sqlite3_open(path.c_str(), &opened);
    handle_.reset(opened);
    if (result != SQLITE_OK) throw std::runtime_error("cannot open " + path);
    if (!register_uri_words(opened)) throw std::runtime_error("haarmony_words");
}

void RawConnection::keep_log_on_close() {
    sqlite3_db_config(handle(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
}

}  // namespace haarmony::schema
