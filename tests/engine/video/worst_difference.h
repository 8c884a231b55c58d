// How far a clip built with a bound is from the exact one, pixel by pixel.
#pragma once

#include <cstdint>

#include "engine/video/time_tree.h"

namespace haarmony::video::testing {

// The largest difference() of any pixel of any time node at any space level, of both edges.
// Requires: clips of one shape whose frames can be read.
[[nodiscard]] std::uint32_t worst_difference(const TimeTree& exact, const TimeTree& clip);

}  // namespace haarmony::video::testing
