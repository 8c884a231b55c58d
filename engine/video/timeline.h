// Where along a clip there is detail in time and in space: a graph beside its slider.
//   time_tree.h -> [timeline.h]
//
// Only nodes are looked at, no pixels: content that a time node shares with its time-parent
// is no detail in time, and a square without children has no detail in space.
//
// Shape   bucket b of B has the frames [b n / B, (b + 1) n / B).
// Units   shares of the picture's area, 0 .. 1; space levels.
// Errors  what the clip's storage meets; kInvalidArgument (buckets).
// Cost    proportional to the nodes of the stored time nodes up to the space level asked for;
//         what is shared with the time-parent is skipped.
// Source  sec. 5.6, "User-interface paradigms" ["a timeline showing a graph"].
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/result.h"
#include "engine/video/time_tree.h"

namespace haarmony::video {

struct TimelineBucket {
    FrameRange frames;
    // [k - 1], k = 1 .. time_levels: the share of the picture that differs at time level k
    // from the time-parent, on the average of the bucket's frames.
    std::vector<double> changed;
    // The finest space level that any frame of the bucket has squares of (a flat one has
    // those of kBrickLevel); one more than that asked for where there is more still.
    int deepest_level = 0;
    double squares = 0;  // bricks that show a frame, on the average

    // Detail in time: the sum over all time levels.
    [[nodiscard]] double temporal() const {
        double sum = 0;
        for (const double share : changed) sum += share;
        return sum;
    }
};

struct Timeline {
    std::vector<TimelineBucket> buckets;
    std::int64_t nodes_visited = 0;
};

// `space_level` is the finest whose nodes are looked at: what differs there counts in full.
// Requires: min(kBrickLevel, space_levels) <= space_level <= space_levels.
// Errors: kInvalidArgument (buckets) where they are not 1 .. frames.
[[nodiscard]] Result<Timeline> timeline(const TimeTree& clip,
                                        std::int64_t buckets,
                                        int space_level);

}  // namespace haarmony::video
