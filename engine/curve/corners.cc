#include "engine/curve/corners.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>

#include "engine/curve/bspline.h"

namespace haarmony::curve {
namespace {

constexpr double kWindowOfNoise = 20;
constexpr double kLeastWindow = 0.03;  // of the diagonal
constexpr double kMostWindow = 0.12;
constexpr double kPlacesPerWindow = 16;
constexpr double kMostPlaces = 1 << 17;
constexpr double kSharp = 0.75;  // between an arc's 1/2 and a corner's 1
constexpr std::size_t kFewestForNoise = 16;
// More samples are looked at as the means of groups, which also takes noise off them.
constexpr std::size_t kMostLookedAt = 8192;

constexpr std::size_t kMostSteps = 1 << 20;  // of a curve

struct Vector {
    double x = 0;
    double y = 0;
};
Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y}; }
Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y}; }
Vector operator*(double s, Vector v) { return {s * v.x, s * v.y}; }
double norm(Vector v) { return std::hypot(v.x, v.y); }
double turn(Vector a, Vector b) {
    return std::fabs(std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y));
}

std::vector<Vector> plane(const Points& samples) {
    std::vector<Vector> points(samples.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        points[i] = {samples[i][0], samples.dimension() > 1 ? samples[i][1] : 0};
    return points;
}

double diagonal(const std::vector<Vector>& points) {
    Vector low = points[0];
    Vector high = low;
    for (const Vector p : points) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    return norm(high - low);
}

// Standard deviation of each coordinate.
double noise(const std::vector<Vector>& points) {
    if (points.size() < kFewestForNoise) return 0;
    std::vector<double> bends;
    for (std::size_t i = 1; i + 1 < points.size(); ++i)
        bends.push_back(norm(points[i - 1] + points[i + 1] - 2 * points[i]));
    const auto middle = bends.begin() + std::ptrdiff_t(bends.size() / 2);
    std::ranges::nth_element(bends, middle);
    // The length of a second difference has sqrt(6) times the deviation, and the median of a
    // Rayleigh distribution is sqrt(2 ln 2).
    return *middle / std::sqrt(12 * std::numbers::ln2);
}

// Groups of so many samples, as their means.
std::vector<Vector> grouped(const std::vector<Vector>& points, std::size_t group) {
    std::vector<Vector> means;
    for (std::size_t i = 0; i < points.size(); i += group) {
        const std::size_t end = std::min(points.size(), i + group);
        Vector sum;
        for (std::size_t k = i; k < end; ++k) sum = sum + points[k];
        means.push_back(1 / double(end - i) * sum);
    }
    return means;
}

// A polyline by its length: places at equal distances, each the mean of its part.
class Places {
  public:
    Places(const std::vector<Vector>& points, Ends ends, double window) : ends_(ends) {
        const std::size_t chords = points.size() - (ends == Ends::kOpen ? 1 : 0);
        along_.resize(points.size() + 1);
        for (std::size_t i = 0; i < chords; ++i) {
            along_[i + 1] = along_[i] + norm(points[(i + 1) % points.size()] - points[i]);
        }
        const double total = along_[chords];
        const double count =
            std::clamp(kPlacesPerWindow * total / window, kPlacesPerWindow, kMostPlaces);
        places_.resize(static_cast<std::size_t>(count));
        step_ = total / double(places_.size());
        std::size_t chord = 0;
        for (std::size_t i = 0; i < places_.size(); ++i) {
            const double end = step_ * double(i + 1);
            double from = step_ * double(i);
            Vector sum;
            while (true) {
                while (chord + 1 < chords && along_[chord + 1] <= from) ++chord;
                const double to =
                    chord + 1 < chords ? std::min(end, along_[chord + 1]) : end;
                const double length = along_[chord + 1] - along_[chord];
                const double t =
                    length > 0 ? ((from + to) / 2 - along_[chord]) / length : 0;
                const Vector a = points[chord];
                const Vector b = points[(chord + 1) % points.size()];
                sum = sum + (to - from) * (a + t * (b - a));
                if (to >= end) break;
                from = to;
            }
            places_[i] = 1 / step_ * sum;
        }
    }

    [[nodiscard]] std::size_t size() const { return places_.size(); }

    // What the windows at a place show.
    struct Directions {
        Vector in;
        Vector out;
        std::size_t before = 0;  // places in the windows
        std::size_t behind = 0;
    };
    // Nothing where the stroke ends within a window.
    [[nodiscard]] std::optional<Directions> directions(std::size_t place,
                                                       double window) const {
        Directions found;
        found.before = reach(place, -1, window);
        found.behind = reach(place, 1, window);
        if (found.before == 0 || found.behind == 0) return std::nullopt;
        found.in = -1 * direction(place, -1, found.before);
        found.out = direction(place, 1, found.behind);
        return found;
    }

    // Samples whose distance along the stroke is that of places near `place`.
    template <typename Visit>
    void visit_samples(std::size_t place,
                       std::size_t before,
                       std::size_t behind,
                       std::size_t samples,
                       Visit visit) const {
        const double total = step_ * double(places_.size());
        const double middle = step_ * (double(place) + 0.5);
        const double low = middle - step_ * double(before);
        const double high = middle + step_ * double(behind);
        const auto part = [&](double from, double to) {
            const auto end = along_.begin() + std::ptrdiff_t(samples);
            for (auto it = std::lower_bound(along_.begin(), end, from);
                 it != end && *it <= to;
                 ++it)
                visit(std::size_t(it - along_.begin()));
        };
        part(low, high);
        if (ends_ == Ends::kClosed && low < 0) part(low + total, total);
        if (ends_ == Ends::kClosed && high > total) part(0, high - total);
    }

  private:
    [[nodiscard]] Vector at(std::size_t place, int direction, std::size_t steps) const {
        const std::size_t n = places_.size();
        return places_[(direction > 0 ? place + steps : place + n - steps) % n];
    }
    // Places until one is `window` away; 0 if the stroke ends, or returns, before.
    [[nodiscard]] std::size_t reach(std::size_t place,
                                    int direction,
                                    double window) const {
        const std::size_t left = direction > 0 ? places_.size() - 1 - place : place;
        const std::size_t most = ends_ == Ends::kOpen ? left : places_.size() / 2;
        for (std::size_t k = 1; k <= most; ++k) {
            if (norm(at(place, direction, k) - places_[place]) >= window) return k;
        }
        return 0;
    }
    [[nodiscard]] Vector direction(std::size_t place, int way, std::size_t count) const {
        const std::size_t half = std::max<std::size_t>(1, count / 2);
        Vector near;
        Vector far;
        for (std::size_t k = 0; k < half; ++k) {
            near = near + at(place, way, k);
            far = far + at(place, way, count - k);
        }
        return 1 / double(half) * (far - near);
    }

    Ends ends_;
    std::vector<double> along_;  // of each sample, and of the whole
    std::vector<Vector> places_;
    double step_ = 0;
};

struct Candidate {
    std::size_t place = 0;
    double turn = 0;
    Places::Directions directions;
};

// Candidates of which no other one within its window turns more; the first of equals.
// Candidates are in the order of their places, so only neighbours need be looked at.
std::vector<Candidate> sharpest(const std::vector<Candidate>& candidates,
                                Ends ends,
                                std::size_t places) {
    const std::size_t count = candidates.size();
    std::vector<Candidate> kept;
    for (std::size_t i = 0; i < count; ++i) {
        const Candidate& one = candidates[i];
        const std::size_t near = std::max(one.directions.before, one.directions.behind);
        bool beaten = false;
        const auto look = [&](std::size_t step, bool earlier_wins) {
            for (std::size_t n = 1, k = i; n < count && !beaten; ++n) {
                if (ends == Ends::kOpen && k == (earlier_wins ? 0 : count - 1)) break;
                k = (k + step) % count;
                const Candidate& other = candidates[k];
                const std::size_t from = earlier_wins ? other.place : one.place;
                const std::size_t to = earlier_wins ? one.place : other.place;
                if ((to + places - from) % places >= near) break;
                beaten =
                    other.turn > one.turn || (other.turn == one.turn && earlier_wins);
            }
        };
        look(count - 1, true);
        look(1, false);
        if (!beaten) kept.push_back(one);
    }
    return kept;
}

}  // namespace

