#include "engine/curve/wavelet_peak.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "engine/curve/bspline.h"
#include "engine/curve/multires_curve.h"

namespace haarmony::curve {
namespace {

// From this level on the wavelets at the ends differ in scale alone, and no wavelet feels
// both ends.
constexpr int kRegularLevel = 3;
constexpr std::size_t kIrregular = 3;  // wavelets at each end that no translate equals

struct Extremum {
    double at = 0;
    double size = 0;
};

double bezier(const std::array<double, 4>& b, double s) {
    const double r = 1 - s;
    return r * r * r * b[0] + 3 * s * r * (r * b[1] + s * b[2]) + s * s * s * b[3];
}

// The largest |value| of a cubic over [0, 1]: at an end or where the slope is 0.
Extremum largest(const std::array<double, 4>& b) {
    Extremum best{0, std::abs(b[0])};
    const auto consider = [&](double s) {
        if (!(s > 0 && s <= 1)) return;
        const double size = std::abs(bezier(b, s));
        if (size > best.size) best = {s, size};
    };
    consider(1);
    // The slope is 3 (c0 + c1 s + c2 s^2).
    const double c0 = b[1] - b[0];
    const double c1 = 2 * (b[2] - 2 * b[1] + b[0]);
    const double c2 = b[3] - 3 * b[2] + 3 * b[1] - b[0];
    const double discriminant = c1 * c1 - 4 * c2 * c0;
    if (discriminant < 0) return best;
    // The sum without cancellation; the other root comes from the product of both.
    const double q = -0.5 * (c1 + std::copysign(std::sqrt(discriminant), c1));
    if (c2 != 0) consider(q / c2);
    if (q != 0) consider(c0 / q);
    return best;
}

double peak_by_search(int level, std::size_t row) {
    Points detail(segment_count(level), 1);
    detail[row][0] = 1;
    const Points zero(control_count(level, Ends::kOpen), 1);
    const Points hull = bezier_points(synthesize(zero, detail, Ends::kOpen), Ends::kOpen);
    const std::size_t segments = segment_count(level + 1);
    double peak = 0;
    double size = 0;
    for (std::size_t segment = 0; segment < segments; ++segment) {
        const std::size_t first = 3 * segment;
        const Extremum here = largest(
            {hull[first][0], hull[first + 1][0], hull[first + 2][0], hull[first + 3][0]});
        if (here.size > size) {
            size = here.size;
            peak = (double(segment) + here.at) / double(segments);
        }
    }
    return peak;
}

// Peaks at the left end, in segments: by level up to the regular one, and by row.
using LeftPeaks = std::array<std::array<double, kIrregular>, kRegularLevel + 1>;

LeftPeaks search_left_peaks() {
    LeftPeaks peaks{};
    for (int level = 1; level <= kRegularLevel; ++level) {
        const std::size_t rows = std::min(segment_count(level) / 2, kIrregular);
        for (std::size_t row = 0; row < rows; ++row) {
            peaks[level][row] = peak_by_search(level, row) * double(segment_count(level));
        }
    }
    return peaks;
}

}  // namespace

double wavelet_peak(int level, Ends ends, std::size_t row) {
    const std::size_t rows = segment_count(level);
    assert(level >= 0 && row < rows);
    // A wavelet that feels no end is symmetric about the middle of its segment.
    const std::size_t from_end = std::min(row, rows - 1 - row);
    const bool symmetric = ends == Ends::kClosed || level == 0 ||
                           (level >= kRegularLevel && from_end >= kIrregular);
    if (symmetric) return (double(row) + 0.5) / double(rows);
    static const LeftPeaks left_peaks = search_left_peaks();
    const double peak =
        left_peaks[std::min(level, kRegularLevel)][from_end] / double(rows);
    return row == from_end ? peak : 1 - peak;
}

}  // namespace haarmony::curve
