// Whatever body comes in: refused with a reason, or parts that lie inside it, in order and
// without overlap.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "server/http/multipart.h"

namespace {

using haarmony::http::Part;

void require(bool holds) {
    if (!holds) std::abort();
}

void check(std::string_view content_type, std::string_view body) {
    const auto parts = haarmony::http::parse_multipart(content_type, body);
    if (!parts) {
        require(!parts.error().message.empty());
        return;
    }
    require(parts->size() <= haarmony::http::kMaxParts);
    const char* end = body.data();
    for (const Part& part : *parts) {
        require(!part.name.empty());
        require(part.body.data() >= end);
        end = part.body.data() + part.body.size();
        require(end <= body.data() + body.size());
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(bytes), size);
    check("multipart/form-data; boundary=B", text);
    // And with the first line as the content type.
    const std::size_t line = text.find('\n');
    if (line != std::string_view::npos)
        check(text.substr(0, line), text.substr(line + 1));
    return 0;
}
