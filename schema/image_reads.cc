// The reading half of ImageStore.
#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>

#include "schema/image_selection.h"
#include "schema/image_statements.h"
#include "schema/sqlite_error.h"

namespace haarmony::schema {
namespace {

// Column 0 tells one picture of the reply from the next, `columns()` follow, the tag comes
// last: a picture with several tags is several rows, with none a row without a tag.
enum Column {
    kKey,
    kId,
    kState,
    kOrigin,
    kUri,
    kSize,
    kMtime,
    kContentHash,
    kWidth,
    kHeight,
    kMediaType,
    kMetadata,
    kFailure,
    kLowInformation,
    kAddedAt,
    kUpdatedAt,
    kRevision,
    kTag
};

std::string columns() {
    return "images.id, state, origin, uri, size, mtime_ns, content_hash, width, height,"
           " media_type, metadata, failure, low_information, added_at, updated_at,"
           " revision, image_tags.tag";
}

constexpr std::string_view kWithTags =
    " LEFT JOIN image_tags ON image_tags.image_id = images.id";

Image image_of(const Statement& row) {
    Image image;
    image.id = ImageId{row.integer(kId)};
    image.state = state_of(row.text(kState));
    image.origin = origin_of(row.text(kOrigin));
    image.uri = row.text(kUri);
    image.stamp = {
        row.integer(kSize), row.integer(kMtime), std::string(row.text(kContentHash))};
    // The table bounds both by 2^31 - 1.
    image.width = static_cast<int>(row.integer(kWidth));
    image.height = static_cast<int>(row.integer(kHeight));
    image.media_type = row.text(kMediaType);
    image.metadata = row.text(kMetadata);
    image.failure = row.text(kFailure);
    image.low_information = row.integer(kLowInformation) != 0;
    image.added_at = row.text(kAddedAt);
    image.updated_at = row.text(kUpdatedAt);
    image.revision = row.integer(kRevision);
    return image;
}

// Requires: rows come ordered by key, then tag.
Result<std::vector<Image>> collect(Statement& statement) {
    std::vector<Image> images;
    std::int64_t key = 0;
    for (;;) {
        const Result<bool> row = statement.step();
        if (!row) return row.error();
        if (!*row) return images;
        if (images.empty() || statement.integer(kKey) != key) {
            key = statement.integer(kKey);
            images.push_back(image_of(statement));
        }
        if (!statement.is_null(kTag)) {
            images.back().tags.emplace_back(statement.text(kTag));
        }
    }
}

std::string json_array(std::span<const ImageId> ids) {
    std::string text = "[";
    for (const ImageId id : ids) {
        if (text.size() > 1) text += ',';
        text += std::to_string(to_int(id));
    }
    return text + ']';
}

// The smallest text above every text that starts with `prefix`; empty where there is none.
std::string end_of_prefix(std::string prefix) {
    while (!prefix.empty() && static_cast<unsigned char>(prefix.back()) == 0xff) {
        prefix.pop_back();
    }
    if (!prefix.empty()) {
        prefix.back() = static_cast<char>(static_cast<unsigned char>(prefix.back()) + 1);
    }
    return prefix;
}

constexpr std::string_view kFileColumns =
    "SELECT id, state, size, mtime_ns, content_hash, uri FROM images"
    " WHERE origin = 'file'";

KnownFile known_file_of(const Statement& row) {
    return {ImageId{row.integer(0)},
            state_of(row.text(1)),
            {row.integer(2), row.integer(3), std::string(row.text(4))}};
}

}  // namespace

Result<Image> ImageStore::get(ImageId id) {
    static const std::string sql = "SELECT 0, " + columns() + " FROM images" +
                                   std::string(kWithTags) +
                                   " WHERE images.id = ?1 AND state <> 'deleted'"
                                   " ORDER BY image_tags.tag";
    const auto failed = [&](Error error) {
        return while_doing("cannot read image " + std::to_string(to_int(id)),
                           std::move(error));
    };
    auto statement = statements_->cache.borrow(sql);
    if (!statement) return failed(std::move(statement).error());
    (*statement)->bind(1, to_int(id));
    Result<std::vector<Image>> images = collect(**statement);
    if (!images) return failed(std::move(images).error());
    if (images->empty()) return no_such_image(id);
    return std::move(images->front());
}

Result<std::vector<Image>> ImageStore::get_many(std::span<const ImageId> ids) {
    // One statement for all: a query of 1000 matches must not be 1000 queries.
    static const std::string sql = "SELECT wanted.key, " + columns() +
                                   " FROM json_each(?1) AS wanted"
                                   " CROSS JOIN images ON images.id = wanted.value" +
                                   std::string(kWithTags) + " WHERE state = 'indexed'";
    const auto failed = [&](Error error) {
        return while_doing("cannot read " + std::to_string(ids.size()) + " images",
                           std::move(error));
    };
    const std::string wanted = json_array(ids);  // outlives the loan that it is bound to
    auto statement = statements_->cache.borrow(sql);
    if (!statement) return failed(std::move(statement).error());
    (*statement)->bind(1, wanted);
    // The order is made here: SQLite would put every row into a sorter before it gave the
    // first one, at nearly twice the time.
    std::vector<std::optional<Image>> found(ids.size());
    for (;;) {
        Result<bool> row = (*statement)->step();
        if (!row) return failed(std::move(row).error());
        if (!*row) break;
        std::optional<Image>& image =
            found[static_cast<std::size_t>((*statement)->integer(kKey))];
        if (!image) image = image_of(**statement);
        if (!(*statement)->is_null(kTag))
            image->tags.emplace_back((*statement)->text(kTag));
    }
    std::vector<Image> images;
    images.reserve(ids.size());
    for (std::optional<Image>& image : found) {
        if (!image) continue;
        std::ranges::sort(image->tags);
        images.push_back(*std::move(image));
    }
    return images;
}

Result<std::vector<Image>> ImageStore::list(const ListOptions& options) {
    assert(options.limit >= 1);
    const auto selection =
        Selection::make(statements_->cache.database(), options.text, options.tags);
    if (!selection) return selection.error();
    const auto failed = [](Error error) {
        return while_doing("cannot list images", std::move(error));
    };
    const std::string sql =
        "SELECT images.id, " + columns() + " FROM (" + selection->sql() +
        ") AS page CROSS JOIN images ON images.id = page.id" + std::string(kWithTags) +
        " ORDER BY images.id, image_tags.tag";
    auto statement = statements_->cache.borrow(sql);
    if (!statement) return failed(std::move(statement).error());
    selection->bind(**statement, options.after, options.limit);
    Result<std::vector<Image>> images = collect(**statement);
    if (!images) return failed(std::move(images).error());
    return images;
}

Result<std::vector<ImageId>> ImageStore::matching(const ImageFilter& filter) {
    const auto selection =
        Selection::make(statements_->cache.database(), filter.text, filter.tags);
    if (!selection) return selection.error();
    const auto failed = [](Error error) {
        return while_doing("cannot filter images", std::move(error));
    };
    auto statement = statements_->cache.borrow(selection->sql());
    if (!statement) return failed(std::move(statement).error());
    selection->bind(**statement, std::nullopt, Selection::kNoLimit);
    std::vector<ImageId> ids;
    for (;;) {
        const Result<bool> row = (*statement)->step();
        if (!row) return failed(row.error());
        if (!*row) return ids;
        ids.push_back(ImageId{(*statement)->integer(0)});
    }
}

Result<std::vector<std::uint8_t>> ImageStore::signature(ImageId id) {
    const auto failed = [&](Error error) {
        return while_doing(
            "cannot read the signature of image " + std::to_string(to_int(id)),
            std::move(error));
    };
    auto statement = statements_->cache.borrow(
        "SELECT signature FROM images WHERE id = ?1 AND signature IS NOT NULL");
    if (!statement) return failed(std::move(statement).error());
    (*statement)->bind(1, to_int(id));
    const Result<bool> row = (*statement)->step();
    if (!row) return failed(row.error());
    if (!*row) return no_such_image(id);
    const auto bytes = (*statement)->bytes(0);
    return std::vector<std::uint8_t>(bytes.begin(), bytes.end());
}

Result<Thumbnail> ImageStore::thumbnail(ImageId id) {
    const auto failed = [&](Error error) {
        return while_doing(
            "cannot read the thumbnail of image " + std::to_string(to_int(id)),
            std::move(error));
    };
    auto statement = statements_->cache.borrow(
        "SELECT media_type, bytes FROM thumbnails WHERE image_id = ?1");
    if (!statement) return failed(std::move(statement).error());
    (*statement)->bind(1, to_int(id));
    const Result<bool> row = (*statement)->step();
    if (!row) return failed(row.error());
    if (!*row) {
        return Error{ErrorCode::kNotFound,
                     "no thumbnail of image " + std::to_string(to_int(id)),
                     "id"};
    }
    const auto bytes = (*statement)->bytes(1);
    return Thumbnail{std::string((*statement)->text(0)), {bytes.begin(), bytes.end()}};
}

Result<std::optional<KnownFile>> ImageStore::known_file(const std::string& uri) {
    static const std::string sql = std::string(kFileColumns) + " AND uri = ?1";
    const auto failed = [&](Error error) {
        return while_doing("cannot look up \"" + uri + "\"", std::move(error));
    };
    auto statement = statements_->cache.borrow(sql);
    if (!statement) return failed(std::move(statement).error());
    (*statement)->bind(1, uri);
    const Result<bool> row = (*statement)->step();
    if (!row) return failed(row.error());
    if (!*row) return std::optional<KnownFile>();
    return std::optional<KnownFile>(known_file_of(**statement));
}

Result<void> ImageStore::for_each_file(
    const std::string& uri_prefix,
    const std::function<void(const KnownFile&, const std::string& uri)>& visit) {
    // A range of the index, and no pattern: '%' and '_' are plain characters of a uri.
    static const std::string from = std::string(kFileColumns) + " AND uri >= ?1";
    static const std::string order = " ORDER BY uri";
    static const std::string range = from + " AND uri < ?2" + order;
    static const std::string unbounded = from + order;
    const auto failed = [&](Error error) {
        return while_doing("cannot list the files below \"" + uri_prefix + "\"",
                           std::move(error));
    };
    const std::string end = end_of_prefix(uri_prefix);
    auto statement = statements_->cache.borrow(end.empty() ? unbounded : range);
    if (!statement) return failed(std::move(statement).error());
    (*statement)->bind(1, uri_prefix);
    if (!end.empty()) (*statement)->bind(2, end);
    for (;;) {
        const Result<bool> row = (*statement)->step();
        if (!row) return failed(row.error());
        if (!*row) return {};
        visit(known_file_of(**statement), std::string((*statement)->text(5)));
    }
}

Result<Counts> ImageStore::counts() {
    const auto failed = [](Error error) {
        return while_doing("cannot count the images", std::move(error));
    };
    // All rows are counted page by page; only the few of the other states one by one.
    auto statement = statements_->cache.borrow(
        "SELECT (SELECT count(*) FROM images),"
        " (SELECT count(*) FROM images WHERE state = 'failed'),"
        " (SELECT count(*) FROM images WHERE state = 'deleted')");
    if (!statement) return failed(std::move(statement).error());
    const Result<bool> row = (*statement)->step();
    if (!row) return failed(row.error());
    Counts counts;
    counts.failed = (*statement)->integer(1);
    counts.deleted = (*statement)->integer(2);
    counts.indexed = (*statement)->integer(0) - counts.failed - counts.deleted;
    return counts;
}

}  // namespace haarmony::schema
