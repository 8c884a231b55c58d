// The job "snapshot": writes the snapshot file now.
//
//   job_runner -> [snapshot_job] -> snapshot_keeper
//
// Counts   seen: bytes written, of the total.
// Result   bytes: of the file; images: that it holds; sequence: its last change.
#pragma once

#include "server/app/index_follower.h"
#include "server/app/job_runner.h"
#include "server/app/snapshot_keeper.h"

namespace haarmony::server {

// After a restart it begins anew. Requires: both outlive the job.
[[nodiscard]] JobType snapshot_job(const IndexFollower& follower, SnapshotKeeper& keeper);

}  // namespace haarmony::server
