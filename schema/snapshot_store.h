// The files with a snapshot of the search arrays that this database knows, by their tokens.
//
// Errors   as image_store.h.
// Threads  as Database; never inside ImageStore::transaction().
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "engine/core/result.h"
#include "schema/database.h"
#include "schema/statement.h"

namespace haarmony::schema {

using SnapshotToken = std::array<std::uint8_t, 16>;

class SnapshotStore {
  public:
    // Older ones are forgotten.
    static constexpr int kMostKnown = 16;

    explicit SnapshotStore(Database& database) : cache_(database.handle()) {}

    // A new token, for a file that holds all changes up to `sequence` (>= 0).
    [[nodiscard]] Result<SnapshotToken> add(std::int64_t sequence);
    // The sequence of the token's file; nothing where this database never gave the token.
    [[nodiscard]] Result<std::optional<std::int64_t>> find(const SnapshotToken& token);

  private:
    StatementCache cache_;
};

}  // namespace haarmony::schema
