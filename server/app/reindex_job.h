// The job "reindex": gives pictures that are stored already the signatures that they lack,
// from their originals, so that a profile of another kind finds them.
//
//   job_runner -> [reindex_job] -> ingest/decode, ingest/describe -> schema/image_store
//
// Request  {"profile": name} or {"color_space", "decomposition"}: the signatures of that
//          kind; {}: of all kinds that profiles use. "all": true makes anew what is there.
// Counts   updated: has new signatures; skipped: lacked none, or is gone; failed: named in
//          the errors, and still found under the kinds that it has.
//
// An original is used only while it is byte by byte what was ingested. An upload has none,
// nor has a frame of a film: what they lack is made of their thumbnails, and what they have is never
// replaced.
#pragma once

#include "ingest/decode.h"
#include "server/app/job_runner.h"

namespace haarmony::server {

// Goes on after the last picture that it saw.
[[nodiscard]] JobType reindex_job(const ingest::DecodeLimits& limits);

}  // namespace haarmony::server
