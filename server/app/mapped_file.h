// The bytes of a file, in memory as they are on the disk, for reading.
//
// The file may be renamed, replaced or deleted meanwhile: the bytes stay. A file that somebody
// cuts off in place is not provided for: reading behind its new end ends the process.
//
// Errors  kNotFound where there is none; kIo for the rest; both name the path.
// Threads const-thread-safe.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "engine/core/result.h"

namespace haarmony::server {

class MappedFile {
  public:
    [[nodiscard]] static Result<std::shared_ptr<const MappedFile>> open(
        const std::string& path);
    // The same of an open file, which may be closed afterwards; `path` for messages.
    [[nodiscard]] static Result<std::shared_ptr<const MappedFile>> of(
        int descriptor,
        const std::string& path);
    ~MappedFile();
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;

    // Aligned to a page.
    [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

    // Hints about a part that begins at a page: it is read soon; it is not read again soon.
    static void expect(std::span<const std::byte> part);
    static void forget(std::span<const std::byte> part);

  private:
    explicit MappedFile(std::span<const std::byte> bytes) : bytes_(bytes) {}

    std::span<const std::byte> bytes_;
};

}  // namespace haarmony::server
