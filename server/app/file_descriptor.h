// An open file that closes itself, and what the operating system said when it would not.
#pragma once

#include <unistd.h>

#include <cerrno>
#include <cstring>
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

}  // namespace haarmony::server
