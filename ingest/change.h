// Change detection: what a file needs, by what the database knows of it.
//
// Before it is read (first_need): nothing while size and mtime are as recorded; a file that
// failed is always tried again; a picture deleted through the API stays deleted until its
// content changes, or until `restore`. After it is read (settle, in the transaction that
// writes, since another process may have been faster): which one row operation.
//
// A file that changes within one tick of its clock after it was read keeps size and mtime,
// and its change would never be seen. So a stamp taken within kRacyNs of the file's mtime
// is recorded with kUnsettledMtime, which no later look equals: the next run compares the
// content once more.
//
// Units   nanoseconds since 1970.
// Threads pure functions.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "ingest/walk.h"
#include "schema/image_store.h"

namespace haarmony::ingest {

// FAT counts in steps of two seconds: the coarsest clock of a file system in use.
inline constexpr std::int64_t kRacyNs = 2'000'000'000;
inline constexpr std::int64_t kUnsettledMtime = std::numeric_limits<std::int64_t>::min();

enum class Need {
    kNothing,  // unchanged
    kCompare,  // read it, and decode only what differs from the recorded content
    kDecode,
};

// Whether a row's state says all that its content can: nothing to gain by decoding again.
[[nodiscard]] bool is_final(const std::optional<schema::KnownFile>& known, bool restore);

[[nodiscard]] Need first_need(const std::optional<schema::KnownFile>& known,
                              const FileLook& look,
                              bool restore);

// The system's clock.
[[nodiscard]] std::int64_t now_ns();

// What to record of a file that was read at `now_ns`.
[[nodiscard]] schema::FileStamp stamp_of(const FileLook& look,
                                         std::int64_t now_ns,
                                         std::string content_hash);

// What came of reading a file.
struct SameContent {
    schema::FileStamp stamp;
};
struct Described {
    schema::NewImage image;
};
struct DescribedFilm {  // film_rows.h
    schema::FileStamp stamp;
    std::vector<schema::NewImage> frames;  // with their own stamps and addresses
};
struct Undecodable {
    schema::FileStamp stamp;
    std::string reason;
};
struct Unreadable {  // the bytes are not known
    schema::FileStamp stamp;
    std::string reason;
};
using Reading =
    std::variant<SameContent, Described, DescribedFilm, Undecodable, Unreadable>;

enum class RowOperation { kNone, kTouch, kAdd, kUpdate, kMarkFailed };
enum class CountedAs { kAdded, kUpdated, kSkipped, kFailed };

struct Settlement {
    RowOperation operation = RowOperation::kNone;
    CountedAs counted_as = CountedAs::kSkipped;

    friend bool operator==(const Settlement&, const Settlement&) = default;
};

// `known` is the row at the time of writing. A file that was recorded and can for now not be
// read keeps its row as it is. Requires: not the reading of a film.
[[nodiscard]] Settlement settle(const std::optional<schema::KnownFile>& known,
                                const Reading& reading,
                                bool restore);

}  // namespace haarmony::ingest
