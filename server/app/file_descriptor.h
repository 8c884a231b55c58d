// An open file that closes itself, and what the operating system said when it would not.
#pragma once

#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <utility>

#include "engine/core/result.h"

namespace haarmony::server {

class FileDescriptor {
  public:
    FileDescriptor() = default;
    explicit FileDescriptor(int descriptor) : descriptor_(descriptor) {}
    FileDescriptor(FileDescriptor&& other) noexcept
        : descriptor_(std::exchange(other.descriptor_, -1)) {}
    FileDescriptor& operator=(FileDescriptor&& other) noexcept {
        std::swap(descriptor_, other.descriptor_);
        return *this;
    }
    ~FileDescriptor() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }

    [[nodiscard]] int get() const { return descriptor_; }
    explicit operator bool() const { return descriptor_ >= 0; }

  private:
    int descriptor_ = -1;
};

// Of the call that has just failed.
[[nodiscard]] inline Error system_error(const std::string& path, const char* what) {
    const int number = errno;
    return {number == ENOENT ? ErrorCode::kNotFound : ErrorCode::kIo,
            path + ": cannot be " + what + ": " + std::strerror(number)};
}

// All of the bytes, from an offset of the file; `path` for messages.
[[nodiscard]] inline Result<void> write_at(const FileDescriptor& file,
                                           std::uint64_t offset,
                                           std::span<const std::byte> bytes,
                                           const std::string& path) {
    while (!bytes.empty()) {
        const ssize_t written =
            ::pwrite(file.get(), bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return system_error(path, "written");
        offset += static_cast<std::uint64_t>(written);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    return {};
}

}  // namespace haarmony::server
