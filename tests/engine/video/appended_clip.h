// .mrv files that grow in memory: clips built of their first frames, and the others appended.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/video/growing_file.h"
#include "engine/video/mrv_clip.h"
#include "tests/engine/video/plain_clip.h"

namespace haarmony::video::testing {

// Writes down in which order it is asked, and fails when it is told to.
class GrowingBytes final : public GrowingFile {
  public:
    explicit GrowingBytes(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}

    struct Write {
        std::uint64_t offset = 0;
        std::vector<std::byte> bytes;  // none: a sync
    };
    // The call that fails, writes and syncs counted together from 0.
    void fail_at(int call) { fail_at_ = call; }

    [[nodiscard]] Result<void> write(std::uint64_t offset,
                                     std::span<const std::byte> bytes) override;
    [[nodiscard]] Result<void> sync() override;

    [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_; }
    [[nodiscard]] const std::vector<Write>& writes() const { return writes_; }

  private:
    std::vector<std::byte> bytes_;
    std::vector<Write> writes_;
    int fail_at_ = -1;
};

// Frames [first, end) of a clip.
[[nodiscard]] RawClip part(const RawClip& clip, std::size_t first, std::size_t end);
// The file that a build of all frames makes.
[[nodiscard]] std::vector<std::byte> built_bytes(const RawClip& clip);
// A file of a clip, opened, with plenty of cache. `file` must outlive it.
[[nodiscard]] std::unique_ptr<MrvClip> opened(const std::vector<std::byte>& file);
// Frames behind those that the file has.
[[nodiscard]] Result<void> append_to(GrowingBytes& file, const RawClip& more);
// The file of a clip that had so many frames first, then so many more, and so on: as many
// generations as counts. Requires: the counts are all frames of the clip.
[[nodiscard]] std::vector<std::byte> appended_bytes(
    const RawClip& clip,
    const std::vector<std::size_t>& counts);

}  // namespace haarmony::video::testing
