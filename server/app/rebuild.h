// The search indexes from the database alone: every stored signature, in ranges of ids that
// several threads read and make segments of.
//   SQLite -> [rebuild.h] -> variant_indexes.h
//
// Errors   as ImageStore; kUnavailable where it was told to stop. A signature that does not
//          decode is none: it is told, and left out.
// Threads  any. Memory: a segment's records for each thread, 0.7 KB a picture.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/executor.h"
#include "engine/core/ids.h"
#include "engine/core/result.h"
#include "engine/image/record.h"
#include "server/app/connection.h"
#include "server/app/variant_indexes.h"

namespace haarmony::server {

struct DamagedSignature {
    ImageId id{};
    std::string reason;
};

// The pictures of a range of ids, in their order.
struct StoredRecords {
    // All changes up to it are in; some later ones may be, too.
    std::int64_t sequence = 0;
    std::int64_t images = 0;
    std::map<std::string, std::vector<image::Record>, std::less<>> variants;
    std::vector<DamagedSignature> damaged;
};
// `most` is how many pictures are expected.
[[nodiscard]] Result<StoredRecords> read_records(schema::ImageStore& images,
                                                 const schema::IdRange& range,
                                                 std::size_t most,
                                                 const std::function<bool()>& go_on);

// How many pictures to put into one segment, so that every thread has work and no segment is
// small without need.
[[nodiscard]] int pictures_per_segment(std::int64_t images, int threads);

struct Rebuilt {
    // Whoever applies the changes after it has what the database has.
    std::int64_t sequence = 0;
    std::int64_t images = 0;
    std::vector<DamagedSignature> damaged;
    SegmentsByVariant segments;
};

struct RebuildOptions {
    int index_m = 0;
    int threads = 1;              // that the executor has, the caller's included
    std::function<bool()> go_on;  // false: stop
};

[[nodiscard]] Result<Rebuilt> rebuild(ReadConnections& connections,
                                      const RebuildOptions& options,
                                      Executor& executor);

}  // namespace haarmony::server
