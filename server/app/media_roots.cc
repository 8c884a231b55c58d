#include "server/app/media_roots.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <system_error>

namespace haarmony::server {
namespace {

namespace fs = std::filesystem;

std::optional<char> hex_byte(std::string_view two_digits) {
    unsigned value = 0;
    const char* end = two_digits.data() + two_digits.size();
    const auto [stop, error] = std::from_chars(two_digits.data(), end, value, 16);
    if (two_digits.size() != 2 || error != std::errc{} || stop != end) return {};
    return static_cast<char>(value);
}

bool lies_below(const fs::path& path, const fs::path& root) {
    return std::mismatch(root.begin(), root.end(), path.begin(), path.end()).first ==
           root.end();
}

}  // namespace

std::optional<std::string> path_of_file_uri(std::string_view uri) {
    for (const std::string_view prefix : {"file:///", "file://localhost/"}) {
        if (!uri.starts_with(prefix)) continue;
        std::string path = "/";
        for (std::size_t i = prefix.size(); i < uri.size(); ++i) {
            char byte = uri[i];
            if (byte == '%') {
                const std::optional<char> escaped = hex_byte(uri.substr(i + 1, 2));
                if (!escaped) return {};
                byte = *escaped;
                i += 2;
            }
            if (byte == '\0') return {};
            path.push_back(byte);
        }
        return path;
    }
    return {};
}

Result<MediaRoots> MediaRoots::open(std::span<const std::string> folders) {
    MediaRoots roots;
    for (const std::string& folder : folders) {
        std::error_code error;
        const fs::path real = fs::canonical(folder, error);
        if (error || !fs::is_directory(real, error))
            return Error{ErrorCode::kInvalidArgument,
                         "--media-root " + folder + " is not a folder",
                         "media-root"};
        roots.roots_.push_back(real.string());
    }
    return roots;
}

bool MediaRoots::contain(const std::string& path) const {
    return std::any_of(roots_.begin(), roots_.end(), [&](const std::string& root) {
        return lies_below(path, root);
    });
}

Result<std::string> MediaRoots::locate(std::string_view uri) const {
    const std::optional<std::string> path = path_of_file_uri(uri);
    if (!path)
        return Error{ErrorCode::kNotFound, "the picture has no file on this server"};
    // weakly_canonical resolves what exists of the path, so that a file that is gone from
    // below a root is told from one that lies outside.
    std::error_code error;
    const fs::path real = fs::weakly_canonical(*path, error);
    if (error || !contain(real.string()))
        return Error{ErrorCode::kForbidden,
                     "the picture's file is not below a media root of this server"};
    if (!fs::is_regular_file(real, error))
        return Error{ErrorCode::kNotFound, "the picture's file is gone"};
    return real.string();
}

}  // namespace haarmony::server
