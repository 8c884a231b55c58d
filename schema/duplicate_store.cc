#include "schema/duplicate_store.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "schema/sqlite_error.h"
#include "schema/write_scope.h"

namespace haarmony::schema {
namespace {

constexpr std::string_view kBegin =
    "INSERT INTO duplicate_generations (published, created_at)"
    " VALUES (0, strftime('%Y-%m-%dT%H:%M:%fZ', 'now')) RETURNING generation";

// No row where one of the two is not searchable any more.
constexpr std::string_view kAdd =
    "INSERT INTO duplicates (generation, a, b, level, similarity)"
    " SELECT ?1, one.id, other.id, ?4, ?5 FROM images AS one, images AS other"
    " WHERE one.id = ?2 AND one.state = 'indexed'"
    " AND other.id = ?3 AND other.state = 'indexed'";

constexpr std::string_view kPairs =
    "SELECT a, b, level, similarity FROM duplicates WHERE generation ="
    " (SELECT generation FROM duplicate_generations WHERE published = 1)"
    " AND similarity >= ?1 AND NOT EXISTS (SELECT 1 FROM ignored_duplicates AS ignored"
    " WHERE ignored.a = duplicates.a AND ignored.b = duplicates.b) ORDER BY a, b";

constexpr std::string_view kIgnore =
    "INSERT INTO ignored_duplicates (a, b, created_at)"
    " VALUES (?1, ?2, strftime('%Y-%m-%dT%H:%M:%fZ', 'now')) ON CONFLICT (a, b) DO "
    "NOTHING";

// Along the index, which has no other rows.
constexpr std::string_view kContents =
    "SELECT content_hash, id FROM images INDEXED BY images_content"
    " WHERE state = 'indexed' AND content_hash <> '' ORDER BY content_hash, id";

std::string generation_name(std::int64_t generation) {
    return "generation " + std::to_string(generation) + " of duplicates";
}

// The generation is there and not published.
Result<void> need_open(StatementCache& cache, std::int64_t generation) {
    auto statement =
        cache.borrow("SELECT published FROM duplicate_generations WHERE generation = ?1");
    if (!statement) return std::move(statement).error();
    (*statement)->bind(1, generation);
    const Result<bool> row = (*statement)->step();
    if (!row) return row.error();
    if (!*row) return Error{ErrorCode::kNotFound, "no " + generation_name(generation)};
    if ((*statement)->integer(0) != 0) {
        return Error{ErrorCode::kConflict,
                     generation_name(generation) + " is published already"};
    }
    return {};
}

// All that `change` does to a generation that is there and not published, or nothing of it.
template <typename Change>
Result<void> change_open(StatementCache& cache,
                         std::int64_t generation,
                         std::string_view doing,
                         const Change& change) {
    const auto attempt = [&]() -> Result<void> {
        Result<WriteScope> scope =
            WriteScope::begin(cache, WriteScope::Kind::kTransaction);
        if (!scope) return std::move(scope).error();
        Result<void> done = need_open(cache, generation);
        if (done) done = change();
        if (done) done = scope->commit();
        return done;
    };
    Result<void> done = attempt();
    if (!done) return while_doing(doing, std::move(done).error());
    return {};
}

Result<void> store_pairs(StatementCache& cache,
                         std::int64_t generation,
                         std::span<const DuplicatePair> pairs) {
    auto statement = cache.borrow(kAdd);
    if (!statement) return std::move(statement).error();
    for (const DuplicatePair& pair : pairs) {
        (*statement)->reset();
        (*statement)->bind(1, generation);
        (*statement)->bind(2, to_int(pair.a));
        (*statement)->bind(3, to_int(pair.b));
        (*statement)->bind(4, pair.level);
        (*statement)->bind_real(5, pair.similarity);
        Result<void> stored = (*statement)->run();
        if (!stored) {
            return while_doing("pair " + std::to_string(to_int(pair.a)) + ", " +
                                   std::to_string(to_int(pair.b)),
                               std::move(stored).error());
        }
    }
    return {};
}

// kNotFound where there is no such row that can be seen.
Result<void> need_image(StatementCache& cache, ImageId id) {
    auto statement =
        cache.borrow("SELECT 1 FROM images WHERE id = ?1 AND state <> 'deleted'");
    if (!statement) return std::move(statement).error();
    (*statement)->bind(1, to_int(id));
    const Result<bool> row = (*statement)->step();
    if (!row) return row.error();
    if (!*row) {
        return Error{
            ErrorCode::kNotFound, "no image " + std::to_string(to_int(id)), "id"};
    }
    return {};
}

Result<void> store_ignored(StatementCache& cache, ImageId a, ImageId b) {
    auto statement = cache.borrow(kIgnore);
    if (!statement) return std::move(statement).error();
    (*statement)->bind(1, to_int(a));
    (*statement)->bind(2, to_int(b));
    return (*statement)->run();
}

}  // namespace

Result<std::int64_t> DuplicateStore::begin_generation() {
    const auto failed = [](Error error) {
        return while_doing("cannot begin a generation of duplicates", std::move(error));
    };
    auto statement = cache_.borrow(kBegin);
    if (!statement) return failed(std::move(statement).error());
    const auto generation = (*statement)->run_returning();
    if (!generation) return failed(generation.error());
    return generation->value();
}

Result<void> DuplicateStore::add(std::int64_t generation,
                                 std::span<const DuplicatePair> pairs) {
    return change_open(cache_, generation, "cannot add duplicates", [&] {
        return store_pairs(cache_, generation, pairs);
    });
}

Result<void> DuplicateStore::publish(std::int64_t generation) {
    const std::string doing = "cannot publish " + generation_name(generation);
    return change_open(cache_, generation, doing, [&] {
        // The older ones first: at most one is published at any moment.
        Result<void> done = cache_.run(
            "DELETE FROM duplicate_generations WHERE generation < ?1", generation);
        if (!done) return done;
        return cache_.run(
            "UPDATE duplicate_generations SET published = 1 WHERE generation = ?1",
            generation);
    });
}

Result<void> DuplicateStore::discard(std::int64_t generation) {
    const std::string doing = "cannot discard " + generation_name(generation);
    return change_open(cache_, generation, doing, [&] {
        return cache_.run("DELETE FROM duplicate_generations WHERE generation = ?1",
                          generation);
    });
}

Result<std::int64_t> DuplicateStore::published_generation() {
    const auto failed = [](Error error) {
        return while_doing("cannot read the generation of duplicates", std::move(error));
    };
    auto statement =
        cache_.borrow("SELECT generation FROM duplicate_generations WHERE published = 1");
    if (!statement) return failed(std::move(statement).error());
    const Result<bool> row = (*statement)->step();
    if (!row) return failed(row.error());
    return *row ? (*statement)->integer(0) : 0;
}

Result<std::vector<DuplicatePair>> DuplicateStore::pairs(double min_similarity) {
    const auto failed = [](Error error) {
        return while_doing("cannot list the duplicates", std::move(error));
    };
    auto statement = cache_.borrow(kPairs);
    if (!statement) return failed(std::move(statement).error());
    (*statement)->bind_real(1, min_similarity);
    std::vector<DuplicatePair> pairs;
    for (;;) {
        const Result<bool> row = (*statement)->step();
        if (!row) return failed(row.error());
        if (!*row) return pairs;
        pairs.push_back({ImageId{(*statement)->integer(0)},
                         ImageId{(*statement)->integer(1)},
                         std::string((*statement)->text(2)),
                         (*statement)->real(3)});
    }
}

Result<void> DuplicateStore::ignore(ImageId one, ImageId other) {
    const ImageId a = std::min(one, other);
    const ImageId b = std::max(one, other);
    const auto failed = [&](Error error) {
        return while_doing("cannot ignore the pair " + std::to_string(to_int(a)) + ", " +
                               std::to_string(to_int(b)),
                           std::move(error));
    };
    if (a == b) {
        return failed(Error{ErrorCode::kInvalidArgument, "it is one picture", "b"});
    }
    Result<WriteScope> scope = WriteScope::begin(cache_, WriteScope::Kind::kTransaction);
    if (!scope) return failed(std::move(scope).error());
    Result<void> done = need_image(cache_, a);
    if (done) done = need_image(cache_, b);
    if (done) done = store_ignored(cache_, a, b);
    if (done) done = scope->commit();
    if (!done) return failed(std::move(done).error());
    return {};
}

Result<std::vector<std::pair<ImageId, ImageId>>> DuplicateStore::ignored() {
    const auto failed = [](Error error) {
        return while_doing("cannot list what is ignored", std::move(error));
    };
    auto statement = cache_.borrow("SELECT a, b FROM ignored_duplicates ORDER BY a, b");
    if (!statement) return failed(std::move(statement).error());
    std::vector<std::pair<ImageId, ImageId>> pairs;
    for (;;) {
        const Result<bool> row = (*statement)->step();
        if (!row) return failed(row.error());
        if (!*row) return pairs;
        pairs.emplace_back(ImageId{(*statement)->integer(0)},
                           ImageId{(*statement)->integer(1)});
    }
}

Result<std::vector<std::vector<ImageId>>> DuplicateStore::same_content() {
    const auto failed = [](Error error) {
        return while_doing("cannot compare the contents", std::move(error));
    };
    auto statement = cache_.borrow(kContents);
    if (!statement) return failed(std::move(statement).error());
    std::vector<std::vector<ImageId>> groups;
    std::optional<std::string> hash;  // of the last group, which may have one picture yet
    for (;;) {
        const Result<bool> row = (*statement)->step();
        if (!row) return failed(row.error());
        const bool goes_on = *row && hash == (*statement)->text(0);
        if (!goes_on && !groups.empty() && groups.back().size() < 2) groups.pop_back();
        if (!*row) break;
        if (!goes_on) {
            hash = (*statement)->text(0);
            groups.emplace_back();
        }
        groups.back().push_back(ImageId{(*statement)->integer(1)});
    }
    std::sort(groups.begin(), groups.end());
    return groups;
}

}  // namespace haarmony::schema