std::vector<std::size_t> detect_corners(const Points& samples,
                                        Ends ends,
                                        const CornerOptions& options) {
    assert(options.degrees > 0 && options.degrees <= 180 && options.window >= 0);
    if (samples.size() < 3) return {};
    const std::vector<Vector> all = plane(samples);
    const double size = diagonal(all);
    if (!(size > 0)) return {};
    const double window = options.window > 0 ? options.window
                                             : std::clamp(kWindowOfNoise * noise(all),
                                                          kLeastWindow * size,
                                                          kMostWindow * size);
    const std::size_t group = (all.size() + kMostLookedAt - 1) / kMostLookedAt;
    const std::vector<Vector> points = grouped(all, group);
    const Places places(points, ends, window);

    std::vector<Candidate> candidates;
    const double least = options.degrees * std::numbers::pi / 180;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const std::optional<Places::Directions> whole = places.directions(i, window);
        if (!whole) continue;
        const double angle = turn(whole->in, whole->out);
        if (angle < least) continue;
        const std::optional<Places::Directions> half = places.directions(i, window / 2);
        if (!half || turn(half->in, half->out) < kSharp * angle) continue;
        candidates.push_back({i, angle, *whole});
    }

    std::vector<std::size_t> corners;
    for (const Candidate& corner : sharpest(candidates, ends, places.size())) {
        const Places::Directions& at = corner.directions;
        const Vector outward = 1 / norm(at.in) * at.in - 1 / norm(at.out) * at.out;
        std::optional<std::size_t> best;
        double furthest = 0;
        places.visit_samples(
            corner.place, at.before, at.behind, points.size(), [&](std::size_t first) {
                const std::size_t end = std::min(all.size(), (first + 1) * group);
                for (std::size_t i = first * group; i < end; ++i) {
                    const double out = all[i].x * outward.x + all[i].y * outward.y;
                    if (best && out <= furthest) continue;
                    best = i;
                    furthest = out;
                }
            });
        if (!best) continue;
        const bool end = *best == 0 || *best + 1 == all.size();
        if (ends == Ends::kClosed || !end) corners.push_back(*best);
    }
    std::ranges::sort(corners);
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    return corners;
}

std::vector<double> detect_curve_corners(const Points& control,
                                         Ends ends,
                                         const CornerOptions& options) {
    const std::optional<int> level = level_of(control.size(), ends);
    assert(level);
    const std::size_t steps =
        std::clamp<std::size_t>(16 * segment_count(*level), 512, kMostSteps);
    Points samples(ends == Ends::kOpen ? steps + 1 : steps, control.dimension());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        std::ranges::copy(point_at(control, ends, double(i) / double(steps)),
                          samples[i].begin());
    }
    std::vector<double> corners;
    for (const std::size_t i : detect_corners(samples, ends, options))
        corners.push_back(double(i) / double(steps));
    return corners;
}

}  // namespace haarmony::curve
