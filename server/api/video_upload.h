// POST /videos: what is to become a video, checked before its job is queued.
//
//   Inputs, body -> [video_upload] -> server/app/video_request.h -> the job "video"
//
// Errors   400 for options of another type or unknown; 413 for JSON above Context::max_body;
//          415 for a body of no known kind; 422 for bytes that are not whole frames, leaves
//          that no frame can have, a shape outside the limits of a clip: all before there is
//          a job.
#pragma once

#include "server/api/context.h"
#include "server/api/outcome.h"

namespace haarmony::server {

// 202 with the job and its Location.
[[nodiscard]] Reply post_video(const Context& context, const http::Request& request);

}  // namespace haarmony::server
