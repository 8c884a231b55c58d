// GET /video/play: a video at constant perceived speed, as a stream of pictures that replace
// each other.
//
// Which time and space levels are shown is decided from what the pictures before have cost
// to draw and to encode (engine/video/constant_speed.h). Pictures leave when they are due; a
// client that reads slowly sees fewer, each of which covers more time.
#pragma once

#include "server/api/context.h"
#include "server/api/outcome.h"

namespace haarmony::server {

[[nodiscard]] Reply get_play(const Context& context, const http::Request& request);

}  // namespace haarmony::server
