// A curve through a drawn stroke: any number of samples, the smallest level that will do.
//   least_squares.h -> [fit.h] -> cornered_curve.h, stroke_signature.h
//
// Samples get parameters by their distance along the stroke, the curve is the one nearest to
// them in the mean square, and for a few rounds each sample moves to a parameter nearer to
// it (one step of Newton's method, order kept) as long as the largest error falls.
//
// Shape   samples are rows of 1 to 8 numbers; parameters and errors look at x and y only.
//         Repeated samples, strokes of no length and fewer samples than control points are
//         fine: what they leave open is straight (least_squares.h).
// Errors  none: every stroke has a curve, and its errors are reported.
// Threads const-thread-safe.
// Cost    linear in the samples and the control points, for each round and level tried.
// Source  least squares by chord length (de Boor, ch. XIV); centripetal: Lee 1989;
//         moving parameters: Hoschek 1988.
#pragma once

#include <span>
#include <vector>

#include "engine/curve/level.h"
#include "engine/curve/points.h"

namespace haarmony::curve {

inline constexpr int kMostFitLevel = 12;
inline constexpr int kLeastClosedFitLevel = 2;  // 4 control points

enum class Spacing {
    kChordLength,
    kCentripetal,  // square roots of chord lengths: rounder at sharp turns
};

struct FitOptions {
    Ends ends = Ends::kOpen;
    Spacing spacing = Spacing::kChordLength;
    bool pin_ends =
        false;       // an open curve begins at the first and ends at the last sample
    int rounds = 3;  // of moving parameters, at most
    // One for each sample, in [0, 1] and not falling; empty: by `spacing`.
    std::span<const double> parameters = {};
};

struct CurveFit {
    Points control;
    int level = 0;
    std::vector<double> parameters;  // of the samples
    double max_error =
        0;  // of the samples from the curve at their parameters, in x and y
    double rms_error = 0;
};

// In [0, 1]. Open: from 0 to 1, a stroke of no length evenly. Closed: the chord from the last
// sample to the first counts. Requires: at least 2 samples.
[[nodiscard]] std::vector<double> stroke_parameters(const Points& samples,
                                                    Ends ends,
                                                    Spacing spacing);

// Requires: at least 2 finite samples, 0 <= level <= kMostLevel.
[[nodiscard]] CurveFit fit(const Points& samples, int level, const FitOptions& options);

// The smallest level, from 0 or kLeastClosedFitLevel on, whose max_error is at most the
// tolerance; kMostFitLevel with its larger error if none is. Requires: tolerance >= 0.
[[nodiscard]] CurveFit fit_within(const Points& samples,
                                  double tolerance,
                                  const FitOptions& options);

}  // namespace haarmony::curve
