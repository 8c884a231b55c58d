// What became of the files of one run.
//
// Scale   of pictures, seen = added + updated + skipped + (failed files). A film is one seen
//         and its key frames are counted one by one: those added, those updated, and as
//         pruned those that it has no more; one where none was written is one skipped.
//         `failed` is the number of failures reported: files, folders that could not be
//         read, PATHs of no use. Only what is committed is counted.
#pragma once

#include <cstdint>

namespace haarmony::ingest {

struct Tally {
    std::int64_t seen = 0;
    std::int64_t added = 0;
    std::int64_t updated = 0;
    std::int64_t skipped = 0;
    std::int64_t failed = 0;
    std::int64_t pruned = 0;

    friend bool operator==(const Tally&, const Tally&) = default;
    Tally& operator+=(const Tally& more) {
        seen += more.seen;
        added += more.added;
        updated += more.updated;
        skipped += more.skipped;
        failed += more.failed;
        pruned += more.pruned;
        return *this;
    }
};

}  // namespace haarmony::ingest
