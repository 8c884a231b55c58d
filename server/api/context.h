// What the handlers share. It outlives every request.
#pragma once

#include <cstdint>

#include "server/app/image_service.h"
#include "server/app/media_roots.h"

namespace haarmony::server {

struct Context {
    ImageService& images;
    MediaRoots media_roots;
    bool allow_url_fetch = false;
    std::uint64_t max_body = std::uint64_t{64} << 20;  // bytes of a picture or of JSON
};

}  // namespace haarmony::server
