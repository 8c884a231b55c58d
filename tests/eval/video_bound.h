// How far a lossy clip is from its source, where it is farthest.
//   video_clips.h -> [video_bound.h] -> video_report.h
//
// Units   D* (difference()) in grey levels.
// Errors  what building meets, with the clip's name.
// Cost    every pixel of every time node at every space level, drawn twice.
// Source  sec. 5.3.1, Figure 5.7; ERRATA of the project, video 12, 13.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/video/time_tree.h"
#include "tests/eval/video_clips.h"

namespace haarmony::eval {

struct VideoBound {
    std::string name;
    int delta = 0;            // grey levels
    double worst_leaf = 0;    // of single frames, at every space level
    double worst_coarse = 0;  // of averages over time, at every space level
    double memory_ratio = 0;  // to the raw leaf frames

    [[nodiscard]] bool held() const {
        return worst_leaf <= delta && worst_coarse <= delta;
    }
};

// The largest D* between what two clips of one shape show, over the time nodes of levels
// [first, end), all space levels, and both edge rules. In units of difference().
[[nodiscard]] Result<std::uint32_t> largest_difference(const video::TimeTree& a,
                                                       const video::TimeTree& b,
                                                       int first_time_level,
                                                       int end_time_level);

// One for each delta, against the clip built at delta 0. Single frames of that at the finest
// level are compared with the source itself: kConflict if a byte differs.
// Requires: the clip has frames; deltas >= 1.
[[nodiscard]] Result<std::vector<VideoBound>> measure_video_bounds(
    const VideoClip& clip,
    std::span<const int> deltas);

}  // namespace haarmony::eval
