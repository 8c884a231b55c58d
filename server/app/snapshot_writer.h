// Writes a snapshot file: from the segments where they are, under another name, and published
// only when it has been read back and every posting has been looked at.
//   variant_indexes.h -> [snapshot_writer.h] -> file -> snapshot_reader.h
//
// Under its final name there is always a whole file, or none: what is written is on the disk
// before it is renamed. What a killed process leaves is PATH.partial, which the next one
// overwrites; two processes never write it at the same time.
//
// Errors   kUnavailable where another process writes it, or it was told to stop; those of the
//          token; kUndecodable where what was written is found damaged; kIo.
// Threads  any; one file at a time.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "engine/core/executor.h"
#include "engine/core/result.h"
#include "schema/snapshot_store.h"
#include "server/app/snapshot_reader.h"

namespace haarmony::server {

struct SnapshotWriting {
    std::string path;
    // Asked once, when all else is written.
    std::function<Result<schema::SnapshotToken>()> token;
    // Told often how many bytes of how many are written; false: stop.
    std::function<bool(std::uint64_t bytes, std::uint64_t total)> go_on;
};

// The bytes of the file. Cost: memory of the table alone.
[[nodiscard]] Result<std::uint64_t> write_snapshot(const SnapshotContents& contents,
                                                   const SnapshotWriting& writing,
                                                   Executor& executor);

}  // namespace haarmony::server
