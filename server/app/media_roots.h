// Which files of this machine may be handed out: those below the folders named by
// --media-root, symbolic links resolved first.
//
// Errors  messages name no path of the disk: they go to clients.
// Threads const-safe.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"

namespace haarmony::server {

class MediaRoots {
  public:
    // kInvalidArgument naming the folder (this one goes to the operator) that is none.
    [[nodiscard]] static Result<MediaRoots> open(std::span<const std::string> folders);

    // The real path of the regular file that a file:// address names. kForbidden where it
    // lies, or would lie, outside every root; kNotFound where the address names no file of
    // this machine or the file is gone.
    [[nodiscard]] Result<std::string> locate(std::string_view uri) const;
    // The real path of an absolute path to a file or a folder. kForbidden as above,
    // kNotFound where it is gone, kInvalidArgument where it is relative; these name the
    // path, which the client knows.
    [[nodiscard]] Result<std::string> locate_path(const std::string& path) const;

  private:
    [[nodiscard]] bool contain(const std::string& path) const;

    std::vector<std::string> roots_;  // real paths
};

}  // namespace haarmony::server
