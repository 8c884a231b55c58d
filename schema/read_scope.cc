#include "schema/read_scope.h"

#include <sqlite3.h>

#include <utility>

namespace haarmony::schema {

Result<ReadScope> ReadScope::begin(StatementCache& cache) {
    if (sqlite3_get_autocommit(cache.database()) == 0) return ReadScope(nullptr);
    Result<void> begun = cache.run("BEGIN");
    if (!begun) return std::move(begun).error();
    return ReadScope(&cache);
}

ReadScope::ReadScope(ReadScope&& other) noexcept
    : cache_(std::exchange(other.cache_, nullptr)) {}

ReadScope::~ReadScope() {
    // Nothing was written: the end of it can lose nothing, and so its result says nothing.
    if (cache_ != nullptr) static_cast<void>(cache_->run("ROLLBACK"));
}

}  // namespace haarmony::schema
