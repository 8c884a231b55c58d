// A curve with corners: pieces between them, each a curve of its own level, with shared ends.
//   fit.h, corners.h, sweep_edit.h -> [cornered_curve.h]
//
// Whatever is done is done to the pieces, so that a corner stays a corner; where an end of
// a piece moves, the end that it shares with its neighbour moves along.
//
// Shape    u of the whole is in [0, 1]; piece i of an open curve is [u_i, u_i+1], u_0 = 0, of
//          a closed curve from corner i to the next one, around past 1. Without corners there
//          is one piece, closed if the curve is. Shared ends are equal numbers.
// Errors   a corner that is not where corners may be, or nothing between two of them:
//          kInvalidArgument, param "corners".
// Threads  const-thread-safe.
// Cost     linear in samples and control points.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/curve/fit.h"
#include "engine/curve/level.h"
#include "engine/curve/points.h"
#include "engine/curve/sweep_edit.h"

namespace haarmony::curve {

struct CorneredCurve {
    Ends ends = Ends::kOpen;      // of the whole
    std::vector<double> corners;  // ascending u: in (0, 1), of a closed curve in [0, 1)
    std::vector<Points> pieces;   // control points

    // Of the pieces.
    [[nodiscard]] Ends piece_ends() const {
        return ends == Ends::kClosed && corners.empty() ? Ends::kClosed : Ends::kOpen;
    }
};

// Where u of the whole is: the piece and its own parameter. At a corner it is the start of
// the piece behind it. Requires: 0 <= u <= 1.
struct PieceParameter {
    std::size_t piece = 0;
    double u = 0;
};
[[nodiscard]] PieceParameter piece_at(const CorneredCurve& curve, double u);
[[nodiscard]] std::vector<double> point_at(const CorneredCurve& curve, double u);

// The u of the whole that a piece covers; `to` is above 1 where it passes the start of a
// closed curve.
struct PieceRange {
    double from = 0;
    double to = 1;
};
[[nodiscard]] PieceRange range_of(const CorneredCurve& curve, std::size_t piece);

struct CorneredFit {
    CorneredCurve curve;
    double max_error = 0;  // as in CurveFit, of all samples
    double rms_error = 0;
};

// Of all pieces: this level, or else the smallest one within the tolerance.
struct PieceGoal {
    std::optional<int> level;
    double tolerance = 0;
};

// The samples at which declared corners are: those with the nearest parameters, ascending. Of
// a closed stroke a corner near 1 may be at the first sample.
[[nodiscard]] Result<std::vector<std::size_t>> samples_at_corners(
    std::span<const double> parameters,
    Ends ends,
    std::span<const double> corners);

// A stroke with corners at these samples, ascending, the first and last of an open stroke
// not among them. The pieces go exactly through them. Requires: as fit(); pin_ends and
// `parameters` of the options are not looked at.
[[nodiscard]] CorneredFit fit_cornered(const Points& samples,
                                       std::span<const std::size_t> corners,
                                       const PieceGoal& goal,
                                       const FitOptions& options);

// A curve split at these u into pieces that follow it within the tolerance, at its own
// parameters. A piece of 2^k segments from knot to knot is exact.
[[nodiscard]] Result<CorneredFit> split_at_corners(const Points& control,
                                                   Ends ends,
                                                   std::span<const double> corners,
                                                   double tolerance);

// f^level of each piece, or the piece itself where it has no such level, with the ends where
// they were: the end control points of C^level are set back. Requires: level >= 0.
[[nodiscard]] CorneredCurve smooth(const CorneredCurve& curve, double level);

// A piece after any operation on it alone; where it moved a shared end, the neighbour is
// edited to follow at level `level` or its own, if that is less.
// Requires: control points of a level, of as many dimensions.
void replace_piece(CorneredCurve& curve, std::size_t piece, Points control, int level);

// edit_sweep() of one piece, and replace_piece() with its result.
[[nodiscard]] Result<CorneredCurve> edit_piece(const CorneredCurve& curve,
                                               std::size_t piece,
                                               const ControlEdit& edit);

// All pieces as Bezier segments, 3 n + 1 rows, with u at the n + 1 ends of the segments.
// Those of a closed curve begin at its first corner and end a turn later.
struct ConcatenatedBeziers {
    Points points;
    std::vector<double> parameters;
};
[[nodiscard]] ConcatenatedBeziers concatenate(const CorneredCurve& curve);

// The curve as one without corners, which are rounded off within the tolerance, if a level
// is that fine; its errors are those of samples of the pieces.
[[nodiscard]] CurveFit without_corners(const CorneredCurve& curve, double tolerance);

}  // namespace haarmony::curve
