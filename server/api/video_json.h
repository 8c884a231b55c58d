// Videos as the REST interface shows them.
#pragma once

#include <cstdint>
#include <string>

#include "engine/video/clip_shape.h"
#include "schema/video_store.h"
#include "server/api/outcome.h"
#include "server/http/message.h"

namespace haarmony::server {

// The {id} of the address: 400 unless it is a whole number above 0.
[[nodiscard]] Outcome<std::int64_t> video_id_of(const http::Request& request);

// "/videos/12".
[[nodiscard]] std::string video_address(std::int64_t id);

// One JSON object at the end of `out`.
void append_video(const schema::Video& video, std::string& out);

// kIo for a row that no clip can have.
[[nodiscard]] Result<video::ClipShape> shape_of(const schema::Video& video);

}  // namespace haarmony::server
