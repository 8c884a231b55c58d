// The job "video": makes a multiresolution video of what its request names.
//
//   job_runner -> [video_job] -> video_build
//
// Request  video_request.h. Counts and result: video_build.h.
//
// After a restart it begins anew from its input, which is kept until the job has ended.
#pragma once

#include "server/app/job_runner.h"
#include "server/app/media_roots.h"
#include "server/app/video_service.h"

namespace haarmony::server {

// Requires: `videos` outlives the job.
[[nodiscard]] JobType video_job(VideoService& videos, const MediaRoots& media_roots);

}  // namespace haarmony::server
