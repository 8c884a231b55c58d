#include "tests/engine/curve/drawn_strokes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace haarmony::curve {
namespace {

struct Sample {
    double x, y;
};
std::vector<Sample> samples_of(const Points& bezier, std::size_t per_segment) {
    std::vector<Sample> samples;
    for (std::size_t first = 0; first < bezier.size(); first += 4) {
        for (std::size_t k = 0; k <= per_segment; ++k) {
            const std::vector<double> p =
                bernstein_sum(bezier, first, double(k) / double(per_segment));
            samples.push_back({p[0], p.size() > 1 ? p[1] : 0});
        }
    }
    return samples;
}

}  // namespace

Points drawn_stroke(const Stroke& stroke) {
    std::mt19937 random(stroke.seed);
    std::normal_distribution<double> noise(0, stroke.noise);
    std::uniform_real_distribution<double> phase(0, 2 * std::numbers::pi);
    const double a = phase(random);
    const double b = phase(random);
    Points points(control_count(stroke.level, stroke.ends), stroke.dimension);
    const double turn = 2 * std::numbers::pi;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double u = double(i) / double(points.size());
        const auto row = points[i];
        const double wave = std::sin(2 * turn * u + a) + 0.4 * std::sin(5 * turn * u + b);
        const bool closed = stroke.ends == Ends::kClosed;
        const double radius = 200 + 40 * wave;
        const double x = closed ? 300 + radius * std::cos(turn * u) : 600 * u;
        row[0] = x + noise(random);
        if (row.size() > 1) {
            const double y =
                closed ? 300 + radius * std::sin(turn * u) : 150 + 100 * wave;
            row[1] = y + noise(random);
        }
        for (std::size_t d = 2; d < row.size(); ++d) {
            row[d] = 3 + std::sin(turn * u * double(d) + a);
        }
    }
    return points;
}

std::vector<double> bernstein_sum(const Points& rows, std::size_t first, double t) {
    const double s = 1 - t;
    const double weight[4] = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
    std::vector<double> sum(std::size_t(rows.dimension()));
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t d = 0; d < sum.size(); ++d)
            sum[d] += weight[i] * rows[first + i][d];
    }
    return sum;
}

Points rows_of(const PlaneCubic& cubic) {
    Points rows(4, 2);
    for (std::size_t i = 0; i < 4; ++i) {
        rows[i][0] = cubic[i].x;
        rows[i][1] = cubic[i].y;
    }
    return rows;
}

Points four_rows_each(const Points& chain) {
    const std::size_t pieces = chain.size() / 3;
    Points rows(4 * pieces, chain.dimension());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        std::ranges::copy(chain[i / 4 * 3 + i % 4], rows[i].begin());
    }
    return rows;
}

double sampled_one_sided(const Points& a, const Points& b, std::size_t per_segment) {
    const std::vector<Sample> others = samples_of(b, per_segment);
    double farthest2 = 0;
    for (const Sample p : samples_of(a, per_segment)) {
        double nearest2 = INFINITY;
        for (const Sample q : others) {
            const double dx = p.x - q.x;
            const double dy = p.y - q.y;
            nearest2 = std::min(nearest2, dx * dx + dy * dy);
        }
        farthest2 = std::max(farthest2, nearest2);
    }
    return std::sqrt(farthest2);
}

double sampled_hausdorff(const Points& a, const Points& b, std::size_t per_segment) {
    return std::max(sampled_one_sided(a, b, per_segment),
                    sampled_one_sided(b, a, per_segment));
}

double widest_gap(const Points& bezier, std::size_t per_segment) {
    const std::vector<Sample> samples = samples_of(bezier, per_segment);
    double widest = 0;
    for (std::size_t i = 1; i < samples.size(); ++i) {
        // Between segments that do not meet nothing is missing.
        if (i % (per_segment + 1) == 0) continue;
        widest = std::max(
            widest,
            std::hypot(samples[i].x - samples[i - 1].x, samples[i].y - samples[i - 1].y));
    }
    return widest;
}

}  // namespace haarmony::curve
