// The ETag of bytes that have no revision of their own: their hash.
#pragma once

#include <string>
#include <string_view>

namespace haarmony::server {

[[nodiscard]] std::string content_tag(std::string_view bytes);

}  // namespace haarmony::server
