#include "ingest/read_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "ingest/file_descriptor.h"

namespace haarmony::ingest {
namespace {

Error system_error(int number) {
    // What has become a folder, a socket or a loop of links is as gone as what is deleted.
    const bool gone = number == ENOENT || number == ENOTDIR || number == ELOOP ||
                      number == ENXIO || number == ENODEV || number == EISDIR;
    return {gone ? ErrorCode::kNotFound : ErrorCode::kIo,
            std::generic_category().message(number),
            {}};
}

// Up to the size of `bytes`, fewer at the end of the file. Returns an errno value or 0.
int read_all(int file, std::vector<std::uint8_t>& bytes) {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t count = ::pread(
            file, bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return errno;
        if (count == 0) break;
        done += static_cast<std::size_t>(count);
    }
    bytes.resize(done);
    return 0;
}

// kUnavailable when the file changed meanwhile.
Result<FileContent> read_once(const std::string& path,
                              const ReadLimits& limits,
                              ByteBudget& budget) {
    // The file may have become a fifo: O_NONBLOCK keeps open() from waiting for a writer.
    const FileDescriptor file = open_path(path, O_RDONLY | O_NONBLOCK | O_NOCTTY);
    struct stat before {};
    if (!file.valid() || ::fstat(file.get(), &before) != 0) return system_error(errno);
    if (!S_ISREG(before.st_mode)) {
        return Error{ErrorCode::kNotFound, "is no regular file any more", {}};
    }
    if (before.st_size > limits.max_bytes) {
        return Error{ErrorCode::kTooLarge,
                     std::to_string(before.st_size) + " bytes, more than the limit of " +
                         std::to_string(limits.max_bytes),
                     {}};
    }
    FileContent content;
    content.share = budget.take(before.st_size);
    content.look = look_of(before);
    content.bytes.resize(static_cast<std::size_t>(before.st_size));
    if (const int number = read_all(file.get(), content.bytes); number != 0) {
        return system_error(number);
    }
    limits.before_second_look();
    struct stat after {};
    if (::fstat(file.get(), &after) != 0) return system_error(errno);
    if (look_of(after) != content.look) {
        return Error{ErrorCode::kUnavailable, "changes while it is read", {}};
    }
    return content;
}

}  // namespace

Result<FileContent> read_file(const std::string& path,
                              const ReadLimits& limits,
                              ByteBudget& budget) {
    for (int attempt = 1;; ++attempt) {
        Result<FileContent> content = read_once(path, limits, budget);
        const bool changed = !content && content.error().code == ErrorCode::kUnavailable;
        if (!changed || attempt == kReadAttempts) return content;
    }
}

}  // namespace haarmony::ingest
