// Pictures in the database: rows, thumbnails, tags and the sequence of changes that a
// running daemon follows.
//
// Shape    signatures are bytes that this folder does not understand.
// Units    sizes in pixels and bytes; mtime in nanoseconds since 1970; sequence numbers
//          grow with every commit that changes what can be found.
// Errors   kNotFound for an unknown id; kConflict for a second file row of one uri;
//          kInvalidArgument for a value that the tables refuse (an empty signature, metadata
//          that is no JSON object, a text to search for without a word); kUnavailable where
//          the database stays locked beyond the busy timeout; kIo with SQLite's message
//          otherwise. A function that fails leaves nothing of itself, in a transaction() too.
// Threads  as Database.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/ids.h"
#include "engine/core/result.h"
#include "schema/database.h"

namespace haarmony::schema {

enum class ImageState { kIndexed, kFailed, kDeleted };
enum class ImageOrigin { kUpload, kFile };

// What the file looked like when it was read; how unchanged files are recognised.
struct FileStamp {
    std::int64_t size = 0;
    std::int64_t mtime_ns = 0;
    std::string content_hash;  // lower-case hex of SHA-256
};

struct Thumbnail {
    std::string media_type;  // "image/jpeg" or "image/webp"
    std::vector<std::uint8_t> bytes;
};

// A further signature of a picture, beside the first one: of another colour space, of
// another crop. `variant` is any text of 1 to 64 characters.
struct SignatureVariant {
    std::string variant;
    std::vector<std::uint8_t> signature;
    bool operator==(const SignatureVariant&) const = default;
};

struct Image {
    ImageId id{};
    ImageState state = ImageState::kIndexed;
    ImageOrigin origin = ImageOrigin::kUpload;
    std::string uri;
    FileStamp stamp;
    int width = 0;  // after EXIF orientation
    int height = 0;
    std::string media_type;         // of the original, e.g. "image/jpeg"
    std::vector<std::string> tags;  // sorted, each once
    std::string metadata = "{}";    // a JSON object, stored as it came
    std::string failure;            // reason, for kFailed
    bool low_information = false;
    std::string added_at;  // RFC 3339, UTC
    std::string updated_at;
    std::int64_t revision = 0;  // grows with every change of this row: for ETags
};

// All that one decoded picture leaves behind.
struct NewImage {
    ImageOrigin origin = ImageOrigin::kUpload;
    std::string uri;
    FileStamp stamp;
    int width = 0;
    int height = 0;
    std::string media_type;
    std::vector<std::uint8_t> signature;
    bool low_information = false;
    Thumbnail thumbnail;
    std::vector<std::string> tags;
    std::string metadata = "{}";
    std::vector<SignatureVariant> variants;  // of one named twice, the last
};

// What a user says about a picture; what is absent stays as it is.
struct ImageDescription {
    std::optional<std::string> uri;  // of an upload only
    std::optional<std::vector<std::string>> tags;
    std::optional<std::string> metadata;
};

// A row as the ingest worker needs it to decide whether a file changed.
struct KnownFile {
    ImageId id{};
    ImageState state = ImageState::kIndexed;
    FileStamp stamp;
};

// One step of the change sequence: the picture as it is now, or gone (no signature).
struct Change {
    std::int64_t sequence = 0;
    ImageId id{};
    std::vector<std::uint8_t> signature;  // empty: not searchable any more
    int width = 0;
    int height = 0;
    std::vector<SignatureVariant> variants = {};  // in the order of their names
};

// A searchable picture as a scan shows it: views that last until the visit returns.
struct SearchableImage {
    ImageId id{};
    int width = 0;
    int height = 0;
    std::span<const std::uint8_t> signature;
    std::span<const SignatureVariant> variants;  // in the order of their names
};

// Both ends belong to it.
struct IdRange {
    ImageId first{};
    ImageId last{};
};

// More tags in one ListOptions or ImageFilter are refused (kInvalidArgument).
inline constexpr std::size_t kMaxListTags = 64;

// `text` is words, "phrases" and prefixes* over uri, tags and the strings of the metadata,
// all of which must match (text_query.h); empty: no condition.
struct ListOptions {
    int limit = 100;                // >= 1
    std::optional<ImageId> after;   // only ids above
    std::vector<std::string> tags;  // all must match
    std::string text = {};
};

struct ImageFilter {
    std::string text;
    std::vector<std::string> tags;  // all must match
};

struct Counts {
    std::int64_t indexed = 0;
    std::int64_t failed = 0;
    std::int64_t deleted = 0;
};

class ImageStore {
  public:
    explicit ImageStore(Database& database);
    ~ImageStore();
    ImageStore(const ImageStore&) = delete;
    ImageStore& operator=(const ImageStore&) = delete;

