// A clip written as a .mrv file, or what an append adds to one (engine/video/MRV.md).
//   build.h, append.h -> [mrv_writer.h] -> mrv_clip.h
//
// An append writes behind the clip's end, and last, after all of that has reached the storage,
// a slot of the header: until then, and whenever it fails, the file is the clip that it was.
//
// Errors   what the storage meets; more nodes or bytes than the format can say; kConflict: a
//          clip of kMostGenerations.
// Threads  one caller.
// Source   DESIGN of the project, "File": index first, coarse levels first, residuals to the
//          time parent; sec. 5.5 [compressed without loss].
#pragma once

#include <cstdint>
#include <memory>

#include "engine/video/growing_file.h"
#include "engine/video/layer.h"
#include "engine/video/spool.h"

namespace haarmony::video {

struct MrvFront;

class MrvWriter final : public ClipSink {
  public:
    // Chunks wait in `waiting` until all are known; finish() writes the file to `file`, from
    // offset 0, front to back. Both must outlive the writer.
    MrvWriter(Spool& waiting, Spool& file);
    // A generation behind the clip that `front` (MrvClip::front) is of: takes what append()
    // makes. `file` has that clip.
    MrvWriter(const MrvFront& front, Spool& waiting, GrowingFile& file);
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
