// A file as libav reads it: one descriptor, nothing else.
//
// Errors  libav's codes, from the system's.
// Threads one caller; the descriptor's own position is not touched.
#pragma once

#include <cstdint>
#include <optional>

#include "engine/video/clip_shape.h"
#include "ingest/libav.h"

namespace haarmony::ingest {

class LibavFile {
  public:
    // Requires: the descriptor stays open while this lives.
    explicit LibavFile(int descriptor);
    LibavFile(const LibavFile&) = delete;
    LibavFile& operator=(const LibavFile&) = delete;

    [[nodiscard]] AVIOContext* io() const { return io_.get(); }
    [[nodiscard]] std::int64_t size() const { return size_; }
    // Bytes at `offset`, without moving; how many there were.
    [[nodiscard]] std::int64_t read_at(std::int64_t offset,
                                       std::uint8_t* to,
                                       std::int64_t count) const;

  private:
    static int read(void* self, std::uint8_t* to, int count);
    static std::int64_t seek(void* self, std::int64_t offset, int whence);

    int descriptor_;
    std::int64_t size_ = 0;
    std::int64_t position_ = 0;
    Libav<AVIOContext> io_;
};

// What the chunks of an animated PNG say: libav rounds its delays to 1/100,000 s.
struct PngAnimation {
    std::int64_t frames = 0;               // announced
    std::optional<video::FrameRate> rate;  // where all frames last equally long
};
// Nothing where it is a still.
[[nodiscard]] std::optional<PngAnimation> png_animation(const LibavFile& png);

}  // namespace haarmony::ingest
