#include "ingest/file_uri.h"

#include <cassert>
#include <filesystem>
#include <optional>
#include <system_error>

#include "ingest/media_fragment.h"

namespace haarmony::ingest {
namespace {

constexpr std::string_view kScheme = "file://";

bool stands_for_itself(unsigned char byte) {
    return (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') ||
           (byte >= '0' && byte <= '9') || byte == '-' || byte == '.' || byte == '_' ||
           byte == '~' || byte == '/';
}

std::optional<unsigned> hex_digit(char digit) {
    if (digit >= '0' && digit <= '9') return digit - '0';
    if (digit >= 'A' && digit <= 'F') return digit - 'A' + 10;
    if (digit >= 'a' && digit <= 'f') return digit - 'a' + 10;
    return std::nullopt;
}

Error not_a_file_uri(std::string_view uri, const char* why) {
    return {ErrorCode::kInvalidArgument, "'" + std::string(uri) + "' " + why, "uri"};
}

}  // namespace

std::string file_uri(std::string_view path) {
    assert(!path.empty() && path.front() == '/');
    constexpr char kHex[] = "0123456789ABCDEF";
    std::string uri(kScheme);
    uri.reserve(kScheme.size() + path.size());
    for (const char c : path) {
        const auto byte = static_cast<unsigned char>(c);
        if (stands_for_itself(byte)) {
            uri += c;
        } else {
            uri += '%';
            uri += kHex[byte >> 4];
            uri += kHex[byte & 15];
        }
    }
    return uri;
}

Result<std::string> path_from_file_uri(std::string_view uri) {
    if (!uri.starts_with(kScheme))
        return not_a_file_uri(uri, "does not start with file://");
    const std::string_view encoded = without_fragment(uri).substr(kScheme.size());
    if (!encoded.starts_with('/')) return not_a_file_uri(uri, "names a host");
    std::string path;
    path.reserve(encoded.size());
    for (std::size_t i = 0; i < encoded.size(); ++i) {
        if (encoded[i] != '%') {
            path += encoded[i];
            continue;
        }
        if (i + 2 >= encoded.size()) return not_a_file_uri(uri, "ends inside an escape");
        const auto high = hex_digit(encoded[i + 1]);
        const auto low = hex_digit(encoded[i + 2]);
        if (!high || !low) return not_a_file_uri(uri, "has an escape that is not hex");
        if (*high == 0 && *low == 0) return not_a_file_uri(uri, "has a zero byte");
        path += static_cast<char>(*high << 4 | *low);
        i += 2;
    }
    return path;
}

Result<std::string> normal_path(const std::string& path) {
    std::error_code error;
    const std::filesystem::path absolute = std::filesystem::absolute(path, error);
    if (error) return Error{ErrorCode::kIo, "'" + path + "': " + error.message(), {}};
    std::string normal = absolute.lexically_normal().string();
    if (normal.starts_with("//")) normal.erase(0, normal.find_first_not_of('/') - 1);
    if (normal.size() > 1 && normal.back() == '/') normal.pop_back();
    return normal;
}

}  // namespace haarmony::ingest
