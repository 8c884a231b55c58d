// The files that are part of the executable (cmake/embed.cmake).
#pragma once

#include <span>

#include "server/http/static_files.h"

namespace haarmony::server {

// The page: what stands in web/.
[[nodiscard]] std::span<const http::EmbeddedFile> embedded_web();
// One file, "openapi.json", made of schema/openapi.yaml.
[[nodiscard]] std::span<const http::EmbeddedFile> embedded_openapi();

}  // namespace haarmony::server
