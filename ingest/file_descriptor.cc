#include "ingest/file_descriptor.h"

#include <fcntl.h>

#include <cassert>
#include <cerrno>
#include <climits>

namespace haarmony::ingest {
namespace {

// PATH_MAX counts the terminating zero.
constexpr std::size_t kLongest = PATH_MAX - 1;

FileDescriptor open_at(int folder, const std::string& path, int flags) {
    int number = -1;
    do {
        number = ::openat(folder, path.c_str(), flags | O_CLOEXEC);
    } while (number < 0 && errno == EINTR);
    return FileDescriptor(number);
}

}  // namespace

FileDescriptor open_path(const std::string& path, int flags) {
    assert(!path.empty() && path.front() == '/');
    if (path.size() <= kLongest) return open_at(AT_FDCWD, path, flags);
    FileDescriptor folder = open_at(AT_FDCWD, "/", O_PATH | O_DIRECTORY);
    std::size_t start = 1;
    while (folder.valid() && path.size() - start > kLongest) {
        const std::size_t slash = path.rfind('/', start + kLongest);
        if (slash == std::string::npos || slash <= start) {
            errno = ENAMETOOLONG;
            return {};
        }
        folder = open_at(
            folder.get(), path.substr(start, slash - start), O_PATH | O_DIRECTORY);
        start = slash + 1;
    }
    if (!folder.valid()) return {};
    return open_at(folder.get(), path.substr(start), flags);
}

}  // namespace haarmony::ingest
