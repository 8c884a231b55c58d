// Small pictures along a video for a slider: a WebVTT track, and the one picture that its
// cues point into.
#pragma once

#include "server/api/context.h"
#include "server/api/outcome.h"

namespace haarmony::server {

[[nodiscard]] Reply get_thumbnail_track(const Context& context,
                                        const http::Request& request);
[[nodiscard]] Reply get_thumbnail_sprite(const Context& context,
                                         const http::Request& request);

}  // namespace haarmony::server
