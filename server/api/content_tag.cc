#include "server/api/content_tag.h"

#include <cstdint>

#include "ingest/describe.h"

namespace haarmony::server {

std::string content_tag(std::string_view bytes) {
    constexpr std::size_t kDigits = 32;  // 128 bits are enough to tell versions apart
    const std::string hash = ingest::content_hash(
        {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    return '"' + hash.substr(0, kDigits) + '"';
}

}  // namespace haarmony::server
