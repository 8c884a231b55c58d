// What clips take: in the dissertation's accounting, in our memory, in our file, and encoded
// by others.
//   video_clips.h, video_encoder.h -> [video_sizes.h] -> video_report.h
//
// Units   bytes. Targets are multiples of the raw leaf frames (memory) and of FFV1's bytes of
//         the same frames (file), though ours hold every average as well.
// Errors  what building and encoding meet, with the clip's name.
// Source  Table 5.1.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "engine/core/result.h"
#include "engine/video/memory_clip.h"
#include "engine/video/spool.h"
#include "tests/eval/video_clips.h"

namespace haarmony::eval {

struct VideoSizes {
    std::string name;
    VideoKind kind = VideoKind::kNatural;
    std::int32_t width = 0;
    std::int32_t height = 0;
    std::int64_t frames = 0;
    std::uint64_t raw = 0;            // RGBA of the leaf frames
    std::uint64_t paper = 0;          // accounting.h
    std::uint64_t memory = 0;         // MemoryClip
    std::uint64_t file = 0;           // .mrv
    std::uint64_t ffv1 = 0;           // level 3
    std::uint64_t x264_lossless = 0;  // qp 0, RGB
    std::uint64_t x264_intra = 0;     // crf 23, every frame a key frame

    [[nodiscard]] double memory_ratio() const { return ratio(memory, raw); }
    [[nodiscard]] double file_ratio() const { return ratio(file, ffv1); }

  private:
    static double ratio(std::uint64_t part, std::uint64_t whole) {
        return static_cast<double>(part) / static_cast<double>(whole);
    }
};

// At most so much; none where no target is set.
[[nodiscard]] std::optional<double> memory_target(VideoKind kind);
[[nodiscard]] std::optional<double> file_target(VideoKind kind);

// Requires: the clip has frames.
[[nodiscard]] Result<VideoSizes> measure_video_sizes(const VideoClip& clip);

// The clip built at `delta` (in units of difference()), in memory and as a file's bytes.
[[nodiscard]] Result<std::unique_ptr<video::MemoryClip>> built_in_memory(
    const VideoClip& clip,
    std::uint32_t delta);
[[nodiscard]] Result<std::unique_ptr<video::MemorySpool>> built_as_file(
    const VideoClip& clip,
    std::uint64_t& file_bytes);

}  // namespace haarmony::eval
