// The part of ImageStore for what people say about a picture: its uri, tags and metadata.
#include <set>
#include <utility>

#include "schema/image_statements.h"
#include "schema/sqlite_error.h"

namespace haarmony::schema {
namespace {

constexpr std::string_view kDescribe =
    "UPDATE images SET uri = coalesce(?2, uri), metadata = coalesce(?3, metadata),"
    " updated_at = strftime('%Y-%m-%dT%H:%M:%fZ', 'now'), revision = revision + 1"
    " WHERE id = ?1";

Result<std::optional<ImageOrigin>> origin_of_image(StatementCache& cache, ImageId id) {
    auto statement =
        cache.borrow("SELECT origin FROM images WHERE id = ?1 AND state <> 'deleted'");
    if (!statement) return std::move(statement).error();
    (*statement)->bind(1, to_int(id));
    const Result<bool> row = (*statement)->step();
    if (!row) return row.error();
    if (!*row) return std::optional<ImageOrigin>();
    return std::optional(origin_of((*statement)->text(0)));
}

Result<void> store_row(StatementCache& cache,
                       ImageId id,
                       const ImageDescription& description) {
    auto statement = cache.borrow(kDescribe);
    if (!statement) return std::move(statement).error();
    (*statement)->bind(1, to_int(id));
    // What is not bound is null.
    if (description.uri) (*statement)->bind(2, *description.uri);
    if (description.metadata) (*statement)->bind(3, *description.metadata);
    return (*statement)->run();
}

Result<std::set<std::string>> tags_of(StatementCache& cache, ImageId id) {
    auto statement = cache.borrow("SELECT tag FROM image_tags WHERE image_id = ?1");
    if (!statement) return std::move(statement).error();
    (*statement)->bind(1, to_int(id));
    std::set<std::string> tags;
    for (;;) {
        const Result<bool> row = (*statement)->step();
        if (!row) return row.error();
        if (!*row) return tags;
        tags.emplace((*statement)->text(0));
    }
}

// Only what differs is written: every row of a tag writes the picture's words anew.
Result<void> replace_tags(StatementCache& cache,
                          ImageId id,
                          const std::vector<std::string>& tags) {
    auto former = tags_of(cache, id);
    if (!former) return std::move(former).error();
    for (const std::string& tag : tags) former->erase(tag);
    {
        auto statement =
            cache.borrow("DELETE FROM image_tags WHERE image_id = ?1 AND tag = ?2");
        if (!statement) return std::move(statement).error();
        for (const std::string& gone : *former) {
            (*statement)->reset();
            (*statement)->bind(1, to_int(id));
            (*statement)->bind(2, gone);
            Result<void> dropped = (*statement)->run();
            if (!dropped) return dropped;
        }
    }
    return store_tags(cache, id, tags);
}

}  // namespace

Result<void> store_tags(StatementCache& cache,
                        ImageId id,
                        const std::vector<std::string>& tags) {
    auto statement = cache.borrow(
        "INSERT INTO image_tags (image_id, tag) VALUES (?1, ?2)"
        " ON CONFLICT (image_id, tag) DO NOTHING");
    if (!statement) return std::move(statement).error();
    for (const std::string& tag : tags) {
        (*statement)->reset();
        (*statement)->bind(1, to_int(id));
        (*statement)->bind(2, tag);
        Result<void> stored = (*statement)->run();
        if (!stored) return stored;
    }
    return {};
}

Result<void> ImageStore::describe(ImageId id, const ImageDescription& description) {
    StatementCache& cache = statements_->cache;
    const auto failed = [&](Error error) {
        return while_doing("cannot describe " + image_name(id), std::move(error));
    };
    Result<WriteScope> scope = statements_->write();
    if (!scope) return failed(std::move(scope).error());
    const auto origin = origin_of_image(cache, id);
    if (!origin) return failed(origin.error());
    if (!origin->has_value()) return no_such_image(id);
    if (description.uri && *origin == ImageOrigin::kFile) {
        return failed(
            Error{ErrorCode::kConflict,
                  "its uri names a file and cannot become \"" + *description.uri + '"',
                  "uri"});
    }
    Result<void> stored = store_row(cache, id, description);
    if (stored && description.tags) stored = replace_tags(cache, id, *description.tags);
    if (stored) stored = scope->commit();
    if (!stored) return failed(std::move(stored).error());
    return {};
}

}  // namespace haarmony::schema
