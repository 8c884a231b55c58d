// A copy of a file, made to be written to: what is published is never changed.
//
//   video_build -> [grown_file] -> engine/video/growing_file.h
//
// Where the file system can, the copy shares its blocks with the original, and costs nothing
// until it is written.
//
// Errors   kNotFound where there is no original; kIo for the rest; both name the path.
// Threads  one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "engine/core/result.h"
#include "engine/video/growing_file.h"
#include "server/app/file_descriptor.h"

namespace haarmony::server {

class GrownFile final : public video::GrowingFile {
  public:
    // `path` is emptied where it is there already.
    [[nodiscard]] static Result<GrownFile> copy_of(const std::string& original,
                                                   const std::string& path);

    [[nodiscard]] Result<void> write(std::uint64_t offset,
                                     std::span<const std::byte> bytes) override;
    [[nodiscard]] Result<void> sync() override;

  private:
    GrownFile(FileDescriptor file, std::string path)
        : file_(std::move(file)), path_(std::move(path)) {}

    FileDescriptor file_;
    std::string path_;
};

}  // namespace haarmony::server
