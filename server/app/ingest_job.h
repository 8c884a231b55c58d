// The job "ingest": what haarmony-ingest does, inside the daemon.
//
//   job_runner -> [ingest_job] -> ingest/pipeline
//
// Request  {"paths": [...]}: files and folders below a media root; "videos": true takes in the
//          key frames of films as well, at most "max_key_frames" of each.
// Counts   as ingest/tally.h; failed files are named by their addresses.
#pragma once

#include <string>

#include "server/app/job_runner.h"
#include "server/app/media_roots.h"

namespace haarmony::server {

struct IngestJobOptions {
    std::string database_path;
    MediaRoots media_roots;
    int threads = 1;  // that decode, >= 1
};

// After a restart it walks again, past the files that it has taken in.
[[nodiscard]] JobType ingest_job(const IngestJobOptions& options);

}  // namespace haarmony::server
