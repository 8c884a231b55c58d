// Multiresolution video measured on a folder of clips, on generated examples and on clip-art:
// sizes, bounds and speed, as text and as tables.
//   video_sizes.h, video_bound.h, video_speed.h -> [video_report.h]
//
// Errors  of the folder and of its clips, by name; a folder without any clip is kNotFound.
// Source  Table 5.1, sec. 5.5.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "tests/eval/figures.h"
#include "tests/eval/video_bound.h"
#include "tests/eval/video_sizes.h"
#include "tests/eval/video_speed.h"

namespace haarmony::eval {

struct VideoOptions {
    std::string clips;         // the folder
    std::int64_t frames = 64;  // of each clip, the first ones
    std::int32_t side = 512;   // of generated clips and of clip-art, in pixels
    std::vector<int> deltas = {2, 4, 8, 16};  // grey levels, of the folder's clips
    VideoSpeedOptions speed;
};

struct VideoReport {
    std::vector<VideoSizes> sizes;
    std::vector<VideoBound> bounds;
    std::vector<VideoSpeed> speed;

    // Lossy clips farther from their source than they promise.
    [[nodiscard]] int broken_bounds() const;
    // One line for each target that is missed, with what was reached.
    [[nodiscard]] std::vector<std::string> misses() const;
};

// `progress` hears one line for each part. Requires: options.frames, deltas >= 1.
[[nodiscard]] Result<VideoReport> measure_video(
    const VideoOptions& options,
    const std::function<void(const std::string&)>& progress);

[[nodiscard]] std::string to_text(const VideoReport& report);
// video_sizes.csv, video_bounds.csv, video_speed.csv
[[nodiscard]] std::vector<OutputFile> video_files(const VideoReport& report);

}  // namespace haarmony::eval
