#include "schema/snapshot_store.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "schema/sqlite_error.h"
#include "schema/write_scope.h"

namespace haarmony::schema {
namespace {

constexpr std::string_view kAdd =
    "INSERT INTO snapshots (token, seq, created_at)"
    " VALUES (randomblob(16), ?1, strftime('%Y-%m-%dT%H:%M:%fZ', 'now'))"
    " RETURNING token, number";

Result<std::pair<SnapshotToken, std::int64_t>> insert(StatementCache& cache,
                                                      std::int64_t sequence) {
    auto statement = cache.borrow(kAdd);
    if (!statement) return std::move(statement).error();
    (*statement)->bind(1, sequence);
    const Result<bool> row = (*statement)->step();
    if (!row) return row.error();
    std::pair<SnapshotToken, std::int64_t> added;
    std::ranges::copy((*statement)->bytes(0), added.first.begin());
    added.second = (*statement)->integer(1);
    return added;
}

Result<void> forget_up_to(StatementCache& cache, std::int64_t number) {
    auto statement = cache.borrow("DELETE FROM snapshots WHERE number <= ?1");
    if (!statement) return std::move(statement).error();
    (*statement)->bind(1, number);
    return (*statement)->run();
}

}  // namespace

Result<SnapshotToken> SnapshotStore::add(std::int64_t sequence) {
    assert(sequence >= 0);
    const auto failed = [](Error error) {
        return while_doing("cannot note a snapshot", std::move(error));
    };
    Result<WriteScope> scope = WriteScope::begin(cache_, WriteScope::Kind::kTransaction);
    if (!scope) return failed(std::move(scope).error());
    const auto added = insert(cache_, sequence);
    if (!added) return failed(added.error());
    Result<void> done = forget_up_to(cache_, added->second - kMostKnown);
    if (done) done = scope->commit();
    if (!done) return failed(std::move(done).error());
    return added->first;
}

Result<std::optional<std::int64_t>> SnapshotStore::find(const SnapshotToken& token) {
    const auto failed = [](Error error) {
        return while_doing("cannot look for a snapshot", std::move(error));
    };
    auto statement = cache_.borrow("SELECT seq FROM snapshots WHERE token = ?1");
    if (!statement) return failed(std::move(statement).error());
    (*statement)->bind(1, std::span<const std::uint8_t>(token));
    const Result<bool> row = (*statement)->step();
    if (!row) return failed(row.error());
    if (!*row) return std::optional<std::int64_t>();
    return std::optional<std::int64_t>((*statement)->integer(0));
}

}  // namespace haarmony::schema
