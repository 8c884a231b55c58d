// The part of ImageStore for the further signatures of a picture.
#include <cassert>
#include <set>
#include <utility>

#include "schema/image_statements.h"
#include "schema/sqlite_error.h"

namespace haarmony::schema {
namespace {

// The same bytes again are no change: then nothing is written, and no trigger runs.
constexpr std::string_view kStore =
    "INSERT INTO image_signatures (image_id, variant, signature) VALUES (?1, ?2, ?3)"
    " ON CONFLICT (image_id, variant) DO UPDATE SET signature = excluded.signature"
    " WHERE signature IS NOT excluded.signature";

constexpr std::string_view kIsSearchable =
    "SELECT 1 FROM images WHERE id = ?1 AND state = 'indexed'";

// By the narrow index: the signatures themselves are not read.
constexpr std::string_view kWithout =
    "SELECT id FROM images WHERE state = 'indexed' AND id > ?2 AND NOT EXISTS"
    " (SELECT 1 FROM image_signatures INDEXED BY image_signatures_variant"
    " WHERE variant = ?1 AND image_id = images.id) ORDER BY id LIMIT ?3";

constexpr std::string_view kCounts =
    "SELECT variant, count(*) FROM image_signatures INDEXED BY image_signatures_variant"
    " GROUP BY variant ORDER BY variant";

Result<std::set<std::string>> variants_of(StatementCache& cache, ImageId id) {
    auto statement =
        cache.borrow("SELECT variant FROM image_signatures WHERE image_id = ?1");
    if (!statement) return std::move(statement).error();
    (*statement)->bind(1, to_int(id));
    std::set<std::string> names;
    for (;;) {
        const Result<bool> row = (*statement)->step();
        if (!row) return row.error();
        if (!*row) return names;
        names.emplace((*statement)->text(0));
    }
}

Result<void> drop_variant(StatementCache& cache, ImageId id, const std::string& variant) {
    auto statement =
        cache.borrow("DELETE FROM image_signatures WHERE image_id = ?1 AND variant = ?2");
    if (!statement) return std::move(statement).error();
    (*statement)->bind(1, to_int(id));
    (*statement)->bind(2, variant);
    return (*statement)->run();
}

Result<bool> is_searchable(StatementCache& cache, ImageId id) {
    auto statement = cache.borrow(kIsSearchable);
    if (!statement) return std::move(statement).error();
    (*statement)->bind(1, to_int(id));
    return (*statement)->step();
}

}  // namespace

Result<void> store_variant(StatementCache& cache,
                           ImageId id,
                           const SignatureVariant& variant) {
    auto statement = cache.borrow(kStore);
    if (!statement) return std::move(statement).error();
    (*statement)->bind(1, to_int(id));
    (*statement)->bind(2, variant.variant);
    (*statement)->bind(3, variant.signature);
    return (*statement)->run();
}

Result<void> replace_variants(StatementCache& cache,
                              ImageId id,
                              const std::vector<SignatureVariant>& variants) {
    auto former = variants_of(cache, id);
    if (!former) return std::move(former).error();
    for (const SignatureVariant& variant : variants) {
        Result<void> stored = store_variant(cache, id, variant);
        if (!stored) return stored;
        former->erase(variant.variant);
    }
    for (const std::string& gone : *former) {
        Result<void> dropped = drop_variant(cache, id, gone);
        if (!dropped) return dropped;
    }
    return {};
}

Result<void> ImageStore::set_variant(ImageId id, const SignatureVariant& variant) {
    const auto failed = [&](Error error) {
        return while_doing(
            "cannot set signature \"" + variant.variant + "\" of " + image_name(id),
            std::move(error));
    };
    Result<WriteScope> scope = statements_->write();
    if (!scope) return failed(std::move(scope).error());
    const Result<bool> searchable = is_searchable(statements_->cache, id);
    if (!searchable) return failed(searchable.error());
    if (!*searchable) return no_such_image(id);
    Result<void> stored = store_variant(statements_->cache, id, variant);
    if (stored) stored = scope->commit();
    if (!stored) return failed(std::move(stored).error());
    return {};
}

Result<std::vector<std::uint8_t>> ImageStore::signature(ImageId id,
                                                        std::string_view variant) {
    const auto named = [&] {
        return "signature \"" + std::string(variant) + "\" of " + image_name(id);
    };
    const auto failed = [&](Error error) {
        return while_doing("cannot read " + named(), std::move(error));
    };
    auto statement = statements_->cache.borrow(
        "SELECT signature FROM image_signatures WHERE image_id = ?1 AND variant = ?2");
    if (!statement) return failed(std::move(statement).error());
    (*statement)->bind(1, to_int(id));
    (*statement)->bind(2, variant);
    const Result<bool> row = (*statement)->step();
    if (!row) return failed(row.error());
    if (!*row) return Error{ErrorCode::kNotFound, "no " + named()};
    const auto bytes = (*statement)->bytes(0);
    return std::vector<std::uint8_t>(bytes.begin(), bytes.end());
}

Result<std::vector<ImageId>> ImageStore::without_variant(std::string_view variant,
                                                         std::optional<ImageId> after,
                                                         int limit) {
    assert(limit >= 1);
    const auto failed = [&](Error error) {
        return while_doing(
            "cannot list the images without signature \"" + std::string(variant) + '"',
            std::move(error));
    };
    auto statement = statements_->cache.borrow(kWithout);
    if (!statement) return failed(std::move(statement).error());
    (*statement)->bind(1, variant);
    (*statement)->bind(2, after ? to_int(*after) : 0);
    (*statement)->bind(3, limit);
    std::vector<ImageId> ids;
    for (;;) {
        const Result<bool> row = (*statement)->step();
        if (!row) return failed(row.error());
        if (!*row) return ids;
        ids.push_back(ImageId{(*statement)->integer(0)});
    }
}

Result<std::vector<std::pair<std::string, std::int64_t>>> ImageStore::variant_counts() {
    const auto failed = [](Error error) {
        return while_doing("cannot count the signatures", std::move(error));
    };
    auto statement = statements_->cache.borrow(kCounts);
    if (!statement) return failed(std::move(statement).error());
    std::vector<std::pair<std::string, std::int64_t>> counts;
    for (;;) {
        const Result<bool> row = (*statement)->step();
        if (!row) return failed(row.error());
        if (!*row) return counts;
        counts.emplace_back((*statement)->text(0), (*statement)->integer(1));
    }
}

}  // namespace haarmony::schema
