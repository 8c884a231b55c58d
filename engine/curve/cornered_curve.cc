#include "engine/curve/cornered_curve.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "engine/curve/bspline.h"
#include "engine/curve/multires_curve.h"

namespace haarmony::curve {
namespace {

// Samples of a segment, when a curve is fitted anew: as many as a segment has numbers to
// tell, twice over.
constexpr std::size_t kSamplesPerSegment = 8;

constexpr double kStillness = 1e-12;  // of the largest coordinate

int level_of_piece(const Points& control, Ends ends) {
    const std::optional<int> level = level_of(control.size(), ends);
    assert(level);
    return *level;
}

// The end of a piece moves by `delta`, and what is near along with it, as an edit of the end
// control point of level `level`: only the first or last column of P^j is not 0 there.
void move_end(Points& control, bool last, std::span<const double> delta, int level) {
    const int own = level_of_piece(control, Ends::kOpen);
    const int edited = std::min(level, own);
    Points change(control_count(edited, Ends::kOpen), control.dimension());
    std::ranges::copy(delta, change[last ? change.size() - 1 : 0].begin());
    for (int j = edited; j < own; ++j) change = synthesize(change, {}, Ends::kOpen);
    for (std::size_t i = 0; i < control.numbers().size(); ++i)
        control.numbers()[i] += change.numbers()[i];
}

// Sets an end back that moved by no more than rounding.
void settle_end(Points& control, bool last, const Points& before) {
    double size = 0;
    for (const double number : before.numbers()) size = std::max(size, std::fabs(number));
    const std::span<double> is = control[last ? control.size() - 1 : 0];
    const std::span<const double> was = before[last ? before.size() - 1 : 0];
    for (std::size_t axis = 0; axis < is.size(); ++axis) {
        if (std::fabs(is[axis] - was[axis]) > kStillness * size) return;
    }
    std::ranges::copy(was, is.begin());
}

// Makes an end of `control` equal to `target`.
void pull_end(Points& control, bool last, std::span<const double> target, int level) {
    const std::size_t end = last ? control.size() - 1 : 0;
    if (std::ranges::equal(control[end], target)) return;
    std::vector<double> delta(target.begin(), target.end());
    for (std::size_t axis = 0; axis < delta.size(); ++axis)
        delta[axis] -= control[end][axis];
    move_end(control, last, delta, level);
    std::ranges::copy(target, control[end].begin());  // exactly, not to rounding
}

}  // namespace

PieceRange range_of(const CorneredCurve& curve, std::size_t piece) {
    assert(piece < curve.pieces.size());
    const std::vector<double>& at = curve.corners;
    if (at.empty()) return {};
    if (curve.ends == Ends::kOpen)
        return {piece == 0 ? 0 : at[piece - 1], piece == at.size() ? 1 : at[piece]};
    return {at[piece], piece + 1 < at.size() ? at[piece + 1] : at[0] + 1};
}

PieceParameter piece_at(const CorneredCurve& curve, double u) {
    assert(u >= 0 && u <= 1);
    if (curve.corners.empty()) return {0, u};
    const std::size_t behind =
        std::size_t(std::upper_bound(curve.corners.begin(), curve.corners.end(), u) -
                    curve.corners.begin());
    std::size_t piece = behind;
    if (curve.ends == Ends::kClosed) {
        const std::size_t count = curve.corners.size();
        piece = (behind + count - 1) % count;
        if (behind == 0) u += 1;
    }
    const PieceRange range = range_of(curve, piece);
    return {piece, std::clamp((u - range.from) / (range.to - range.from), 0.0, 1.0)};
}

std::vector<double> point_at(const CorneredCurve& curve, double u) {
    const PieceParameter at = piece_at(curve, u);
    return point_at(curve.pieces[at.piece], curve.piece_ends(), at.u);
}

CorneredCurve smooth(const CorneredCurve& curve, double level) {
    assert(level >= 0);
    const Ends ends = curve.piece_ends();
    CorneredCurve result = curve;
    for (Points& piece : result.pieces) {
        if (level >= level_of_piece(piece, ends)) continue;
        const RealLevel real(level);
        const MultiresCurve multires = decompose(piece, ends);
        Points control = reconstruct(multires, real.floor);
        if (real.fraction > 0) {
            const Points fine = reconstruct(multires, real.ceil());
            control = synthesize(control, {}, ends);
            for (std::size_t i = 0; i < control.numbers().size(); ++i) {
                double& number = control.numbers()[i];
                number += real.fraction * (fine.numbers()[i] - number);
            }
        }
        if (ends == Ends::kOpen) {
            std::ranges::copy(piece[0], control[0].begin());
            std::ranges::copy(piece[piece.size() - 1],
                              control[control.size() - 1].begin());
        }
        piece = std::move(control);
    }
    return result;
}

void replace_piece(CorneredCurve& curve, std::size_t piece, Points control, int level) {
    assert(piece < curve.pieces.size());
    assert(control.dimension() == curve.pieces[piece].dimension());
    curve.pieces[piece] = std::move(control);
    if (curve.corners.empty()) return;
    const std::size_t count = curve.pieces.size();
    const bool around = curve.ends == Ends::kClosed;
    // Copies: with one corner a closed curve's piece is its own neighbour.
    const auto end_of = [&](bool last) {
        const Points& edited = curve.pieces[piece];
        const std::span<const double> row = edited[last ? edited.size() - 1 : 0];
        return std::vector<double>(row.begin(), row.end());
    };
    if (piece > 0 || around)
        pull_end(curve.pieces[(piece + count - 1) % count], true, end_of(false), level);
    if (piece + 1 < count || around)
        pull_end(curve.pieces[(piece + 1) % count], false, end_of(true), level);
}

Result<CorneredCurve> edit_piece(const CorneredCurve& curve,
                                 std::size_t piece,
                                 const ControlEdit& edit) {
    assert(piece < curve.pieces.size());
    const Ends ends = curve.piece_ends();
    Result<Edited> edited = edit_sweep(decompose(curve.pieces[piece], ends), edit);
    if (!edited) return edited.error();
    CorneredCurve result = curve;
    const int level = RealLevel(edit.level).ceil();
    const Points& before = curve.pieces[piece];
    Points& after = edited->control;
    const std::size_t last = after.size() - 1;
    if (ends == Ends::kOpen) {
        settle_end(after, false, before);
        settle_end(after, true, before);
    }
    // The one piece of a closed curve with one corner: whichever end was moved wins.
    if (curve.pieces.size() == 1 && !curve.corners.empty() &&
        !std::ranges::equal(after[last], before[last]))
        pull_end(after,
                 false,
                 std::vector<double>(after[last].begin(), after[last].end()),
                 level);
    replace_piece(result, piece, std::move(after), level);
    return result;
}

ConcatenatedBeziers concatenate(const CorneredCurve& curve) {
    const Ends ends = curve.piece_ends();
    std::size_t segments = 0;
    for (const Points& piece : curve.pieces)
        segments += segment_count(level_of_piece(piece, ends));
    ConcatenatedBeziers result{Points(3 * segments + 1, curve.pieces[0].dimension()), {}};
    std::size_t row = 0;
    for (std::size_t i = 0; i < curve.pieces.size(); ++i) {
        const Points part = bezier_points(curve.pieces[i], ends);
        const PieceRange range = range_of(curve, i);
        const std::size_t own = part.size() / 3;
        for (std::size_t k = 0; k < part.size(); ++k)
            std::ranges::copy(part[k], result.points[row + k].begin());
        for (std::size_t k = 0; k < own; ++k) {
            result.parameters.push_back(range.from + (range.to - range.from) * double(k) /
                                                         double(own));
        }
        row += 3 * own;
        if (i + 1 == curve.pieces.size()) result.parameters.push_back(range.to);
    }
    return result;
}

CurveFit without_corners(const CorneredCurve& curve, double tolerance) {
    std::vector<double> parameters;
    for (std::size_t i = 0; i < curve.pieces.size(); ++i) {
        const PieceRange range = range_of(curve, i);
        const std::size_t steps =
            kSamplesPerSegment *
            segment_count(level_of_piece(curve.pieces[i], curve.piece_ends()));
        for (std::size_t k = 0; k < steps; ++k) {
            const double u =
                range.from + (range.to - range.from) * double(k) / double(steps);
            parameters.push_back(u >= 1 ? u - 1 : u);
        }
    }
    if (curve.ends == Ends::kOpen) parameters.push_back(1);
    std::ranges::sort(parameters);
    Points samples(parameters.size(), curve.pieces[0].dimension());
    for (std::size_t i = 0; i < parameters.size(); ++i)
        std::ranges::copy(point_at(curve, parameters[i]), samples[i].begin());
    FitOptions options;
    options.ends = curve.ends;
    options.rounds = 0;
    options.parameters = parameters;
    return fit_within(samples, tolerance, options);
}

}  // namespace haarmony::curve