    // Runs `work` in one IMMEDIATE transaction: committed when it succeeds, rolled back
    // when it fails or throws. One inside another is a caller's bug and asserts.
    [[nodiscard]] Result<void> transaction(const std::function<Result<void>()>& work);

    // Always a new row. A thumbnail without bytes is none.
    [[nodiscard]] Result<ImageId> add(const NewImage& image);
    // Replaces what the pixels gave (stamp, size, signature and variants, thumbnail,
    // state), keeping id, uri, tags and metadata; revives a failed or deleted row.
    [[nodiscard]] Result<void> update(ImageId id, const NewImage& image);
    // Only the stamp: the content is the same. A new revision, but no change to follow.
    [[nodiscard]] Result<void> touch(ImageId id, const FileStamp& stamp);
    // Replaces what is given. A new revision, but no change to follow. kNotFound for a
    // deleted row; kConflict for another uri of a file's row: it names the file.
    [[nodiscard]] Result<void> describe(ImageId id, const ImageDescription& description);
    // Inserts or replaces one variant; kNotFound for a picture that is not searchable.
    [[nodiscard]] Result<void> set_variant(ImageId id, const SignatureVariant& variant);
    // A file that cannot be decoded: an existing row (by uri, of origin kFile) loses its
    // signature, else a row is made.
    [[nodiscard]] Result<ImageId> mark_failed(const std::string& uri,
                                              const FileStamp& stamp,
                                              const std::string& reason);
    // An upload's row goes; a file's row stays as kDeleted with its stamp, so that the
    // next ingest does not bring it back. Unknown or already deleted: kNotFound.
    [[nodiscard]] Result<void> remove(ImageId id);
    // The row itself goes (the file is gone).
    [[nodiscard]] Result<void> purge(ImageId id);

    // Rows that can be seen: not kDeleted, and not kFailed unless get() asks for that id.
    [[nodiscard]] Result<Image> get(ImageId id);
    // The same order as `ids`; unknown or deleted ones are left out.
    [[nodiscard]] Result<std::vector<Image>> get_many(std::span<const ImageId> ids);
    [[nodiscard]] Result<std::vector<Image>> list(const ListOptions& options);
    // The ids of all searchable pictures that match, rising.
    [[nodiscard]] Result<std::vector<ImageId>> matching(const ImageFilter& filter);
    [[nodiscard]] Result<std::vector<std::uint8_t>> signature(ImageId id);
    // kNotFound naming both.
    [[nodiscard]] Result<std::vector<std::uint8_t>> signature(ImageId id,
                                                              std::string_view variant);
    [[nodiscard]] Result<Thumbnail> thumbnail(ImageId id);

    [[nodiscard]] Result<std::optional<KnownFile>> known_file(const std::string& uri);
    // Every file row whose uri starts with `uri_prefix`, deleted and failed ones included,
    // in the order of their uris. `visit` may read; what it would write waits until after.
    [[nodiscard]] Result<void> for_each_file(
        const std::string& uri_prefix,
        const std::function<void(const KnownFile&, const std::string& uri)>& visit);

    [[nodiscard]] Result<Counts> counts();

    // The searchable pictures without that variant, in the order of ids, at most `limit`
    // (>= 1), only ids above `after`.
    [[nodiscard]] Result<std::vector<ImageId>>
    without_variant(std::string_view variant, std::optional<ImageId> after, int limit);
    // How many pictures have each variant that is there, in the order of names.
    [[nodiscard]] Result<std::vector<std::pair<std::string, std::int64_t>>>
    variant_counts();

    // Every searchable picture, in the order of ids, and the sequence number that the set
    // corresponds to, read in one transaction. `visit` may read, but not write.
    [[nodiscard]] Result<std::int64_t> for_each_searchable(
        const std::function<void(const SearchableImage&)>& visit);
    // The same of those in the range; ends early, without an error, when `visit` says false.
    // Several connections that read ranges beside each other see what was committed up to the
    // smallest of their sequence numbers, and some of them later commits as well.
    [[nodiscard]] Result<std::int64_t> for_each_searchable(
        const IdRange& range,
        const std::function<bool(const SearchableImage&)>& visit);
    // That of the last change there is.
    [[nodiscard]] Result<std::int64_t> last_sequence();
    // Ranges that follow one another and have room for every id, each with `size` (>= 1)
    // searchable pictures; the last may have fewer, or none.
    [[nodiscard]] Result<std::vector<IdRange>> searchable_ranges(int size);
    // The changes after `sequence`, oldest first, at most `limit` (>= 1); a row changed
    // several times appears once, at its last change. A picture that a follower never saw
    // may appear as gone. What a search cannot see (stamp, tags, metadata) is no change.
    [[nodiscard]] Result<std::vector<Change>> changes_after(std::int64_t sequence,
                                                            int limit);

  private:
    struct Statements;
    std::unique_ptr<Statements> statements_;
};

}  // namespace haarmony::schema
