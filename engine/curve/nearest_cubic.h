// The distance from points to the nearest of many cubics.
//   plane_cubic.h -> [nearest_cubic.h] -> hausdorff.h
//
// The cubics are cut into parts that are nearly straight and nearly of one speed, on which
// Newton's steps from the chord find the nearest point; over these, in their order, is a tree
// of bounding boxes: neighbours along a curve are neighbours on the page.
//
// Errors   none.
// Threads  const-thread-safe.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "engine/curve/plane_cubic.h"

namespace haarmony::curve {

// A point of one of the parts, and its squared distance from the point that was asked for.
struct CubicPlace {
    std::size_t part = 0;
    double t = 0;
    double distance2 = std::numeric_limits<double>::infinity();
};

class NearestCubic {
  public:
    // Requires: at least one.
    explicit NearestCubic(std::span<const PlaneCubic> cubics);

    // The nearest of all. Cost: logarithmic in the cubics, where they are spread out.
    [[nodiscard]] CubicPlace find(PlaneVector q) const;
    // The same from `near` on by Newton's steps and over to the neighbours: a point that is
    // no farther than the start, but perhaps not the nearest.
    [[nodiscard]] CubicPlace walk(PlaneVector q, CubicPlace near) const;

  private:
    struct Box {
        PlaneVector low, high;

        [[nodiscard]] double distance2(PlaneVector q) const;
    };
    void add(const PlaneCubic& cubic, int halvings);
    void search(std::size_t node, PlaneVector q, CubicPlace& best) const;
    void search_part(std::size_t part, PlaneVector q, CubicPlace& best) const;
    // Newton's steps from t on; where they end, which becomes `best` if it is nearer.
    double descend(std::size_t part,
                   PlaneVector q,
                   double t,
                   int steps,
                   CubicPlace& best) const;

    std::vector<PlanePolynomial> parts_;
    std::vector<Box> boxes_;  // of node i those of 2i and 2i + 1; the root is 1
    std::size_t leaves_ = 1;  // a power of two; boxes beyond the parts are infinitely far
};

}  // namespace haarmony::curve
