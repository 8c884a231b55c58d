// How fast a clip is built and drawn, each beside what others do for the same pictures, in
// turns and on one core.
//   video_sizes.h, video_decoder.h -> [video_speed.h] -> video_report.h
//
// What is measured
//   draw      a frame chosen by lot, from a clip in memory, beside memcpy of the same pixels
//   jump      the same at a quarter of the width, beside libav, which decodes from the last key
//             frame on and scales: of a copy with key frames only, and of one with x264's own
//   blur      the mean of up to 64 frames, beside libav that decodes and scales them all and
//             does not even average
//   root      the whole clip averaged, beside a single frame
//   build     frames in memory to a clip, beside FFV1, which encodes the single frames
//   cold      a frame of a .mrv file of which nothing is kept, beside a decoded key frame
// Units   CPU time of the thread; ratios of the times of one question (paired_times.h).
// Errors  what building, encoding and decoding meet, with the clip's name; kConflict when
//         root, leaf and file do not show the same pixels as the clip in memory.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "tests/eval/paired_times.h"
#include "tests/eval/video_clips.h"

namespace haarmony::eval {

struct VideoSpeedOptions {
    int questions = 41;             // frames drawn by lot
    int rounds = 5;                 // of what takes as long as a build
    std::size_t build_frames = 16;  // of the clip, that builds are timed with
};

// A target of `times` is of pixels a second, one of `ratio` of the paired ratio.
struct VideoSpeed {
    std::string name;  // of the clip
    std::string what;  // video/draw-full, ...
    std::string beside;
    double pixels_a_second = 0;  // ours, of the median time
    RatioSummary ratio;          // their time / ours
    std::optional<double> least_pixels_a_second;
    std::optional<double> least_ratio;

    [[nodiscard]] bool has_target() const {
        return least_pixels_a_second.has_value() || least_ratio.has_value();
    }
    [[nodiscard]] bool met() const {
        return (!least_pixels_a_second || pixels_a_second >= *least_pixels_a_second) &&
               (!least_ratio || ratio.median >= *least_ratio);
    }
};

// Requires: the clip has frames; questions, rounds, build_frames >= 1.
[[nodiscard]] Result<std::vector<VideoSpeed>> measure_video_speed(
    const VideoClip& clip,
    const VideoSpeedOptions& options);

}  // namespace haarmony::eval
