#include "server/http/static_files.h"

#include <sys/stat.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <system_error>
#include <utility>

#include "server/http/file_body.h"
#include "server/http/header_value.h"
#include "server/http/problem.h"

namespace haarmony::http {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPolicy =
    "default-src 'self'; img-src 'self' blob: data:; object-src 'none'; base-uri 'none'; "
    "form-action 'self'; frame-ancestors 'none'";

Response not_found(const Request& request) {
    return to_response({.status = 404,
                        .code = "not_found",
                        .detail = "There is nothing at '" + request.path + "'."},
                       request);
}

// "/js/canvas.js" -> "js/canvas.js"; nothing if a segment is empty or begins with a dot,
// which covers "..", or holds a NUL or a backslash.
std::optional<std::string> file_name_of(std::string_view path) {
    if (path == "/") return "index.html";
    if (!path.starts_with('/') || path.find('\0') != std::string_view::npos ||
        path.find('\\') != std::string_view::npos) {
        return std::nullopt;
    }
    path.remove_prefix(1);
    for (std::string_view rest = path;;) {
        const std::size_t slash = rest.find('/');
        const std::string_view segment = rest.substr(0, slash);
        if (segment.empty() || segment.front() == '.') return std::nullopt;
        if (slash == std::string_view::npos) break;
        rest.remove_prefix(slash + 1);
    }
    return std::string(path);
}

std::string hexadecimal(std::uint64_t value) {
    std::array<char, 17> text{};
    const int length = std::snprintf(
        text.data(), text.size(), "%llx", static_cast<unsigned long long>(value));
    return std::string(text.data(), static_cast<std::size_t>(length));
}

// FNV-1a: the tag tells versions of one file apart, it does not defend against anybody.
std::string etag_of(std::string_view content) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const char c : content) {
        hash = (hash ^ static_cast<std::uint8_t>(c)) * 0x100000001b3;
    }
    return '"' + hexadecimal(content.size()) + '-' + hexadecimal(hash) + '"';
}

std::string etag_of(const struct stat& status) {
    return '"' + hexadecimal(static_cast<std::uint64_t>(status.st_size)) + '-' +
           hexadecimal(static_cast<std::uint64_t>(status.st_mtim.tv_sec)) + '.' +
           hexadecimal(static_cast<std::uint64_t>(status.st_mtim.tv_nsec)) + '"';
}

Headers headers_for(std::string_view name, std::string etag) {
    Headers headers;
    headers["Content-Type"] = media_type_of(name);
    headers["ETag"] = std::move(etag);
    headers["Cache-Control"] = "no-cache";
    headers["Content-Security-Policy"] = kPolicy;
    headers["Referrer-Policy"] = "no-referrer";
    headers["X-Content-Type-Options"] = "nosniff";
    return headers;
}

bool is_below(const fs::path& root, const fs::path& path) {
    auto at = path.begin();
    for (const fs::path& part : root) {
        if (at == path.end() || *at != part) return false;
        ++at;
    }
    return at != path.end();
}

}  // namespace

Result<StaticFiles> StaticFiles::open(const fs::path& directory) {
    std::error_code error;
    const fs::path root = fs::canonical(directory, error);
    if (error || !fs::is_directory(root, error)) {
        return Error{.code = ErrorCode::kNotFound,
                     .message = "no directory '" + directory.string() + "'",
                     .param = {}};
    }
    return StaticFiles(root);
}

StaticFiles::StaticFiles(std::span<const EmbeddedFile> embedded) : embedded_(embedded) {}

Response StaticFiles::operator()(const Request& request) const {
    const std::optional<std::string> name = file_name_of(request.path);
    if (!name) return not_found(request);
    return root_.empty() ? from_memory(request, *name) : from_directory(request, *name);
}

Response StaticFiles::from_memory(const Request& request, const std::string& name) const {
    for (const EmbeddedFile& file : embedded_) {
        if (file.path != name) continue;
        return {.status = 200,
                .headers = headers_for(name, etag_of(file.content)),
                .body = std::string(file.content)};
    }
    return not_found(request);
}

Response StaticFiles::from_directory(const Request& request,
                                     const std::string& name) const {
    std::error_code error;
    const fs::path path = fs::canonical(root_ / name, error);
    struct stat status {};
    if (error || !is_below(root_, path) || ::stat(path.c_str(), &status) != 0 ||
        !S_ISREG(status.st_mode)) {
        return not_found(request);
    }
    const FileRange whole{.path = path.string(),
                          .offset = 0,
                          .length = static_cast<std::uint64_t>(status.st_size)};
    if (whole.length > kHashed) {
        Response response{
            .status = 200, .headers = headers_for(name, etag_of(status)), .body = whole};
        response.headers["Accept-Ranges"] = "bytes";
        return response;
    }
    Result<ChunkSource> source = open_file_range(whole);
    if (!source) return not_found(request);
    std::string content;
    while (std::optional<std::string> chunk = (*source)()) content += *chunk;
    std::string etag = etag_of(content);
    return {.status = 200,
            .headers = headers_for(name, std::move(etag)),
            .body = std::move(content)};
}

std::string_view media_type_of(std::string_view name) {
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 20> kTypes{
        {
            {"css", "text/css; charset=utf-8"},
            {"gif", "image/gif"},
            {"htm", "text/html; charset=utf-8"},
            {"html", "text/html; charset=utf-8"},
            {"ico", "image/vnd.microsoft.icon"},
            {"jpeg", "image/jpeg"},
            {"jpg", "image/jpeg"},
            {"js", "text/javascript; charset=utf-8"},
            {"json", "application/json"},
            {"map", "application/json"},
            {"mjs", "text/javascript; charset=utf-8"},
            {"png", "image/png"},
            {"svg", "image/svg+xml"},
            {"txt", "text/plain; charset=utf-8"},
            {"wasm", "application/wasm"},
            {"webmanifest", "application/manifest+json"},
            {"webp", "image/webp"},
            {"woff2", "font/woff2"},
            {"xml", "application/xml"},
            {"yaml", "application/yaml"},
        }};
    const std::size_t dot = name.rfind('.');
    if (dot != std::string_view::npos) {
        const std::string extension = lower_case(name.substr(dot + 1));
        for (const auto& [known, type] : kTypes) {
            if (known == extension) return type;
        }
    }
    return "application/octet-stream";
}

}  // namespace haarmony::http
