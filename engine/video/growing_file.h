// A file that is written where it already has bytes: a clip that frames are appended to.
//   [growing_file.h] -> mrv_writer.h
//
// Errors   kIo where the storage says no; what was written then is anything between all and
//          nothing.
// Threads  one caller.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/core/result.h"

namespace haarmony::video {

class GrowingFile {
  public:
    virtual ~GrowingFile() = default;
    // Over what is there, or behind its end.
    [[nodiscard]] virtual Result<void> write(std::uint64_t offset,
                                             std::span<const std::byte> bytes) = 0;
    // Returns when all that was written stays, whatever happens to the machine.
    [[nodiscard]] virtual Result<void> sync() = 0;
};

}  // namespace haarmony::video
