// Raw frames as a source, as complete trees made here: shares no code with create_frame.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/video/frame_source.h"
#include "tests/engine/video/plain_clip.h"

namespace haarmony::video::testing {

// A complete tree of a picture.
[[nodiscard]] ImageTree complete_tree(const Picture& picture, const FrameFormat& format);

class RawSource final : public FrameSource {
  public:
    // `clip` must outlive this.
    explicit RawSource(const RawClip& clip) : clip_(clip) {}

    // Frame t of the clip stays for repeats[t] frames.
    void set_repeats(std::vector<std::int64_t> repeats) { repeats_ = std::move(repeats); }
    // next() fails at this call, counted from 0.
    void fail_at(std::size_t call) { fail_at_ = static_cast<std::int64_t>(call); }

    [[nodiscard]] const FrameFormat& format() const override { return clip_.format; }
    [[nodiscard]] Result<bool> next(SourceFrame& frame) override;

  private:
    const RawClip& clip_;
    std::vector<std::int64_t> repeats_;
    std::int64_t fail_at_ = -1;
    std::int64_t calls_ = 0;
};

}  // namespace haarmony::video::testing
