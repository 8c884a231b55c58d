#include "server/app/media_roots.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "ingest/file_uri.h"

namespace haarmony::server {
namespace {

namespace fs = std::filesystem;

bool lies_below(const fs::path& path, const fs::path& root) {
    return std::mismatch(root.begin(), root.end(), path.begin(), path.end()).first ==
           root.end();
}

}  // namespace

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
    const Result<std::string> path = ingest::path_from_file_uri(uri);
    if (!path)
        return Error{ErrorCode::kNotFound, "the picture has no file on this server"};
    // weakly_canonical resolves what exists of the path, so that a file that is gone from
    // below a root is told from one that lies outside.
    std::error_code error;
    const fs::path real = fs::weakly_canonical(path.value(), error);
    if (error || !contain(real.string()))
        return Error{ErrorCode::kForbidden,
                     "the picture's file is not below a media root of this server"};
    if (!fs::is_regular_file(real, error))
        return Error{ErrorCode::kNotFound, "the picture's file is gone"};
    return real.string();
}

Result<std::string> MediaRoots::locate_path(const std::string& path) const {
    if (!fs::path(path).is_absolute() || path.find('\0') != std::string::npos)
        return Error{ErrorCode::kInvalidArgument,
                     "'" + path + "' is not an absolute path"};
    std::error_code error;
    const fs::path real = fs::weakly_canonical(path, error);
    if (error || !contain(real.string()))
        return Error{ErrorCode::kForbidden,
                     "'" + path + "' is not below a media root of this server"};
    if (!fs::exists(real, error))
        return Error{ErrorCode::kNotFound, "'" + path + "' is gone"};
    return real.string();
}

}  // namespace haarmony::server
