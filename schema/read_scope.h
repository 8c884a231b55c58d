// One snapshot for several reads: a read transaction, or the transaction that is open.
//
// Threads  as the connection.
#pragma once

#include "engine/core/result.h"
#include "schema/statement.h"

namespace haarmony::schema {

class ReadScope {
  public:
    [[nodiscard]] static Result<ReadScope> begin(StatementCache& cache);
    ReadScope(ReadScope&& other) noexcept;
    ReadScope& operator=(ReadScope&&) = delete;
    ~ReadScope();

  private:
    explicit ReadScope(StatementCache* cache) : cache_(cache) {}

    StatementCache* cache_;  // null where there is nothing to end
};

}  // namespace haarmony::schema
