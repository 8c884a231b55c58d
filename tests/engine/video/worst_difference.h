// How far a clip built with a bound is from the exact one, pixel by pixel.
#pragma once

#include <cstdint>

#include "engine/video/time_tree.h"

namespace haarmony::video::testing {

// The largest difference() of any pixel, of both edges.
struct WorstDifference {
    std::uint32_t leaf = 0;    // of single frames at the finest space level
    std::uint32_t coarse = 0;  // of all other pictures

    [[nodiscard]] std::uint32_t anywhere() const { return leaf < coarse ? coarse : leaf; }
};

// Requires: clips of one shape whose frames can be read.
[[nodiscard]] WorstDifference worst_difference(const TimeTree& exact,
                                               const TimeTree& clip);

}  // namespace haarmony::video::testing
