#include "engine/curve/stroke_signature.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>

#include "engine/curve/fit.h"
#include "engine/curve/frame.h"
#include "engine/curve/multires_curve.h"

namespace haarmony::curve {
namespace {

// Points that the curve is fitted to: 4 for each of its segments.
constexpr std::size_t kPoints = std::size_t{4} << kSignatureLevel;

// Upright and at equal distances depend on each other; steeper slants than 45 degrees would
// be taken for lines that rise.
constexpr int kRounds = 5;
constexpr double kMostSlant = 1;

// Smaller details, by the size of the stroke, are rounding.
constexpr double kLeastDetail = 1e-9;

Points at_equal_distances(const Points& points, std::size_t count) {
    const std::vector<double> at =
        stroke_parameters(points, Ends::kOpen, Spacing::kChordLength);
    Points result(count, 2);
    std::size_t chord = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double u = double(i) / double(count - 1);
        while (chord + 2 < at.size() && at[chord + 1] < u) ++chord;
        const double length = at[chord + 1] - at[chord];
        const double t = length > 0 ? std::clamp((u - at[chord]) / length, 0.0, 1.0) : 0;
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const double a = points[chord][axis];
            result[i][axis] = a + t * (points[chord + 1][axis] - a);
        }
    }
    return result;
}

// Mean 0 and mean square 1; whether it has any length.
bool centered(Points& points) {
    const std::size_t count = points.size();
    double low[2];
    double high[2];
    for (std::size_t axis = 0; axis < 2; ++axis) {
        low[axis] = high[axis] = points[0][axis];
        for (std::size_t i = 1; i < count; ++i) {
            low[axis] = std::min(low[axis], points[i][axis]);
            high[axis] = std::max(high[axis], points[i][axis]);
        }
    }
    // By the box first, so that no square overflows.
    const double size = std::max(high[0] / 2 - low[0] / 2, high[1] / 2 - low[1] / 2);
    if (size < 1e-300) {
        std::ranges::fill(points.numbers(), 0.0);
        return false;
    }
    double square = 0;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const double middle = low[axis] / 2 + high[axis] / 2;
        double mean = 0;
        for (std::size_t i = 0; i < count; ++i) {
            points[i][axis] = (points[i][axis] - middle) / size;
            mean += points[i][axis] / double(count);
        }
        for (std::size_t i = 0; i < count; ++i) {
            points[i][axis] -= mean;
            square += points[i][axis] * points[i][axis] / double(count);
        }
    }
    for (double& number : points.numbers()) number /= std::sqrt(square);
    return true;
}

double slant(const Points& points) {
    double both = 0;
    double upright = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double dx = points[i][0] - points[i - 1][0];
        const double dy = points[i][1] - points[i - 1][1];
        both += dx * dy;
        upright += dy * dy;
    }
    // A level line has no slant, and none that noise could decide.
    if (upright < 1e-12) return 0;
    return both / upright;
}

}  // namespace

Points normalized_stroke(const Points& samples, std::size_t count) {
    assert(samples.size() >= 2 && count >= 2);
    Points plane(samples.size(), 2);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const std::size_t axes = std::min<std::size_t>(2, samples[i].size());
        std::ranges::copy(samples[i].first(axes), plane[i].begin());
    }
    if (!centered(plane)) return Points(count, 2);
    double shear = 0;
    const auto upright = [&] {
        Points points = plane;
        for (std::size_t i = 0; i < points.size(); ++i)
            points[i][0] -= shear * points[i][1];
        return points;
    };
    for (int round = 0; round < kRounds; ++round) {
        const double more = slant(at_equal_distances(upright(), kPoints));
        shear = std::clamp(shear + more, -kMostSlant, kMostSlant);
    }
    plane = upright();
    plane = at_equal_distances(plane, count);
    centered(plane);
    return plane;
}

StrokeSignature stroke_signature(const Points& samples, Frame frame) {
    const Points points = normalized_stroke(samples, kPoints);
    std::vector<double> parameters(kPoints);
    for (std::size_t i = 0; i < kPoints; ++i)
        parameters[i] = double(i) / double(kPoints - 1);
    FitOptions options;
    options.rounds = 0;
    options.parameters = parameters;
    const CurveFit curve = fit(points, kSignatureLevel, options);
    const LocalDetails local = to_local(decompose(curve.control, Ends::kOpen), frame);

    struct Detail {
        double size;
        int term;
    };
    std::vector<Detail> details;
    for (int j = 0; j < kSignatureLevel; ++j) {
        const Points& rows = local.details[std::size_t(j)];
        for (std::size_t k = 0; k < rows.size(); ++k) {
            for (std::size_t axis = 0; axis < 2; ++axis) {
                const double value = rows[k][axis];
                if (std::fabs(value) < kLeastDetail) continue;
                const int key = int(1 + 2 * (segment_count(j) - 1 + k) + axis);
                details.push_back({std::fabs(value), value < 0 ? -key : key});
            }
        }
    }
    const auto larger = [](const Detail& a, const Detail& b) {
        return a.size != b.size ? a.size > b.size : std::abs(a.term) < std::abs(b.term);
    };
    std::ranges::sort(details, larger);
    if (details.size() > kSignatureTerms) details.resize(kSignatureTerms);
    StrokeSignature signature;
    for (const Detail& detail : details)
        signature.terms.push_back(static_cast<std::int16_t>(detail.term));
    std::ranges::sort(
        signature.terms, {}, [](std::int16_t term) { return std::abs(term); });
    return signature;
}

}  // namespace haarmony::curve
