// The options that all ways to make a video take, and the job that makes it.
//
// Errors   400, and 422 for a side below 1, left in the inputs.
#pragma once

#include <cstddef>
#include <span>

#include "engine/video/clip_shape.h"
#include "server/api/context.h"
#include "server/api/inputs.h"
#include "server/api/outcome.h"
#include "server/app/video_request.h"

namespace haarmony::server {

// name, delta, max_frames, index.
[[nodiscard]] VideoWishes read_video_wishes(Inputs& inputs);

// width, height, rate. A side that is not given is 0; the rate is then 25.
[[nodiscard]] video::FrameFormat read_frame_format(Inputs& inputs);

// Keeps `input`, if there is any, for the job: 202 with the job and its Location.
[[nodiscard]] Reply queue_video(const Context& context,
                                VideoRequest video,
                                std::span<const std::byte> input);

}  // namespace haarmony::server
