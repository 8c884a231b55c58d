// Paths as `file://` addresses and back, byte for byte.
//
// Shape   absolute, lexically normal paths; "file://" and the path, where the letters and
//         digits of ASCII, '-', '.', '_', '~' and '/' stand for themselves and every other
//         byte is %XX in upper case. One path has one address; the address of a folder
//         plus '/' is a prefix of the addresses of all that lies below, and of nothing else.
//         A fragment (media_fragment.h) names a part of the file and is left aside.
// Errors  path_from_file_uri: kInvalidArgument for another scheme, a host, a relative path,
//         a damaged escape or an encoded zero byte.
// Source  RFC 8089, RFC 3986 section 2.3.
#pragma once

#include <string>
#include <string_view>

#include "engine/core/result.h"

namespace haarmony::ingest {

// Requires: `path` is absolute.
[[nodiscard]] std::string file_uri(std::string_view path);

[[nodiscard]] Result<std::string> path_from_file_uri(std::string_view uri);

// Absolute (by the working directory), without ".", "..", doubled or final slashes. ".." is
// taken by name, without a look at what a link on the way points to.
// Errors: kIo when the working directory is gone.
[[nodiscard]] Result<std::string> normal_path(const std::string& path);

}  // namespace haarmony::ingest
