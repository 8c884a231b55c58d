#include "server/app/file_spool.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace haarmony::server {
namespace {

constexpr std::size_t kGathered = std::size_t{1} << 20;

}  // namespace

Result<FileSpool> FileSpool::nameless(const std::string& folder) {
    std::string path = folder + '/' + std::string(kMoment) + "XXXXXX";
    FileDescriptor file(::mkostemp(path.data(), O_CLOEXEC));
    if (!file) return system_error(path, "made");
    if (::unlink(path.c_str()) != 0) return system_error(path, "removed");
    return FileSpool(std::move(file), std::move(path));
}

Result<FileSpool> FileSpool::named(const std::string& path) {
    FileDescriptor file(
        ::open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
    if (!file) return system_error(path, "made");
    return FileSpool(std::move(file), path);
}

FileSpool::FileSpool(FileDescriptor file, std::string path)
    : file_(std::move(file)), path_(std::move(path)) {}

Result<std::uint64_t> FileSpool::append(std::span<const std::byte> bytes) {
    const std::uint64_t offset = this->bytes();
    if (waiting_.size() + bytes.size() > kGathered) {
        if (Result<void> flushed = flush(); !flushed) return flushed.error();
    }
    if (bytes.size() > kGathered) {
        if (Result<void> put = write_at(file_, written_, bytes, path_); !put)
            return put.error();
        written_ += bytes.size();
    } else {
        waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
    }
    return offset;
}

Result<void> FileSpool::flush() {
    Result<void> put = write_at(file_, written_, waiting_, path_);
    if (!put) return put;
    written_ += waiting_.size();
    waiting_.clear();
    return {};
}

Result<void> FileSpool::read(std::uint64_t offset, std::span<std::byte> bytes) {
    while (!bytes.empty()) {
        if (offset >= written_) {
            std::memcpy(bytes.data(),
                        waiting_.data() + static_cast<std::size_t>(offset - written_),
                        bytes.size());
            return {};
        }
        const auto piece = static_cast<std::size_t>(
            std::min<std::uint64_t>(bytes.size(), written_ - offset));
        const ssize_t got =
            ::pread(file_.get(), bytes.data(), piece, static_cast<off_t>(offset));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return system_error(path_, "read");
        if (got == 0) return Error{ErrorCode::kIo, path_ + ": became shorter"};
        offset += static_cast<std::uint64_t>(got);
        bytes = bytes.subspan(static_cast<std::size_t>(got));
    }
    return {};
}

Result<void> FileSpool::sync() {
    Result<void> flushed = flush();
    if (flushed && ::fsync(file_.get()) != 0) return system_error(path_, "synchronised");
    return flushed;
}

}  // namespace haarmony::server
