// A spool of the video engine on the disk.
//
// Small pieces are gathered before they are written. What is not named vanishes with the
// spool, or with the process.
//
// Errors   kIo naming the path.
// Threads  one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/video/spool.h"
#include "server/app/file_descriptor.h"

namespace haarmony::server {

class FileSpool final : public video::Spool {
  public:
    // How the names begin that nameless files have for a moment: one that is there longer was
    // left by a process that died in that moment.
    static constexpr std::string_view kMoment = "spool-";

    // A file without a name in `folder`.
    [[nodiscard]] static Result<FileSpool> nameless(const std::string& folder);
    // A file of that name, emptied where it is there already.
    [[nodiscard]] static Result<FileSpool> named(const std::string& path);

    [[nodiscard]] Result<std::uint64_t> append(std::span<const std::byte> bytes) override;
    [[nodiscard]] Result<void> read(std::uint64_t offset,
                                    std::span<std::byte> bytes) override;
    // What was appended is on the disk.
    [[nodiscard]] Result<void> sync();
    [[nodiscard]] std::uint64_t bytes() const { return written_ + waiting_.size(); }

  private:
    FileSpool(FileDescriptor file, std::string path);
    [[nodiscard]] Result<void> flush();

    FileDescriptor file_;
    std::string path_;
    std::uint64_t written_ = 0;
    std::vector<std::byte> waiting_;
};

}  // namespace haarmony::server
