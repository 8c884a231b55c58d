#include "schema/write_scope.h"

#include <sqlite3.h>

#include <utility>

namespace haarmony::schema {
namespace {

bool transaction_is_open(const StatementCache& cache) {
    return sqlite3_get_autocommit(cache.database()) == 0;
}

Error transaction_is_gone() {
    return Error{ErrorCode::kIo, "the transaction was rolled back by an earlier failure"};
}

}  // namespace

Result<WriteScope> WriteScope::begin(StatementCache& cache, Kind kind) {
    if (kind == Kind::kSavepoint && !transaction_is_open(cache)) {
        return transaction_is_gone();
    }
    // IMMEDIATE: the write lock now, with the busy timeout. A transaction that starts by
    // reading would fail at its first write if another writer got in between.
    Result<void> begun = cache.run(kind == Kind::kTransaction ? "BEGIN IMMEDIATE"
                                                              : "SAVEPOINT write_scope");
    if (!begun) return std::move(begun).error();
    return WriteScope(cache, kind);
}

WriteScope::WriteScope(WriteScope&& other) noexcept
    : cache_(std::exchange(other.cache_, nullptr)), kind_(other.kind_) {}

WriteScope::~WriteScope() {
    if (cache_ == nullptr || !transaction_is_open(*cache_)) return;
    // A failing rollback leaves nothing to do: SQLite undoes the rest when the connection
    // or the process ends.
    if (kind_ == Kind::kTransaction) {
        static_cast<void>(cache_->run("ROLLBACK"));
        return;
    }
    static_cast<void>(cache_->run("ROLLBACK TO write_scope"));
    static_cast<void>(cache_->run("RELEASE write_scope"));
}

Result<void> WriteScope::commit() {
    if (!transaction_is_open(*cache_)) return transaction_is_gone();
    Result<void> committed =
        cache_->run(kind_ == Kind::kTransaction ? "COMMIT" : "RELEASE write_scope");
    if (!committed) return committed;
    cache_ = nullptr;
    return {};
}

}  // namespace haarmony::schema
