// A file descriptor that closes itself, and opening by paths of any length.
//
// Errors  an invalid descriptor, with errno set by the call that failed.
// Threads as open(2).
#pragma once

#include <unistd.h>

#include <string>
#include <utility>

namespace haarmony::ingest {

class FileDescriptor {
  public:
    FileDescriptor() = default;
    explicit FileDescriptor(int number) : number_(number) {}
    FileDescriptor(FileDescriptor&& other) noexcept
        : number_(std::exchange(other.number_, -1)) {}
    FileDescriptor& operator=(FileDescriptor&& other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }
    ~FileDescriptor() {
        if (number_ >= 0) ::close(number_);
    }

    [[nodiscard]] int get() const { return number_; }
    [[nodiscard]] bool valid() const { return number_ >= 0; }
    [[nodiscard]] int release() { return std::exchange(number_, -1); }

  private:
    int number_ = -1;
};

// open(2) with O_CLOEXEC for an absolute path that may be longer than PATH_MAX: the kernel
// refuses those in one piece, so they are opened folder by folder.
[[nodiscard]] FileDescriptor open_path(const std::string& path, int flags);

}  // namespace haarmony::ingest
