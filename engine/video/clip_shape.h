// How large a clip is, and the addresses of its pictures.
//
// Address  time level k = 0 (the whole clip averaged) .. time_levels (single frames), index i
//          at that level, space level l = 0 .. space_levels: a root square of 2^l x 2^l.
//          Node (k, i) covers the frames [i 2^(T-k), min((i+1) 2^(T-k), n)); a node that
//          covers none does not exist.
// Units    pixels of the finest level, frames, frames per second as a fraction.
// Errors   make() names the value outside its limits; anything else is a caller's bug.
// Source   sec. 5.2.1; ERRATA of the project, video 16, 17.
#pragma once

#include <cstdint>

#include "engine/core/result.h"

namespace haarmony::video {

struct FrameRate {
    std::int32_t numerator = 25;
    std::int32_t denominator = 1;

    [[nodiscard]] double per_second() const {
        return static_cast<double>(numerator) / denominator;
    }
    friend bool operator==(const FrameRate&, const FrameRate&) = default;
};

// The picture's size and the pace, known before the frames are counted.
struct FrameFormat {
    std::int32_t width = 0;
    std::int32_t height = 0;
    FrameRate rate;

    friend bool operator==(const FrameFormat&, const FrameFormat&) = default;
};

struct NodeAddress {
    int time_level = 0;
    std::int64_t index = 0;

    friend bool operator==(const NodeAddress&, const NodeAddress&) = default;
};

struct FrameRange {
    std::int64_t first = 0;
    std::int64_t end = 0;  // exclusive

    [[nodiscard]] std::int64_t count() const { return end - first; }
    friend bool operator==(const FrameRange&, const FrameRange&) = default;
};

inline constexpr std::int32_t kMaxSide = 1 << 16;
inline constexpr int kMaxTimeLevels = 30;
// 2 space_levels + time_levels: how many samples one mean may have, as a power of two.
inline constexpr int kMaxSampleBits = 47;

class ClipShape {
  public:
    // Limits: 1 <= width, height <= kMaxSide; a positive rate; frames >= 1, and no more than
    // kMaxTimeLevels and kMaxSampleBits allow. The error's param is width, height, rate or
    // frames.
    [[nodiscard]] static Result<ClipShape> make(const FrameFormat& format,
                                                std::int64_t frames);

    [[nodiscard]] const FrameFormat& format() const { return format_; }
    [[nodiscard]] std::int32_t width() const { return format_.width; }
    [[nodiscard]] std::int32_t height() const { return format_.height; }
    [[nodiscard]] const FrameRate& rate() const { return format_.rate; }
    [[nodiscard]] std::int64_t frames() const { return frames_; }
    [[nodiscard]] int time_levels() const { return time_levels_; }    // T
    [[nodiscard]] int space_levels() const { return space_levels_; }  // L

    // How many nodes time level k has. Requires: 0 <= k <= T.
    [[nodiscard]] std::int64_t nodes_at(int time_level) const;
    [[nodiscard]] std::int64_t time_nodes() const;  // of all levels
    [[nodiscard]] bool contains(const NodeAddress& at) const;
    // Requires: contains(at).
    [[nodiscard]] FrameRange frames_of(const NodeAddress& at) const;

    // The cropped picture's size at a space level: ceil(W / 2^(L-l)). Requires: 0 <= l <= L.
    [[nodiscard]] std::int32_t width_at(int space_level) const;
    [[nodiscard]] std::int32_t height_at(int space_level) const;

    friend bool operator==(const ClipShape&, const ClipShape&) = default;

  private:
    ClipShape(const FrameFormat& format, std::int64_t frames);

    FrameFormat format_;
    std::int64_t frames_ = 0;
    int time_levels_ = 0;
    int space_levels_ = 0;
};

}  // namespace haarmony::video
