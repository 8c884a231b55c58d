// The part of ImageStore that a daemon follows: a first full scan, then what changed.
#include <cassert>
#include <utility>

#include "schema/image_statements.h"
#include "schema/read_scope.h"
#include "schema/sqlite_error.h"

namespace haarmony::schema {
namespace {

// The last change of all is always there: a picture's older number goes only when it gets
// a newer one.
constexpr std::string_view kLastSequence = "SELECT coalesce(max(seq), 0) FROM changes";

// Along the table itself: only its rows hold the signatures.
constexpr std::string_view kScan =
    "SELECT id, signature FROM images NOT INDEXED WHERE signature IS NOT NULL ORDER BY "
    "id";

constexpr std::string_view kChanges =
    "SELECT changes.seq, changes.image_id, images.signature FROM changes"
    " LEFT JOIN images ON images.id = changes.image_id"
    " WHERE changes.seq > ?1 ORDER BY changes.seq LIMIT ?2";

Result<std::int64_t> last_sequence(StatementCache& cache) {
    auto statement = cache.borrow(kLastSequence);
    if (!statement) return std::move(statement).error();
    const Result<bool> row = (*statement)->step();
    if (!row) return row.error();
    return (*statement)->integer(0);
}

}  // namespace

Result<std::int64_t> ImageStore::for_each_signature(
    const std::function<void(ImageId, std::span<const std::uint8_t>)>& visit) {
    const auto failed = [](Error error) {
        return while_doing("cannot read the signatures", std::move(error));
    };
    Result<ReadScope> scope = ReadScope::begin(statements_->cache);
    if (!scope) return failed(std::move(scope).error());
    // The first read fixes what the whole transaction sees.
    Result<std::int64_t> sequence = last_sequence(statements_->cache);
    if (!sequence) return failed(std::move(sequence).error());

    auto scan = statements_->cache.borrow(kScan);
    if (!scan) return failed(std::move(scan).error());
    for (;;) {
        const Result<bool> row = (*scan)->step();
        if (!row) return failed(row.error());
        if (!*row) return sequence;
        visit(ImageId{(*scan)->integer(0)}, (*scan)->bytes(1));
    }
}

Result<std::vector<Change>> ImageStore::changes_after(std::int64_t sequence, int limit) {
    assert(limit >= 1);
    const auto failed = [&](Error error) {
        return while_doing("cannot read the changes after " + std::to_string(sequence),
                           std::move(error));
    };
    auto statement = statements_->cache.borrow(kChanges);
    if (!statement) return failed(std::move(statement).error());
    (*statement)->bind(1, sequence);
    (*statement)->bind(2, limit);
    std::vector<Change> changes;
    for (;;) {
        const Result<bool> row = (*statement)->step();
        if (!row) return failed(row.error());
        if (!*row) return changes;
        const auto signature = (*statement)->bytes(2);
        changes.push_back({(*statement)->integer(0),
                           ImageId{(*statement)->integer(1)},
                           {signature.begin(), signature.end()}});
    }
}

}  // namespace haarmony::schema
