// The types of jobs that the daemon knows, by the names that clients use.
#pragma once

#include "ingest/decode.h"
#include "server/app/index_follower.h"
#include "server/app/ingest_job.h"
#include "server/app/job_runner.h"
#include "server/app/snapshot_keeper.h"

namespace haarmony::server {

// Requires: the first two outlive the jobs.
[[nodiscard]] JobTypes job_types(const IndexFollower& follower,
                                 SnapshotKeeper& snapshots,
                                 const IngestJobOptions& ingest,
                                 const ingest::DecodeLimits& decode);

}  // namespace haarmony::server
