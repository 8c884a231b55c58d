// A slow, smooth function of the plane, worked out on a coarse grid and read between:
// gas and clouds have no detail at the size of a pixel, but cost most where they stand.
//
// Shape   a node every kPitch pixels, one row and column beyond the picture.
// Threads const-safe once made.
#pragma once

#include <cstddef>
#include <vector>

#include "ingest/gallery/coverage.h"
#include "ingest/gallery/elementary.h"

namespace haarmony::gallery {

class Field {
  public:
    static constexpr int kPitch = 3;

    // Calls value(point) once for each node of the rows above `bottom` (picture heights).
    template <typename F>
    Field(const Frame& frame, double bottom, F&& value)
        : columns_(frame.width / kPitch + 2),
          rows_(static_cast<int>(clamp01(bottom) * frame.height) / kPitch + 2) {
        nodes_.reserve(static_cast<std::size_t>(columns_) * rows_);
        for (int j = 0; j < rows_; ++j)
            for (int i = 0; i < columns_; ++i)
                nodes_.push_back(
                    static_cast<float>(value(Point{(i * kPitch + 0.5) / frame.height,
                                                   (j * kPitch + 0.5) / frame.height})));
    }

    // Requires: the pixel lies in the picture, above `bottom`.
    [[nodiscard]] double at(int x, int y) const {
        const int i = x / kPitch;
        const int j = y / kPitch;
        const double u = static_cast<double>(x % kPitch) / kPitch;
        const double v = static_cast<double>(y % kPitch) / kPitch;
        const float* upper = &nodes_[static_cast<std::size_t>(j) * columns_ + i];
        const float* lower = upper + columns_;
        return mix(mix(upper[0], upper[1], u), mix(lower[0], lower[1], u), v);
    }

  private:
    int columns_;
    int rows_;
    std::vector<float> nodes_;
};

}  // namespace haarmony::gallery
