#include "server/app/job_types.h"

#include "server/app/find_duplicates_job.h"
#include "server/app/reindex_job.h"
#include "server/app/snapshot_job.h"
#include "server/app/video_job.h"

namespace haarmony::server {

JobTypes job_types(const IndexFollower& follower,
                   SnapshotKeeper& snapshots,
                   VideoService& videos,
                   const IngestJobOptions& ingest,
                   const ingest::DecodeLimits& decode) {
    return {{"find_duplicates", find_duplicates_job(follower)},
            {"ingest", ingest_job(ingest)},
            {"reindex", reindex_job(decode)},
            {"snapshot", snapshot_job(follower, snapshots)},
            {"video", video_job(videos, ingest.media_roots)}};
}

}  // namespace haarmony::server
