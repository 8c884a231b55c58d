// An approximation as GeoJSON text: a feature of straight lines, for maps and tools that know
// no curves.
//   approximate.h -> [geojson.h]
//
// Shape    a LineString, or a MultiLineString where segments do not meet; of a closed curve
//          the last position is the first. What was asked for and what is promised are the
//          feature's properties.
// Units    the curve's own; x and y alone.
// Errors   kTooLarge: more than kMostPositions would be needed.
// Threads  const-thread-safe.
// Source   RFC 7946, sec. 3.
#pragma once

#include <cstddef>
#include <string>

#include "engine/core/result.h"
#include "engine/curve/approximate.h"

namespace haarmony::curve {

inline constexpr std::size_t kMostPositions = 1'000'000;
// Of a tolerance for the lines together: approximate() with the rest of it.
inline constexpr double kFlatnessShare = 0.25;

// The lines are within `flatness` of the segments, which is therefore added to the properties
// "tolerance", "bound" and "max_error".
// Requires: flatness > 0.
[[nodiscard]] Result<std::string> geojson(const Approximation& approximation,
                                          double flatness);

}  // namespace haarmony::curve
