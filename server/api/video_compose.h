// POST /videos/compose: layers of videos and still pictures become a video, or one picture
// at once.
//
//   Inputs -> [video_compose] -> server/app/composition_request.h -> the job "video"
//
// Errors   400 for what has another type or name, naming its place; 404 for a video or image
//          that is not there; 422 for what cannot be composed: all before there is a job.
#pragma once

#include "server/api/context.h"
#include "server/api/outcome.h"

namespace haarmony::server {

// 202 with the job and its Location; with "preview" the picture, marked by X-Preview.
[[nodiscard]] Reply post_composition(const Context& context,
                                     const http::Request& request);

}  // namespace haarmony::server
