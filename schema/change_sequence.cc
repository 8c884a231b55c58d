// The part of ImageStore that a daemon follows: a first full scan, then what changed.
#include <cassert>
#include <limits>
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
    "SELECT id, width, height, signature FROM images NOT INDEXED"
    " WHERE signature IS NOT NULL AND id BETWEEN ?1 AND ?2 ORDER BY id";

// The picture ?2 places behind ?1, along an index that has no more than what is asked for: to
// be given every id took three times as long.
constexpr std::string_view kSearchableIdBehind =
    "SELECT id FROM images INDEXED BY images_state WHERE state = 'indexed' AND id >= ?1"
    " ORDER BY id LIMIT 1 OFFSET ?2";

// In the order of kScan: the two are read side by side, and no picture costs a query.
constexpr std::string_view kVariantScan =
    "SELECT image_id, variant, signature FROM image_signatures"
    " WHERE image_id BETWEEN ?1 AND ?2 ORDER BY image_id, variant";

// A picture with several variants is several rows, with none one row without a variant.
constexpr std::string_view kChanges =
    "SELECT page.seq, page.image_id, images.signature, width, height, variant,"
    " image_signatures.signature FROM"
    " (SELECT seq, image_id FROM changes WHERE changes.seq > ?1 ORDER BY seq LIMIT ?2)"
    " AS page LEFT JOIN images ON images.id = page.image_id"
    " LEFT JOIN image_signatures ON image_signatures.image_id = page.image_id"
    " ORDER BY page.seq, variant";

constexpr IdRange kAllIds{ImageId{std::numeric_limits<std::int64_t>::min()},
                          ImageId{std::numeric_limits<std::int64_t>::max()}};

std::vector<std::uint8_t> copy_of(std::span<const std::uint8_t> bytes) {
    return {bytes.begin(), bytes.end()};
}

// The scan of the variants, one row ahead.
class VariantScan {
  public:
    explicit VariantScan(Statement& statement) : statement_(statement) {}

    // To the first row.
    [[nodiscard]] Result<void> begin() { return advance(); }

    // Reads the variants of picture `id` into `variants`. Requires: rising ids.
    [[nodiscard]] Result<void> take(std::int64_t id,
                                    std::vector<SignatureVariant>& variants) {
        variants.clear();
        while (image_ <= id) {
            // The triggers leave no variant without a searchable picture; one would be
            // passed over here.
            if (image_ == id) {
                variants.push_back(
                    {std::string(statement_.text(1)), copy_of(statement_.bytes(2))});
            }
            if (Result<void> moved = advance(); !moved) return moved;
        }
        return {};
    }

  private:
    static constexpr std::int64_t kEnd = std::numeric_limits<std::int64_t>::max();

    Result<void> advance() {
        const Result<bool> row = statement_.step();
        if (!row) return row.error();
        image_ = *row ? statement_.integer(0) : kEnd;
        return {};
    }

    Statement& statement_;
    std::int64_t image_ = kEnd;  // of the row that it stands on
};

Result<std::int64_t> last_sequence(StatementCache& cache) {
    auto statement = cache.borrow(kLastSequence);
    if (!statement) return std::move(statement).error();
    const Result<bool> row = (*statement)->step();
    if (!row) return row.error();
    return (*statement)->integer(0);
}

}  // namespace

Result<std::int64_t> ImageStore::for_each_searchable(
    const std::function<void(const SearchableImage&)>& visit) {
    return for_each_searchable(kAllIds, [&](const SearchableImage& image) {
        visit(image);
        return true;
    });
}

Result<std::int64_t> ImageStore::for_each_searchable(
    const IdRange& range,
    const std::function<bool(const SearchableImage&)>& visit) {
    const auto failed = [](Error error) {
        return while_doing("cannot read the signatures", std::move(error));
    };
    Result<ReadScope> scope = ReadScope::begin(statements_->cache);
    if (!scope) return failed(std::move(scope).error());
    // The first read fixes what the whole transaction sees.
    Result<std::int64_t> sequence = schema::last_sequence(statements_->cache);
    if (!sequence) return failed(std::move(sequence).error());

    auto scan = statements_->cache.borrow(kScan);
    if (!scan) return failed(std::move(scan).error());
    auto variant_statement = statements_->cache.borrow(kVariantScan);
    if (!variant_statement) return failed(std::move(variant_statement).error());
    for (Statement* statement : {&**scan, &**variant_statement}) {
        statement->bind(1, to_int(range.first));
        statement->bind(2, to_int(range.last));
    }
    VariantScan variant_scan(**variant_statement);
    if (Result<void> begun = variant_scan.begin(); !begun) return failed(begun.error());

    std::vector<SignatureVariant> variants;
    for (;;) {
        const Result<bool> row = (*scan)->step();
        if (!row) return failed(row.error());
        if (!*row) return sequence;
        const std::int64_t id = (*scan)->integer(0);
        const Result<void> taken = variant_scan.take(id, variants);
        if (!taken) return failed(taken.error());
        // The table bounds both sides by 2^31 - 1.
        const bool go_on = visit({ImageId{id},
                                  static_cast<int>((*scan)->integer(1)),
                                  static_cast<int>((*scan)->integer(2)),
                                  (*scan)->bytes(3),
                                  variants});
        if (!go_on) return sequence;
    }
}

Result<std::int64_t> ImageStore::last_sequence() {
    Result<std::int64_t> sequence = schema::last_sequence(statements_->cache);
    if (!sequence)
        return while_doing("cannot read the last change", std::move(sequence).error());
    return sequence;
}

Result<std::vector<IdRange>> ImageStore::searchable_ranges(int size) {
    assert(size >= 1);
    const auto failed = [](Error error) {
        return while_doing("cannot read the ids", std::move(error));
    };
    Result<ReadScope> scope = ReadScope::begin(statements_->cache);
    if (!scope) return failed(std::move(scope).error());
    auto statement = statements_->cache.borrow(kSearchableIdBehind);
    if (!statement) return failed(std::move(statement).error());
    std::vector<IdRange> ranges{kAllIds};
    for (;;) {
        (*statement)->bind(1, to_int(ranges.back().first));
        (*statement)->bind(2, size);
        const Result<bool> row = (*statement)->step();
        if (!row) return failed(row.error());
        if (!*row) return ranges;
        const std::int64_t first = (*statement)->integer(0);
        (*statement)->reset();
        ranges.back().last = ImageId{first - 1};
        ranges.push_back({ImageId{first}, kAllIds.last});
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
        const Statement& change = **statement;
        if (changes.empty() || changes.back().sequence != change.integer(0)) {
            Change& added = changes.emplace_back();
            added.sequence = change.integer(0);
            added.id = ImageId{change.integer(1)};
            added.signature = copy_of(change.bytes(2));
            if (!added.signature.empty()) {
                added.width = static_cast<int>(change.integer(3));
                added.height = static_cast<int>(change.integer(4));
            }
        }
        if (!change.is_null(5)) {
            changes.back().variants.push_back(
                {std::string(change.text(5)), copy_of(change.bytes(6))});
        }
    }
}

}  // namespace haarmony::schema
