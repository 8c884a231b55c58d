#include "engine/curve/surface.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "engine/curve/bspline.h"
#include "engine/curve/multires_curve.h"
#include "engine/curve/smooth.h"
#include "engine/curve/sweep_edit.h"

namespace haarmony::curve {
namespace {

enum class Along { kU, kV };

int known_level(std::size_t count) {
    const std::optional<int> level = level_of(count, Ends::kOpen);
    assert(level);
    return *level;
}

// The lines of a grid in one direction, each of them a curve.
std::size_t line_count(const Grid& grid, Along along) {
    return along == Along::kU ? grid.along_v : grid.along_u;
}
std::size_t line_length(const Grid& grid, Along along) {
    return along == Along::kU ? grid.along_u : grid.along_v;
}
template <typename AnyGrid>
auto on_line(AnyGrid& grid, Along along, std::size_t line, std::size_t place) {
    return along == Along::kU ? grid.at(place, line) : grid.at(line, place);
}

void read_line(const Grid& grid, Along along, std::size_t line, Points& points) {
    for (std::size_t i = 0; i < points.size(); ++i)
        std::ranges::copy(on_line(grid, along, line, i), points[i].begin());
}
void write_line(const Points& points, Along along, std::size_t line, Grid& grid) {
    for (std::size_t i = 0; i < points.size(); ++i)
        std::ranges::copy(points[i], on_line(grid, along, line, i).begin());
}

// A grid with lines of another length.
Grid resized(const Grid& grid, Along along, std::size_t length) {
    const int dimension = grid.points.dimension();
    return along == Along::kU ? Grid(length, grid.along_v, dimension)
                              : Grid(grid.along_u, length, dimension);
}

struct Halves {
    Grid coarse;
    Grid detail;
};
Halves analyze_lines(const Grid& grid, Along along) {
    const std::size_t length = line_length(grid, along);
    const std::size_t details = segment_count(known_level(length) - 1);
    Halves halves{resized(grid, along, details + 3), resized(grid, along, details)};
    Points points(length, grid.points.dimension());
    for (std::size_t line = 0; line < line_count(grid, along); ++line) {
        read_line(grid, along, line, points);
        const AnalysisStep step = analyze(points, Ends::kOpen);
        write_line(step.coarse, along, line, halves.coarse);
        write_line(step.detail, along, line, halves.detail);
    }
    return halves;
}

Grid synthesize_lines(const Grid& coarse, const Grid& detail, Along along) {
    const std::size_t details = line_length(detail, along);
    Grid grid = resized(coarse, along, 2 * details + 3);
    Points sweep(details + 3, coarse.points.dimension());
    Points wavelets(details, coarse.points.dimension());
    for (std::size_t line = 0; line < line_count(coarse, along); ++line) {
        read_line(coarse, along, line, sweep);
        read_line(detail, along, line, wavelets);
        write_line(synthesize(sweep, wavelets, Ends::kOpen), along, line, grid);
    }
    return grid;
}

Grid smooth_lines(const Grid& grid, Along along, double level) {
    const std::size_t length = control_count(int(std::ceil(level)), Ends::kOpen);
    Grid smoothed = resized(grid, along, length);
    Points points(line_length(grid, along), grid.points.dimension());
    for (std::size_t line = 0; line < line_count(grid, along); ++line) {
        read_line(grid, along, line, points);
        const MultiresCurve curve = decompose(points, Ends::kOpen);
        write_line(smooth(curve, level, SmoothedEnds::kFree), along, line, smoothed);
    }
    return smoothed;
}

// A weight up to this is what rounding leaves of 1: it changes nothing.
constexpr double kRounding = 1e-15;

// How much each control point of the finest level moves with one of a smoother curve.
std::vector<double> weights_of(double level, std::size_t index, std::size_t count) {
    const double one = 1;
    const SweepChange change =
        control_change(RealLevel(level), Ends::kOpen, index, std::span(&one, 1));
    const Points weights = refined(change, Ends::kOpen, known_level(count));
    return {weights.numbers().begin(), weights.numbers().end()};
}

std::optional<Error> check_direction(double level,
                                     std::size_t index,
                                     std::size_t count,
                                     const char* level_name,
                                     const char* index_name) {
    const int finest = known_level(count);
    if (!(level >= 0 && level <= finest)) {
        return Error{
            ErrorCode::kInvalidArgument,
            "level " + std::to_string(level) + " is outside 0.." + std::to_string(finest),
            level_name};
    }
    const std::size_t points = control_count(int(std::ceil(level)), Ends::kOpen);
    if (index >= points) {
        return Error{ErrorCode::kInvalidArgument,
                     "control point " + std::to_string(index) + " of " +
                         std::to_string(points) + " at level " + std::to_string(level),
                     index_name};
    }
    return std::nullopt;
}

std::optional<Error> check_delta(std::span<const double> delta, int dimension) {
    if (delta.size() != std::size_t(dimension)) {
        return Error{ErrorCode::kInvalidArgument,
                     "delta of " + std::to_string(delta.size()) +
                         " numbers for a surface of " + std::to_string(dimension),
                     "delta"};
    }
    for (const double number : delta) {
        if (!std::isfinite(number)) {
            return Error{ErrorCode::kInvalidArgument,
                         "delta " + std::to_string(number) + " is not finite",
                         "delta"};
        }
    }
    return std::nullopt;
}

}  // namespace

MultiresSurface decompose(const Grid& control) {
    MultiresSurface surface{control, {}};
    const int steps =
        std::min(known_level(control.along_u), known_level(control.along_v));
    for (int step = 0; step < steps; ++step) {
        Halves in_u = analyze_lines(surface.coarse, Along::kU);
        Halves of_coarse = analyze_lines(in_u.coarse, Along::kV);
        Halves of_detail = analyze_lines(in_u.detail, Along::kV);
        surface.coarse = std::move(of_coarse.coarse);
        surface.details.push_back({std::move(of_coarse.detail),
                                   std::move(of_detail.coarse),
                                   std::move(of_detail.detail)});
    }
    std::ranges::reverse(surface.details);
    return surface;
}

Grid reconstruct(const MultiresSurface& surface, std::size_t steps) {
    assert(steps <= surface.details.size());
    Grid control = surface.coarse;
    for (std::size_t step = 0; step < steps; ++step) {
        const DetailGrids& details = surface.details[step];
        control = synthesize_lines(synthesize_lines(control, details.cd, Along::kV),
                                   synthesize_lines(details.dc, details.dd, Along::kV),
                                   Along::kU);
    }
    return control;
}

Grid smooth(const Grid& control, double level_u, double level_v) {
    return smooth_lines(smooth_lines(control, Along::kV, level_v), Along::kU, level_u);
}

Result<EditedSurface> edit_surface(const Grid& control, const SurfaceEdit& edit) {
    for (const std::optional<Error>& error : std::array{
             check_direction(
                 edit.level_u, edit.index_u, control.along_u, "level_u", "index_u"),
             check_direction(
                 edit.level_v, edit.index_v, control.along_v, "level_v", "index_v"),
             check_delta(edit.delta, control.points.dimension())}) {
        if (error) return *error;
    }
    const std::vector<double> in_u =
        weights_of(edit.level_u, edit.index_u, control.along_u);
    const std::vector<double> in_v =
        weights_of(edit.level_v, edit.index_v, control.along_v);
    EditedSurface edited{control, 0};
    for (std::size_t a = 0; a < in_u.size(); ++a) {
        if (std::abs(in_u[a]) <= kRounding) continue;
        for (std::size_t b = 0; b < in_v.size(); ++b) {
            if (std::abs(in_v[b]) <= kRounding) continue;
            const auto point = edited.control.at(a, b);
            for (std::size_t d = 0; d < point.size(); ++d) {
                point[d] += in_u[a] * in_v[b] * edit.delta[d];
                if (std::isfinite(point[d])) continue;
                return Error{ErrorCode::kInvalidArgument,
                             "delta " + std::to_string(edit.delta[d]) +
                                 " moves a control point beyond what a number can hold",
                             "delta"};
            }
            ++edited.changed;
        }
    }
    return edited;
}

std::vector<double> point_at(const Grid& control, double u, double v) {
    const BasisAt in_u = basis_at(known_level(control.along_u), Ends::kOpen, u);
    const BasisAt in_v = basis_at(known_level(control.along_v), Ends::kOpen, v);
    std::vector<double> sum(std::size_t(control.points.dimension()));
    for (std::size_t a = 0; a < 4; ++a) {
        for (std::size_t b = 0; b < 4; ++b) {
            const auto point = control.at(in_u.first + a, in_v.first + b);
            for (std::size_t d = 0; d < sum.size(); ++d)
                sum[d] += in_u.value[a] * in_v.value[b] * point[d];
        }
    }
    return sum;
}

}  // namespace haarmony::curve
