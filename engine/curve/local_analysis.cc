#include "engine/curve/local_analysis.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/curve/bspline_filters.h"
#include "engine/curve/multires_curve.h"

namespace haarmony::curve {
namespace {

constexpr double kFallOff = 0.5353;
// Beyond where a change is felt, so that nothing special of an end is.
constexpr std::size_t kMargin = 16;

// Rows of the short curve are those of the long one minus a shift, which is another for the
// control points of its level, for those of the coarser level and for details.
struct Shifts {
    std::ptrdiff_t control = 0;
    std::ptrdiff_t coarse = 0;
    std::ptrdiff_t detail = 0;
};

std::size_t modulo(std::ptrdiff_t number, std::size_t count) {
    const auto n = std::ptrdiff_t(count);
    return std::size_t((number % n + n) % n);
}

bool is_large(std::span<const double> row, double least) {
    return std::ranges::any_of(row, [&](double x) { return std::abs(x) > least; });
}

// Without the rows at either end that are not large.
LocalRows trimmed(const Points& rows, double least) {
    std::size_t first = 0;
    std::size_t last = rows.size();
    while (first < last && !is_large(rows[first], least)) ++first;
    while (first < last && !is_large(rows[last - 1], least)) --last;
    LocalRows part{first, Points(last - first, rows.dimension())};
    for (std::size_t i = first; i < last; ++i)
        std::ranges::copy(rows[i], part.rows[i - first].begin());
    return part;
}

// Where a row `first` of the long curve's level goes, `before` rows at least behind its start.
Shifts shifts_of(std::size_t first,
                 std::size_t before,
                 int level,
                 int short_level,
                 Ends ends) {
    if (ends == Ends::kClosed) {
        // Where a closed curve's coarse points stand at even rows an open one's stand at odd
        // ones: control points shift by an odd number.
        const std::ptrdiff_t half = (std::ptrdiff_t(first) - std::ptrdiff_t(before)) >> 1;
        return {2 * half - 1, half - 1, half};
    }
    const std::size_t most = segment_count(level) - segment_count(short_level);
    const std::size_t wanted = first < before ? 0 : (first - before) / 2 * 2;
    const auto shift = std::ptrdiff_t(std::min(wanted, most));
    return {shift, shift / 2, shift / 2};
}

}  // namespace

LocalStep analyze_local(const LocalRows& control,
                        int level,
                        Ends ends,
                        double least,
                        double precision) {
    assert(level >= 1 && !control.rows.empty());
    assert(1e-16 <= precision && precision < 1);
    const auto felt = std::size_t(std::log(precision) / std::log(kFallOff)) + kMargin;
    const std::size_t rows = control.rows.size();
    int short_level = 6;  // from 5 on, all levels are alike but for their length
    while (segment_count(short_level) < rows + 4 * felt) ++short_level;
    const bool all = short_level >= level;
    const Ends short_ends = all ? ends : Ends::kOpen;
    if (all) short_level = level;
    const Shifts shifts =
        all ? Shifts() : shifts_of(control.first, 2 * felt, level, short_level, ends);

    const std::size_t count = control_count(level, ends);
    Points points(control_count(short_level, short_ends), control.rows.dimension());
    for (std::size_t i = 0; i < rows; ++i) {
        const auto at = std::ptrdiff_t(control.first + i) - shifts.control;
        std::ranges::copy(control.rows[i], points[modulo(at, count)].begin());
    }
    const AnalysisStep step = analyze(points, short_ends);
    // Wavelets of one level up are larger by sqrt(2), details smaller.
    const double scale = std::sqrt(std::ldexp(1.0, level - short_level));
    double largest_tap = 0;
    for (std::size_t row = 0; row < std::min(points.size(), std::size_t{32}); ++row) {
        const Taps taps = wavelet_row(short_level, short_ends, row);
        for (const double tap : taps.values())
            largest_tap = std::max(largest_tap, std::abs(tap));
    }

    LocalStep local{trimmed(step.coarse, least),
                    trimmed(step.detail, least / largest_tap),
                    points.size()};
    local.coarse.first = modulo(std::ptrdiff_t(local.coarse.first) + shifts.coarse,
                                control_count(level - 1, ends));
    local.detail.first = modulo(std::ptrdiff_t(local.detail.first) + shifts.detail,
                                segment_count(level - 1));
    for (double& number : local.detail.rows.numbers()) number /= scale;
    return local;
}

}  // namespace haarmony::curve
