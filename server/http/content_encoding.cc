#include "server/http/content_encoding.h"

#include <zlib.h>

#include <cassert>
#include <new>

#include "server/http/header_value.h"

namespace haarmony::http {
namespace {

// A list of 1,000 matches, 209 kB: level 4 makes 25.7 kB in 2.0 ms, level 6 24.3 kB in 2.9 ms.
constexpr int kLevel = 4;
constexpr int kWindowWithGzipHeader = 15 + 16;
constexpr int kMemoryLevel = 8;

bool is_text(std::string_view content_type) {
    const std::string type =
        lower_case(trim(content_type.substr(0, content_type.find(';'))));
    return type.starts_with("text/") || type.ends_with("/json") ||
           type.ends_with("+json") || type.ends_with("+xml") ||
           type == "application/javascript" || type == "application/xml" ||
           type == "application/x-ndjson" || type == "application/postscript";
}

// The weight of "gzip;q=0.5" in thousandths; malformed weights count as none.
int weight_of(std::string_view element) {
    const std::size_t semicolon = element.find(';');
    if (semicolon == std::string_view::npos) return 1000;
    const std::string_view parameter = trim(element.substr(semicolon + 1));
    if (parameter.size() < 3 || (parameter[0] != 'q' && parameter[0] != 'Q') ||
        parameter[1] != '=') {
        return 0;
    }
    const std::string_view digits = parameter.substr(2);
    if (digits[0] != '0' && digits[0] != '1') return 0;
    int weight = (digits[0] - '0') * 1000;
    if (digits.size() == 1) return weight;
    if (digits[1] != '.' || digits.size() > 5) return 0;
    int place = 100;
    for (const char c : digits.substr(2)) {
        if (c < '0' || c > '9') return 0;
        weight += (c - '0') * place;
        place /= 10;
    }
    return weight > 1000 ? 0 : weight;
}

void vary_by_encoding(Headers& headers) {
    constexpr std::string_view kName = "Accept-Encoding";
    std::string& vary = headers["Vary"];
    for (const std::string_view element : split_list(vary)) {
        if (element == "*" || equal_without_case(element, kName)) return;
    }
    vary += vary.empty() ? "" : ", ";
    vary += kName;
}

}  // namespace

bool prefers_gzip(std::string_view accept_encoding) {
    constexpr int kUnsaid = -1;
    int gzip_weight = kUnsaid;
    int identity = kUnsaid;
    int any = kUnsaid;
    for (const std::string_view element : split_list(accept_encoding)) {
        const std::string coding = lower_case(trim(element.substr(0, element.find(';'))));
        const int weight = weight_of(element);
        if (coding == "gzip" || coding == "x-gzip") gzip_weight = weight;
        if (coding == "identity") identity = weight;
        if (coding == "*") any = weight;
    }
    if (gzip_weight == kUnsaid) gzip_weight = any;
    return gzip_weight > 0 && gzip_weight >= identity;
}

bool select_gzip(const Request& request, Response& response) {
    const auto* bytes = std::get_if<std::string>(&response.body);
    const auto type = response.headers.find("Content-Type");
    if (bytes == nullptr || bytes->size() < kMinCompressed ||
        type == response.headers.end() || !is_text(type->second) ||
        response.headers.contains("Content-Encoding")) {
        return false;
    }
    vary_by_encoding(response.headers);
    if (!prefers_gzip(request.header("Accept-Encoding"))) return false;
    const auto etag = response.headers.find("ETag");
    if (etag != response.headers.end() && !etag->second.starts_with("W/")) {
        etag->second.insert(0, "W/");
    }
    // A range counts plain bytes, which this answer does not have.
    response.headers.erase("Accept-Ranges");
    return true;
}

void gzip_body(Response& response) {
    auto* bytes = std::get_if<std::string>(&response.body);
    assert(bytes != nullptr);
    *bytes = gzip(*bytes);
    response.headers["Content-Encoding"] = "gzip";
}

std::string gzip(std::string_view bytes) {
    z_stream stream{};
    if (deflateInit2(&stream,
                     kLevel,
                     Z_DEFLATED,
                     kWindowWithGzipHeader,
                     kMemoryLevel,
                     Z_DEFAULT_STRATEGY) != Z_OK) {
        throw std::bad_alloc();  // the only failure of valid parameters
    }
    std::string packed(deflateBound(&stream, bytes.size()), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    [[maybe_unused]] const int end = deflate(&stream, Z_FINISH);
    assert(end == Z_STREAM_END);  // deflateBound() left room enough
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    return packed;
}

}  // namespace haarmony::http
