#include "engine/curve/path_samples.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <string>

#include "engine/curve/number_text.h"

namespace haarmony::curve {
namespace {

constexpr double kSpacings =
    512;  // neighbours are at most this part of the polygon apart

struct Vector {
    double x = 0;
    double y = 0;
};

Vector difference(const Points& points, std::size_t from, std::size_t to) {
    return {points[to][0] - points[from][0], points[to][1] - points[from][1]};
}
double norm(Vector v) { return std::hypot(v.x, v.y); }

double polygon_length(const Points& bezier, std::size_t first, std::size_t last) {
    double sum = 0;
    for (std::size_t i = first; i < last; ++i) sum += norm(difference(bezier, i, i + 1));
    return sum;
}

// Chords of the segment that begins at row `first`, as a real number that may be huge.
double chords_of(const Points& bezier,
                 std::size_t first,
                 double deviation,
                 double spacing) {
    const auto bend = [&](std::size_t i) {
        const Vector in = difference(bezier, i, i + 1);
        const Vector out = difference(bezier, i + 1, i + 2);
        return norm({out.x - in.x, out.y - in.y});
    };
    const double most = std::max(bend(first), bend(first + 1));
    const double by_deviation = std::sqrt(0.75 * most / deviation);
    // A chord is no longer than the step times the largest derivative.
    double fastest = 0;
    for (std::size_t i = first; i < first + 3; ++i)
        fastest = std::max(fastest, 3 * norm(difference(bezier, i, i + 1)));
    const double by_spacing = spacing > 0 ? fastest / spacing : 0;
    return std::max(1.0, std::ceil(std::max(by_deviation, by_spacing)));
}

void point_of(const Points& bezier, std::size_t first, double t, std::span<double> out) {
    const double s = 1 - t;
    const std::array<double, 4> weight{
        s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
    for (std::size_t axis = 0; axis < out.size(); ++axis) {
        double sum = 0;
        for (std::size_t i = 0; i < 4; ++i) sum += weight[i] * bezier[first + i][axis];
        out[axis] = sum;
    }
}

// The direction in which a segment leaves its first point, or arrives at its last one.
std::optional<Vector> leaving(const Points& bezier, std::size_t first) {
    for (std::size_t i = 1; i <= 3; ++i) {
        const Vector v = difference(bezier, first, first + i);
        if (norm(v) > 0) return v;
    }
    return std::nullopt;
}
std::optional<Vector> arriving(const Points& bezier, std::size_t first) {
    for (std::size_t i = 3; i-- > 0;) {
        const Vector v = difference(bezier, first + i, first + 3);
        if (norm(v) > 0) return v;
    }
    return std::nullopt;
}

bool turns(Vector in, Vector out) {
    const Vector a{in.x / norm(in), in.y / norm(in)};
    const Vector b{out.x / norm(out), out.y / norm(out)};
    const double angle =
        std::fabs(std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y));
    return angle > kPathCornerDegrees * std::numbers::pi / 180;
}

}  // namespace

Result<PathSamples> sample_path(const SvgSubpath& path, double deviation) {
    const Points& bezier = path.bezier;
    assert(deviation > 0);
    assert(bezier.size() >= 4 && bezier.size() % 3 == 1);
    const std::size_t segments = bezier.size() / 3;
    const double spacing = polygon_length(bezier, 0, bezier.size() - 1) / kSpacings;

    std::vector<std::size_t> chords(segments);
    double total = 1;
    for (std::size_t i = 0; i < segments; ++i) {
        const double count = chords_of(bezier, 3 * i, deviation, spacing);
        total += count;
        if (!(total <= double(kMostPathSamples))) {
            return Error{ErrorCode::kTooLarge,
                         "path data: a deviation of " + number_text(deviation) +
                             " takes more than " + std::to_string(kMostPathSamples) +
                             " samples",
                         "d"};
        }
        chords[i] = static_cast<std::size_t>(count);
    }

    const std::size_t rows = static_cast<std::size_t>(total);
    PathSamples samples{Points(path.closed ? rows - 1 : rows, bezier.dimension()), {}};
    std::optional<Vector> before;  // the direction in which the path arrived
    if (path.closed) {
        for (std::size_t i = segments; i-- > 0 && !before;)
            before = arriving(bezier, 3 * i);
    }
    std::size_t row = 0;
    for (std::size_t i = 0; i < segments; ++i) {
        const std::optional<Vector> out = leaving(bezier, 3 * i);
        if (before && out && turns(*before, *out)) samples.corners.push_back(row);
        if (out) before = arriving(bezier, 3 * i);
        for (std::size_t k = 0; k < chords[i]; ++k)
            point_of(bezier, 3 * i, double(k) / double(chords[i]), samples.points[row++]);
    }
    if (!path.closed)
        std::ranges::copy(bezier[bezier.size() - 1], samples.points[row].begin());
    return samples;
}

}  // namespace haarmony::curve
