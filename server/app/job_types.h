// The types of jobs that the daemon knows, by the names that clients use.
#pragma once

#include "ingest/decode.h"
#include "server/app/index_follower.h"
#include "server/app/ingest_job.h"
#include "server/app/job_runner.h"
#include "server/app/snapshot_keeper.h"
#include "server/app/video_service.h"

namespace haarmony::server {

// Requires: the first three outlive the jobs.
[[nodiscard]] JobTypes job_types(const IndexFollower& follower,
                                 SnapshotKeeper& snapshots,
                                 VideoService& videos,
                                 const IngestJobOptions& ingest,
                                 const ingest::DecodeLimits& decode);

}  // namespace haarmony::server
