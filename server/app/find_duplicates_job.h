// The job "find_duplicates": every picture's nearest neighbours, and which of them are the
// same picture in other bytes.
//
//   job_runner -> [find_duplicates_job] -> index snapshot, engine/image/duplicates
//                                   '----> schema/duplicate_store
//
// Request  {"min_similarity": 0..1}, optional: leaves out weaker pairs.
// Counts   seen: pictures; added: pairs; skipped: pictures with next to no information,
//          which are duplicates of the same bytes only, and pictures deleted meanwhile;
//          failed: signatures that are damaged.
//
// Pairs appear all at once, when the job is done; what an earlier one found stays until
// then. Files that are the same byte by byte are no pairs here: they are known anyway
// (duplicate_groups.h).
#pragma once

#include "server/app/index_follower.h"
#include "server/app/job_runner.h"

namespace haarmony::server {

// At most so many neighbours of one picture are looked at: a thousand copies of one picture
// are one group without all of their pairs.
inline constexpr int kMaxNeighbours = 512;

// After a restart it begins anew. Requires: the follower outlives the job.
[[nodiscard]] JobType find_duplicates_job(const IndexFollower& follower);

}  // namespace haarmony::server
