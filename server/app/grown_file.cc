#include "server/app/grown_file.h"

#include <fcntl.h>
#include <linux/fs.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <vector>

namespace haarmony::server {
namespace {

// Between file systems, and where the kernel cannot.
Result<void> copy_by_hand(int from,
                          const std::string& original,
                          const FileDescriptor& to,
                          const std::string& path) {
    constexpr std::size_t kPiece = std::size_t{1} << 20;
    std::vector<std::byte> piece(kPiece);
    for (std::uint64_t offset = 0;;) {
        const ssize_t got =
            ::pread(from, piece.data(), piece.size(), static_cast<off_t>(offset));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return system_error(original, "read");
        if (got == 0) return {};
        const auto bytes = static_cast<std::size_t>(got);
        const Result<void> put =
            write_at(to, offset, std::span(piece).first(bytes), path);
        if (!put) return put;
        offset += bytes;
    }
}

Result<void> copy(int from,
                  const std::string& original,
                  const FileDescriptor& to,
                  const std::string& path) {
    if (::ioctl(to.get(), FICLONE, from) == 0) return {};
    constexpr std::size_t kPiece = std::size_t{1} << 30;
    for (bool any = false;;) {
        const ssize_t copied =
            ::copy_file_range(from, nullptr, to.get(), nullptr, kPiece, 0);
        if (copied < 0 && errno == EINTR) continue;
        // Nothing at first may mean a file system that only pretends.
        if (copied <= 0 && !any) return copy_by_hand(from, original, to, path);
        if (copied < 0) return system_error(path, "written");
        if (copied == 0) return {};
        any = true;
    }
}

}  // namespace

Result<GrownFile> GrownFile::copy_of(const std::string& original,
                                     const std::string& path) {
    const FileDescriptor from(::open(original.c_str(), O_RDONLY | O_CLOEXEC));
    if (!from) return system_error(original, "opened");
    FileDescriptor to(::open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
    if (!to) return system_error(path, "made");
    if (const auto copied = copy(from.get(), original, to, path); !copied)
        return copied.error();
    return GrownFile(std::move(to), path);
}

Result<void> GrownFile::write(std::uint64_t offset, std::span<const std::byte> bytes) {
    return write_at(file_, offset, bytes, path_);
}

Result<void> GrownFile::sync() {
    if (::fsync(file_.get()) != 0) return system_error(path_, "synchronised");
    return {};
}

}  // namespace haarmony::server
