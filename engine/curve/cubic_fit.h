// One cubic through the ends of a run of Bezier segments, along their tangents, as close to
// the run as its two free tangent lengths allow.
//   chain.h -> [cubic_fit.h] -> merge.h
//
// The first guess is least squares at parameters by chord length; each further step moves
// the parameters to the nearest points (Newton) and then the cubic against the distances
// along its normals (Gauss-Newton), which converges in few steps where alternating least
// squares takes dozens. Nothing is proved here: run_bound.h does that.
//
// Errors   none.
// Threads  const-thread-safe, a Fitter for each thread.
// Source   Schneider, Graphics Gems, 1990; Wang, Pottmann and Liu, "Fitting B-spline curves
//          by squared distance minimization", 2006 [tangent distance].
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/curve/chain.h"
#include "engine/curve/plane_cubic.h"

namespace haarmony::curve {

class CubicFitter {
  public:
    CubicFitter(const Chain& chain, double tolerance)
        : chain_(chain), tolerance2_(tolerance * tolerance) {}

    // None if the samples say that there is none within the tolerance.
    // Requires: first < last <= pieces. Cost: constant.
    [[nodiscard]] std::optional<PlaneCubic> fit(std::size_t first, std::size_t last);

  private:
    // The cubic is {start, start + leave * from, end - arrive * to, end}.
    struct Frame {
        PlaneVector start, from, to, end;
        double length;  // of the run
        double leave, arrive;

        [[nodiscard]] PlaneCubic cubic() const {
            return {start, start + leave * from, end - arrive * to, end};
        }
    };
    void choose_samples(std::size_t first, std::size_t last, double length);
    void by_least_squares(Frame& frame) const;
    // The squared distance of the worst sample before the step.
    double by_tangent_distance(Frame& frame);

    const Chain& chain_;
    double tolerance2_;
    std::vector<PlaneVector> samples_;
    std::vector<double> t_;
};

}  // namespace haarmony::curve
