// One build of a clip from raw frames, its parts timed.
//
// Units   seconds of the thread's processor time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/video/accounting.h"
#include "engine/video/clip_shape.h"
#include "engine/video/memory_clip.h"
#include "engine/video/spool.h"

namespace haarmony::video::bench {

[[nodiscard]] double thread_seconds();

// A spool whose memory has been there since the last build: a page fault for each first byte
// would cost more than all that is measured.
class WarmSpool final : public Spool {
  public:
    void clear() { used_ = 0; }
    [[nodiscard]] std::uint64_t used() const { return used_; }
    [[nodiscard]] Result<std::uint64_t> append(std::span<const std::byte> bytes) override;
    [[nodiscard]] Result<void> read(std::uint64_t offset,
                                    std::span<std::byte> bytes) override;

  private:
    std::vector<std::byte> bytes_;
    std::size_t used_ = 0;
};

struct MeasuredBuild {
    double pass_1 = 0;  // without the source
    double pass_2 = 0;  // with the sink, a clip in memory
    double accounting = 0;
    std::unique_ptr<MemoryClip> clip;
    StorageCounts counts;
};

// `frames`: straight RGBA, one after the other. Ends the program where a build fails.
[[nodiscard]] MeasuredBuild measured_build(const FrameFormat& format,
                                           std::span<const std::uint8_t> frames,
                                           std::uint32_t delta,
                                           WarmSpool& spool);

}  // namespace haarmony::video::bench
