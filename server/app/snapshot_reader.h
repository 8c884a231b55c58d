// A snapshot file back as segments, in the time it takes to read its bytes once.
//   snapshot_writer.h -> file -> [snapshot_reader.h] -> variant_indexes.h
//
// The segments lie in the file, which stays mapped as long as one of them is in use.
//
// Errors   kNotFound where there is no file; for one that cannot be used, for whatever reason,
//          another code and what is wrong. Nothing of such a file is used.
// Threads  any.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/executor.h"
#include "engine/core/ids.h"
#include "engine/core/result.h"
#include "engine/image/segment.h"
#include "server/app/mapped_file.h"
#include "server/app/snapshot_format.h"
#include "server/app/variant_indexes.h"

namespace haarmony::server {

// The indexes as they were after the change `sequence`.
struct SnapshotContents {
    std::int64_t sequence = 0;
    int index_m = 0;
    std::vector<ImageId> damaged;
    SegmentsByVariant segments;
};

// `belongs` says whether the file is one of the database's own, and a recent one; it is asked
// before the parts are read.
[[nodiscard]] Result<SnapshotContents> read_snapshot(
    const std::string& path,
    int index_m,
    const std::function<Result<void>(const SnapshotTable&)>& belongs,
    Executor& executor);

// The parts of the table: each checksum, and the segments by `view`, which is view_segment or
// view_known_segment. With `forget`, a part that was checked leaves the memory again.
struct PartChecks {
    Result<image::SegmentView> (*view)(const image::SegmentCounts&,
                                       std::span<const std::byte>) = nullptr;
    bool forget = false;
};
[[nodiscard]] Result<std::vector<image::LiveSegment>> read_parts(
    const std::shared_ptr<const MappedFile>& file,
    const SnapshotTable& table,
    const PartChecks& checks,
    Executor& executor);

}  // namespace haarmony::server
