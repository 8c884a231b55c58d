// All or nothing for the statements of one function: a transaction of its own, or a
// savepoint inside the one that is open.
//
// Errors   kIo where the enclosing transaction is gone: after a full disk SQLite may have
//          rolled all of it back, and what followed would be committed piece by piece.
// Threads  as the connection.
#pragma once

#include "engine/core/result.h"
#include "schema/statement.h"

namespace haarmony::schema {

class WriteScope {
  public:
    enum class Kind { kTransaction, kSavepoint };

    [[nodiscard]] static Result<WriteScope> begin(StatementCache& cache, Kind kind);
    WriteScope(WriteScope&& other) noexcept;
    WriteScope& operator=(WriteScope&&) = delete;
    // Rolls back what was not committed.
    ~WriteScope();

    // When it fails, all is rolled back.
    [[nodiscard]] Result<void> commit();

  private:
    WriteScope(StatementCache& cache, Kind kind) : cache_(&cache), kind_(kind) {}

    StatementCache* cache_;  // null once committed, rolled back or moved from
    Kind kind_;
};

}  // namespace haarmony::schema
