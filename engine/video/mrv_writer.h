// A clip written as a .mrv file (engine/video/MRV.md).
//   build.h -> [mrv_writer.h] -> mrv_clip.h
//
// Errors   what the spools meet; more nodes or bytes than the format can say.
// Threads  one caller.
// Source   DESIGN of the project, "File": index first, coarse levels first, residuals to the
//          time parent; sec. 5.5 [compressed without loss].
#pragma once

#include <cstdint>
#include <memory>

#include "engine/video/layer.h"
#include "engine/video/spool.h"

namespace haarmony::video {

class MrvWriter final : public ClipSink {
  public:
    // Chunks wait in `waiting` until all are known; finish() writes the file to `file`, from
    // offset 0, front to back. Both must outlive the writer.
    MrvWriter(Spool& waiting, Spool& file);
    ~MrvWriter() override;

    [[nodiscard]] Result<void> begin(const ClipShape& shape,
                                     std::uint32_t delta) override;
    [[nodiscard]] Result<void> add(Siblings siblings) override;
    [[nodiscard]] Result<void> finish() override;

    // Requires: finish() was called.
    [[nodiscard]] std::uint64_t file_bytes() const;
    // Of the file's content: equal clips have equal revisions.
    [[nodiscard]] std::uint64_t revision() const;

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace haarmony::video
