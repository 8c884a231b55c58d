// The writing half of ImageStore; 0002_changes.sql records what a follower must see.
#include <utility>

#include "schema/image_statements.h"
#include "schema/sqlite_error.h"

namespace haarmony::schema {
namespace {

constexpr std::string_view kInsert =
    "INSERT INTO images (origin, state, uri, size, mtime_ns, content_hash, width, height,"
    " media_type, low_information, signature, failure, metadata, added_at, updated_at,"
    " revision) VALUES (?1, 'indexed', ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, '', ?11,"
    " strftime('%Y-%m-%dT%H:%M:%fZ', 'now'), strftime('%Y-%m-%dT%H:%M:%fZ', 'now'), 1)"
    " RETURNING id";

constexpr std::string_view kUpdate =
    "UPDATE images SET state = 'indexed', size = ?2, mtime_ns = ?3, content_hash = ?4,"
    " width = ?5, height = ?6, media_type = ?7, low_information = ?8, signature = ?9,"
    " failure = '', updated_at = strftime('%Y-%m-%dT%H:%M:%fZ', 'now'),"
    " revision = revision + 1 WHERE id = ?1 RETURNING id";

constexpr std::string_view kTouch =
    "UPDATE images SET size = ?2, mtime_ns = ?3, content_hash = ?4,"
    " updated_at = strftime('%Y-%m-%dT%H:%M:%fZ', 'now'), revision = revision + 1"
    " WHERE id = ?1 RETURNING id";

// What described the former pixels goes with the signature.
constexpr std::string_view kFail =
    "INSERT INTO images (origin, state, uri, size, mtime_ns, content_hash, width, height,"
    " media_type, low_information, signature, failure, metadata, added_at, updated_at,"
    " revision) VALUES ('file', 'failed', ?1, ?2, ?3, ?4, 0, 0, '', 0, NULL, ?5, '{}',"
    " strftime('%Y-%m-%dT%H:%M:%fZ', 'now'), strftime('%Y-%m-%dT%H:%M:%fZ', 'now'), 1)"
    " ON CONFLICT (uri) WHERE origin = 'file' DO UPDATE SET state = 'failed',"
    " size = excluded.size, mtime_ns = excluded.mtime_ns,"
    " content_hash = excluded.content_hash, width = 0, height = 0, media_type = '',"
    " low_information = 0, signature = NULL, failure = excluded.failure,"
    " updated_at = excluded.updated_at, revision = revision + 1 RETURNING id";

constexpr std::string_view kRemoveUpload =
    "DELETE FROM images WHERE id = ?1 AND origin = 'upload' AND state <> 'deleted'"
    " RETURNING id";

constexpr std::string_view kRemoveFile =
    "UPDATE images SET state = 'deleted', signature = NULL, failure = '',"
    " updated_at = strftime('%Y-%m-%dT%H:%M:%fZ', 'now'), revision = revision + 1"
    " WHERE id = ?1 AND origin = 'file' AND state <> 'deleted' RETURNING id";

Result<void> store_thumbnail(StatementCache& cache,
                             ImageId id,
                             const Thumbnail& thumbnail) {
    if (thumbnail.bytes.empty()) {
        Result<bool> gone = wrote(
            cache, "DELETE FROM thumbnails WHERE image_id = ?1 RETURNING image_id", id);
        if (!gone) return std::move(gone).error();
        return {};
    }
    auto statement = cache.borrow(
        "INSERT INTO thumbnails (image_id, media_type, bytes) VALUES (?1, ?2, ?3)"
        " ON CONFLICT (image_id) DO UPDATE SET media_type = excluded.media_type,"
        " bytes = excluded.bytes");
    if (!statement) return std::move(statement).error();
    (*statement)->bind(1, to_int(id));
    (*statement)->bind(2, thumbnail.media_type);
    (*statement)->bind(3, thumbnail.bytes);
    return (*statement)->run();
}

Result<ImageId> insert(StatementCache& cache, const NewImage& image) {
    auto statement = cache.borrow(kInsert);
    if (!statement) return std::move(statement).error();
    (*statement)->bind(1, word_of(image.origin));
    (*statement)->bind(2, image.uri);
    (*statement)->bind(3, image.stamp.size);
    (*statement)->bind(4, image.stamp.mtime_ns);
    (*statement)->bind(5, image.stamp.content_hash);
    (*statement)->bind(6, image.width);
    (*statement)->bind(7, image.height);
    (*statement)->bind(8, image.media_type);
    (*statement)->bind(9, image.low_information ? 1 : 0);
    (*statement)->bind(10, image.signature);
    (*statement)->bind(11, image.metadata);
    const auto id = (*statement)->run_returning();
    if (!id) return id.error();
    return ImageId{id->value()};
}

Result<bool> replace_pixels(StatementCache& cache, ImageId id, const NewImage& image) {
    auto statement = cache.borrow(kUpdate);
    if (!statement) return std::move(statement).error();
    (*statement)->bind(1, to_int(id));
    (*statement)->bind(2, image.stamp.size);
    (*statement)->bind(3, image.stamp.mtime_ns);
    (*statement)->bind(4, image.stamp.content_hash);
    (*statement)->bind(5, image.width);
    (*statement)->bind(6, image.height);
    (*statement)->bind(7, image.media_type);
    (*statement)->bind(8, image.low_information ? 1 : 0);
    (*statement)->bind(9, image.signature);
    const auto written = (*statement)->run_returning();
    if (!written) return written.error();
    return written->has_value();
}

Result<ImageId> store_failure(StatementCache& cache,
                              const std::string& uri,
                              const FileStamp& stamp,
                              const std::string& reason) {
    auto statement = cache.borrow(kFail);
    if (!statement) return std::move(statement).error();
    (*statement)->bind(1, uri);
    (*statement)->bind(2, stamp.size);
    (*statement)->bind(3, stamp.mtime_ns);
    (*statement)->bind(4, stamp.content_hash);
    (*statement)->bind(5, reason);
    const auto id = (*statement)->run_returning();
    if (!id) return id.error();
    return ImageId{id->value()};
}

}  // namespace

Result<bool> wrote(StatementCache& cache, std::string_view sql, ImageId id) {
    auto statement = cache.borrow(sql);
    if (!statement) return std::move(statement).error();
    (*statement)->bind(1, to_int(id));
    const auto written = (*statement)->run_returning();
    if (!written) return written.error();
    return written->has_value();
}

Result<ImageId> ImageStore::add(const NewImage& image) {
    StatementCache& cache = statements_->cache;
    const auto failed = [&](Error error) {
        return while_doing("cannot add \"" + image.uri + "\"", std::move(error));
    };
    Result<WriteScope> scope = statements_->write();
    if (!scope) return failed(std::move(scope).error());
    Result<ImageId> id = insert(cache, image);
    if (!id) return failed(std::move(id).error());
    Result<void> stored = {};
    if (!image.thumbnail.bytes.empty()) {
        stored = store_thumbnail(cache, *id, image.thumbnail);
    }
    if (stored) stored = store_tags(cache, *id, image.tags);
    for (const SignatureVariant& variant : image.variants) {
        if (stored) stored = store_variant(cache, *id, variant);
    }
    if (stored) stored = scope->commit();
    if (!stored) return failed(std::move(stored).error());
    return id;
}

Result<void> ImageStore::update(ImageId id, const NewImage& image) {
    StatementCache& cache = statements_->cache;
    const auto failed = [&](Error error) {
        return while_doing("cannot update " + image_name(id), std::move(error));
    };
    Result<WriteScope> scope = statements_->write();
    if (!scope) return failed(std::move(scope).error());
    const Result<bool> found = replace_pixels(cache, id, image);
    if (!found) return failed(found.error());
    if (!*found) return no_such_image(id);
    Result<void> stored = store_thumbnail(cache, id, image.thumbnail);
    if (stored) stored = replace_variants(cache, id, image.variants);
    if (stored) stored = scope->commit();
    if (!stored) return failed(std::move(stored).error());
    return {};
}

Result<void> ImageStore::touch(ImageId id, const FileStamp& stamp) {
    const auto failed = [&](Error error) {
        return while_doing("cannot touch " + image_name(id), std::move(error));
    };
    Result<WriteScope> scope = statements_->write();
    if (!scope) return failed(std::move(scope).error());
    {
        auto statement = statements_->cache.borrow(kTouch);
        if (!statement) return failed(std::move(statement).error());
        (*statement)->bind(1, to_int(id));
        (*statement)->bind(2, stamp.size);
        (*statement)->bind(3, stamp.mtime_ns);
        (*statement)->bind(4, stamp.content_hash);
        const auto written = (*statement)->run_returning();
        if (!written) return failed(written.error());
        if (!written->has_value()) return no_such_image(id);
    }
    Result<void> committed = scope->commit();
    if (!committed) return failed(std::move(committed).error());
    return {};
}

Result<ImageId> ImageStore::mark_failed(const std::string& uri,
                                        const FileStamp& stamp,
                                        const std::string& reason) {
    const auto failed = [&](Error error) {
        return while_doing("cannot mark \"" + uri + "\" as failed", std::move(error));
    };
    Result<WriteScope> scope = statements_->write();
    if (!scope) return failed(std::move(scope).error());
    Result<ImageId> id = store_failure(statements_->cache, uri, stamp, reason);
    if (!id) return failed(std::move(id).error());
    Result<void> stored = store_thumbnail(statements_->cache, *id, Thumbnail{});
    if (stored) stored = scope->commit();
    if (!stored) return failed(std::move(stored).error());
    return id;
}

Result<void> ImageStore::remove(ImageId id) {
    StatementCache& cache = statements_->cache;
    const auto failed = [&](Error error) {
        return while_doing("cannot remove " + image_name(id), std::move(error));
    };
    Result<WriteScope> scope = statements_->write();
    if (!scope) return failed(std::move(scope).error());
    // Of the two at most one finds the row.
    for (const std::string_view sql : {kRemoveUpload, kRemoveFile}) {
        const Result<bool> removed = wrote(cache, sql, id);
        if (!removed) return failed(removed.error());
        if (!*removed) continue;
        Result<void> stored = store_thumbnail(cache, id, Thumbnail{});
        if (stored) stored = scope->commit();
        if (!stored) return failed(std::move(stored).error());
        return {};
    }
    return no_such_image(id);
}

Result<void> ImageStore::purge(ImageId id) {
    const auto failed = [&](Error error) {
        return while_doing("cannot purge " + image_name(id), std::move(error));
    };
    Result<WriteScope> scope = statements_->write();
    if (!scope) return failed(std::move(scope).error());
    const Result<bool> purged =
        wrote(statements_->cache, "DELETE FROM images WHERE id = ?1 RETURNING id", id);
    if (!purged) return failed(purged.error());
    if (!*purged) return no_such_image(id);
    Result<void> committed = scope->commit();
    if (!committed) return failed(std::move(committed).error());
    return {};
}

}  // namespace haarmony::schema
