// A chain of Bezier segments, made ready to be merged into fewer ones.
//   bspline.h -> [chain.h] -> cubic_fit.h, run_bound.h, merge.h
//
// Shape    piece k goes from joint k to joint k + 1. kSamplesPerPiece samples lie on a piece,
//          its start among them; one more is the end of the last piece. Closed: the last
//          joint is the first one.
// Errors   none; a wrong shape is a caller's bug and asserts.
// Threads  const-thread-safe.
// Source   sec. 3.5.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/curve/plane_cubic.h"
#include "engine/curve/points.h"

namespace haarmony::curve {

inline constexpr std::size_t kSamplesPerPiece = 4;

struct Chain {
    std::vector<PlaneCubic> pieces;
    std::vector<PlaneVector> samples;
    std::vector<double> lengths;       // from the first sample to each, along the samples
    std::vector<PlaneVector> leaving;  // unit tangent of each piece at its start
    std::vector<PlaneVector> arriving;  // and at its end
    double size = 0;  // largest coordinate: what rounding errors are relative to

    [[nodiscard]] double length(std::size_t from_sample, std::size_t to_sample) const {
        return lengths[to_sample] - lengths[from_sample];
    }
};

// `bezier` has 3k + 1 rows; neighbours share their ends.
[[nodiscard]] Chain make_chain(const Points& bezier);

}  // namespace haarmony::curve
