#include "engine/curve/frame.h"

#include <cassert>
#include <cmath>
#include <utility>

#include "engine/curve/bspline.h"
#include "engine/curve/wavelet_peak.h"

namespace haarmony::curve {
namespace {

constexpr double kShortestTangent = 1e-12;

// T; N is (-y, x).
struct Axes {
    double x = 1;
    double y = 0;
};

// Of the tangent (x, y).
Axes axes_of(double x, double y, Frame frame) {
    const double length = std::sqrt(x * x + y * y);
    if (length < kShortestTangent) return {};
    if (frame == Frame::kUnnormalized) return {x, y};
    return {x / length, y / length};
}

Axes axes_at(const Points& control,
             Ends ends,
             int level,
             std::size_t wavelet,
             Frame frame) {
    const BasisAt basis = basis_at(level, ends, wavelet_peak(level, ends, wavelet));
    double x = 0;
    double y = 0;
    for (std::size_t i = 0; i < basis.slope.size(); ++i) {
        const auto point = control[(basis.first + i) % control.size()];
        x += basis.slope[i] * point[0];
        y += basis.slope[i] * point[1];
    }
    return axes_of(x, y, frame);
}

// Wavelets that feel no end, first to one past the last: they peak in the middle of their
// segment, whose first control point is `before` rows before the detail's.
struct Middle {
    std::size_t first = 0;
    std::size_t last = 0;
    std::size_t before = 0;
};
Middle middle_of(int level, Ends ends) {
    const std::size_t rows = segment_count(level);
    if (ends == Ends::kOpen) return rows < 8 ? Middle{} : Middle{3, rows - 3, 0};
    return rows < 4 ? Middle{} : Middle{1, rows - 2, 1};
}

// There the derivatives of the four basis functions are -1/8, -5/8, 5/8, 1/8 a segment.
Axes axes_in_the_middle(const Points& control,
                        int level,
                        std::size_t first,
                        Frame frame) {
    const double* const row = control[first].data();
    const int n = control.dimension();
    const double scale = std::ldexp(0.125, level);
    const auto slope = [&](int d) {
        return scale * (row[3 * n + d] - row[d] + 5 * (row[2 * n + d] - row[n + d]));
    };
    return axes_of(slope(0), slope(1), frame);
}

// Calls turn(row of x and y.., axes) for each row of a detail that has a frame of its own.
template <typename Turn>
void for_each_frame(Points& detail,
                    const Points& control,
                    Ends ends,
                    Frame frame,
                    Turn turn) {
    if (frame == Frame::kFixed || detail.dimension() < 2) return;
    const auto level = level_of(control.size(), ends);
    assert(level && detail.size() == segment_count(*level));
    const Middle middle = middle_of(*level, ends);
    for (std::size_t row = 0; row < detail.size(); ++row) {
        const bool in_the_middle = row >= middle.first && row < middle.last;
        turn(detail[row],
             in_the_middle
                 ? axes_in_the_middle(control, *level, row - middle.before, frame)
                 : axes_at(control, ends, *level, row, frame));
    }
}

}  // namespace

void into_frames(Points& detail, const Points& control, Ends ends, Frame frame) {
    for_each_frame(
        detail, control, ends, frame, [](std::span<double> row, const Axes& axes) {
            const double square = axes.x * axes.x + axes.y * axes.y;
            const double along = (row[0] * axes.x + row[1] * axes.y) / square;
            const double across = (row[1] * axes.x - row[0] * axes.y) / square;
            row[0] = along;
            row[1] = across;
        });
}

void out_of_frames(Points& detail, const Points& control, Ends ends, Frame frame) {
    for_each_frame(
        detail, control, ends, frame, [](std::span<double> row, const Axes& axes) {
            const double x = row[0] * axes.x - row[1] * axes.y;
            const double y = row[0] * axes.y + row[1] * axes.x;
            row[0] = x;
            row[1] = y;
        });
}

LocalDetails to_local(const MultiresCurve& curve, Frame frame) {
    LocalDetails local{curve.ends, frame, curve.coarse, curve.details};
    if (frame == Frame::kFixed) return local;
    Points control = curve.coarse;
    for (int level = 0; level < curve.level(); ++level) {
        into_frames(local.details[level], control, curve.ends, frame);
        if (level + 1 < curve.level()) {
            control = synthesize(control, curve.details[level], curve.ends);
        }
    }
    return local;
}

MultiresCurve to_world(const LocalDetails& curve) {
    MultiresCurve world{curve.ends, curve.coarse, curve.details};
    if (curve.frame == Frame::kFixed) return world;
    Points control = curve.coarse;
    for (int level = 0; level < curve.level(); ++level) {
        out_of_frames(world.details[level], control, curve.ends, curve.frame);
        if (level + 1 < curve.level()) {
            control = synthesize(control, world.details[level], curve.ends);
        }
    }
    return world;
}

Points reconstruct(const LocalDetails& curve, int level) {
    assert(level >= 0 && level <= curve.level());
    Points control = curve.coarse;
    for (int j = 0; j < level; ++j) {
        Points detail = curve.details[j];
        out_of_frames(detail, control, curve.ends, curve.frame);
        control = synthesize(control, detail, curve.ends);
    }
    return control;
}

}  // namespace haarmony::curve
