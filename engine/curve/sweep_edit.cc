#include "engine/curve/sweep_edit.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <sstream>
#include <string>

#include "engine/curve/bspline_filters.h"

namespace haarmony::curve {
namespace {

constexpr double kStillness = 1e-9;  // of the largest coordinate

Error invalid(std::string message, const char* param) {
    return {ErrorCode::kInvalidArgument, std::move(message), param};
}

void add(Points& sum, const Points& points, double weight) {
    assert(sum.size() == points.size() && sum.dimension() == points.dimension());
    const std::span<double> into = sum.numbers();
    for (std::size_t i = 0; i < into.size(); ++i) into[i] += weight * points.numbers()[i];
}

void add_row(Points& points,
             std::size_t row,
             std::span<const double> delta,
             double weight) {
    for (std::size_t d = 0; d < delta.size(); ++d) points[row][d] += weight * delta[d];
}

// A coarse control point, and how far it moves to move the fine one by 1.
struct Share {
    std::size_t column = 0;
    double weight = 0;
};

// The one coarse point that pulls the fine one most moves it alone; two that pull alike
// share the work.
std::vector<Share> shares(int level, Ends ends, std::size_t index) {
    const Taps taps = refinement_row(level, ends, index);
    const std::size_t columns = control_count(level - 1, ends);
    std::vector<Share> pulls;
    for (int k = 0; k < taps.count; ++k) {
        const std::size_t column = (taps.first + std::size_t(k)) % columns;
        const auto met = std::ranges::find(pulls, column, &Share::column);
        if (met == pulls.end()) {
            pulls.push_back({column, taps.value[k]});
        } else {
            met->weight += taps.value[k];
        }
    }
    const double most = std::ranges::max(pulls, {}, &Share::weight).weight;
    std::erase_if(pulls, [&](const Share& pull) { return pull.weight < most; });
    for (Share& pull : pulls) pull.weight = 1 / (double(pulls.size()) * most);
    return pulls;
}

double stillness(const Points& before, const Points& after) {
    return kStillness * std::max(coordinate_size(before), coordinate_size(after));
}

// The details are added as they are: what changes is P ... P delta C^ceil(l).
Edited apply_fixed(const MultiresCurve& curve, const SweepChange& change) {
    const Points before = reconstruct(curve);
    Edited edited{before, {}, {}};
    add(edited.control, refined(change, curve.ends, curve.level()), 1);
    edited.affected = affected_interval(refined(change, curve.ends),
                                        curve.ends,
                                        change.level.ceil(),
                                        stillness(before, edited.control));
    return edited;
}

// Both curves grow level by level; each detail leaves the frame of the one for the other's.
Edited apply_turning(const MultiresCurve& curve, const SweepChange& change, Frame frame) {
    Points before = reconstruct(curve, change.level.floor);
    Points after = before;
    add(after, change.control, 1);
    for (int j = change.level.floor; j < curve.level(); ++j) {
        Points detail = curve.details[j];
        into_frames(detail, before, curve.ends, frame);
        out_of_frames(detail, after, curve.ends, frame);
        if (j == change.level.floor && !change.detail.empty()) {
            add(detail, change.detail, 1);
        }
        before = synthesize(before, curve.details[j], curve.ends);
        after = synthesize(after, detail, curve.ends);
    }
    const Interval affected =
        affected_by_edit(before, after, curve.ends, change.level.ceil());
    return {std::move(after), affected, {}};
}

// How far control point `index` of C^(j+t) moves because D^j turns with f^j.
void add_turning(std::vector<double>& moved,
                 const MultiresCurve& curve,
                 const SweepChange& change,
                 const ControlEdit& edit) {
    const int level = change.level.floor;
    const Points before = reconstruct(curve, level);
    Points after = before;
    add(after, change.control, 1);
    Points turned = curve.details[level];
    into_frames(turned, before, curve.ends, edit.frame);
    out_of_frames(turned, after, curve.ends, edit.frame);
    add(turned, curve.details[level], -1);
    const Points zero(before.size(), before.dimension());
    const Points shift = synthesize(zero, turned, curve.ends);
    for (std::size_t d = 0; d < moved.size(); ++d) {
        moved[d] += change.level.fraction * shift[edit.index][d];
    }
}

}  // namespace

RealLevel::RealLevel(double level)
    : floor(int(std::floor(level))), fraction(level - std::floor(level)) {
    assert(level >= 0 && level <= kMostLevel);
}

SweepChange sweep_change(RealLevel level,
                         Ends ends,
                         const Points& broad,
                         const Points& narrow) {
    SweepChange change{level, broad, {}};
    const double t = level.fraction;
    if (t == 0) return change;
    const double g = t * t;
    AnalysisStep parts = analyze(narrow, ends);
    for (double& number : change.control.numbers()) number *= 1 - g;
    add(change.control, parts.coarse, g);
    change.detail = std::move(parts.detail);
    for (double& number : change.detail.numbers()) number *= g / t;
    return change;
}

Points refined(const SweepChange& change, Ends ends) {
    if (change.level.fraction == 0) return change.control;
    return synthesize(change.control, change.detail, ends);
}

Points refined(const SweepChange& change, Ends ends, int level) {
    Points points = refined(change, ends);
    for (int j = change.level.ceil(); j < level; ++j) {
        points = synthesize(points, {}, ends);
    }
    return points;
}

Interval affected_by_edit(const Points& before,
                          const Points& after,
                          Ends ends,
                          int knot_level) {
    Points change = after;
    add(change, before, -1);
    return affected_interval(change, ends, knot_level, stillness(before, after));
}

Edited apply(const MultiresCurve& curve, const SweepChange& change, Frame frame) {
    assert(change.level.ceil() <= curve.level());
    return frame == Frame::kFixed ? apply_fixed(curve, change)
                                  : apply_turning(curve, change, frame);
}

SweepChange control_change(RealLevel level,
                           Ends ends,
                           std::size_t index,
                           std::span<const double> delta) {
    const int dimension = int(delta.size());
    Points broad(control_count(level.floor, ends), dimension);
    if (level.fraction == 0) {
        add_row(broad, index, delta, 1);
        return sweep_change(level, ends, broad, {});
    }
    Points narrow(control_count(level.ceil(), ends), dimension);
    add_row(narrow, index, delta, 1);
    for (const Share& share : shares(level.ceil(), ends, index)) {
        add_row(broad, share.column, delta, share.weight);
    }
    return sweep_change(level, ends, broad, narrow);
}

Result<void> check_edit(const MultiresCurve& curve,
                        double level,
                        std::span<const double> delta) {
    if (!(level >= 0 && level <= curve.level())) {
        return invalid("level " + std::to_string(level) + " is outside 0.." +
                           std::to_string(curve.level()),
                       "level");
    }
    const int dimension = curve.coarse.dimension();
    if (delta.size() != std::size_t(dimension)) {
        return invalid("delta of " + std::to_string(delta.size()) +
                           " numbers for a curve of " + std::to_string(dimension),
                       "delta");
    }
    for (const double number : delta) {
        if (!std::isfinite(number)) {
            return invalid("delta " + std::to_string(number) + " is not finite", "delta");
        }
    }
    return {};
}

Result<Edited> checked_edit(Edited edited, std::span<const double> delta) {
    if (all_finite(edited.control)) return edited;
    const double most = std::ranges::max(delta, {}, [](double d) { return std::abs(d); });
    std::ostringstream message;
    message << "delta " << most << " takes the curve beyond the largest number";
    return invalid(message.str(), "delta");
}

Result<Edited> edit_sweep(const MultiresCurve& curve, const ControlEdit& edit) {
    if (auto checked = check_edit(curve, edit.level, edit.delta); !checked) {
        return std::move(checked).error();
    }
    const RealLevel level(edit.level);
    const std::size_t points = control_count(level.ceil(), curve.ends);
    if (edit.index >= points) {
        return invalid("index " + std::to_string(edit.index) + " of " +
                           std::to_string(points) + " control points",
                       "index");
    }
    const SweepChange change = control_change(level, curve.ends, edit.index, edit.delta);
    Edited edited = apply(curve, change, edit.frame);
    edited.moved.assign(edit.delta.begin(), edit.delta.end());
    if (level.fraction > 0) add_turning(edited.moved, curve, change, edit);
    return checked_edit(std::move(edited), edit.delta);
}

}  // namespace haarmony::curve
