// The types of jobs that the daemon knows, by the names that clients use.
#pragma once

#include "ingest/decode.h"
#include "server/app/index_follower.h"
#include "server/app/ingest_job.h"
#include "server/app/job_runner.h"

namespace haarmony::server {

// Requires: the follower outlives the jobs.
[[nodiscard]] JobTypes job_types(const IndexFollower& follower,
                                 const IngestJobOptions& ingest,
                                 const ingest::DecodeLimits& decode);

}  // namespace haarmony::server
