#include "engine/curve/hausdorff.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/curve/nearest_cubic.h"

namespace haarmony::curve {
namespace {

constexpr double kSamplesPerSegment = 8;
constexpr double kMostSamples = 4096;  // of one segment
// Peaks that are searched; only samples within a twentieth of the largest distance have one
// that could exceed it.
constexpr int kMostPeaks = 12;
constexpr double kPeak = 0.95;
constexpr int kGoldenSteps = 24;

double control_length(const PlaneCubic& p) {
    return norm(p[1] - p[0]) + norm(p[2] - p[1]) + norm(p[3] - p[2]);
}

double total_length(std::span<const PlaneCubic> cubics) {
    double sum = 0;
    for (const PlaneCubic& cubic : cubics) sum += control_length(cubic);
    return sum;
}

// What rounding alone can make of no distance at all.
double rounding_of(std::span<const PlaneCubic> cubics) {
    double size = 0;
    for (const PlaneCubic& cubic : cubics) {
        for (const PlaneVector p : cubic) {
            size = std::max({size, std::abs(p.x), std::abs(p.y)});
        }
    }
    return 32 * std::numeric_limits<double>::epsilon() * size;
}

// A point of the curve that is measured. `seen2` is at least its squared distance.
struct Sample {
    std::size_t cubic;
    double from, t, to;  // up to the neighbours
    double seen2;
};

class OneSided {
  public:
    OneSided(std::span<const PlaneCubic> curve,
             const NearestCubic& other,
             double spacing,
             double usual,
             double rounding)
        : curve_(curve), other_(other), rounding2_(rounding * rounding) {
        const double usual2 = usual * usual;
        CubicPlace place = other.find(curve.front()[0]);
        for (std::size_t i = 0; i < curve.size(); ++i) {
            const PlanePolynomial polynomial(curve[i]);
            const double wanted = spacing > 0 ? control_length(curve[i]) / spacing : 0;
            const double count =
                std::clamp(std::ceil(wanted), kSamplesPerSegment / 2, kMostSamples);
            const bool last = i + 1 == curve.size();
            for (double k = 0; k < count + (last ? 1 : 0); ++k) {
                const double t = k / count;
                const PlaneVector q = polynomial.value(t);
                place = other.walk(q, place);
                if (place.distance2 > usual2) place = other.find(q);
                samples_.push_back({i,
                                    std::max(t - 1 / count, 0.0),
                                    t,
                                    std::min(t + 1 / count, 1.0),
                                    place.distance2});
            }
        }
    }

    // 0 if it is within rounding errors.
    double distance2() {
        const auto less = [](const Sample& a, const Sample& b) {
            return a.seen2 < b.seen2;
        };
        std::ranges::make_heap(samples_, less);
        double largest2 = 0;
        int peaks = 0;
        while (!samples_.empty() && samples_.front().seen2 > rounding2_) {
            const Sample sample = samples_.front();
            const bool higher = sample.seen2 > largest2;
            if (!higher &&
                (peaks == kMostPeaks || sample.seen2 < kPeak * kPeak * largest2)) {
                break;
            }
            std::ranges::pop_heap(samples_, less);
            samples_.pop_back();
            const double exact2 = distance2_of(sample.cubic, sample.t);
            largest2 = std::max(largest2, exact2);
            if (peaks < kMostPeaks && exact2 >= kPeak * kPeak * largest2) {
                ++peaks;
                largest2 = std::max(largest2, peak_of(sample));
            }
        }
        return largest2 > rounding2_ ? largest2 : 0;
    }

  private:
    double distance2_of(std::size_t cubic, double t) const {
        return other_.find(PlanePolynomial(curve_[cubic]).value(t)).distance2;
    }

    // Golden section; any distance found exists, so a second peak does no harm.
    double peak_of(const Sample& sample) const {
        constexpr double kGolden = 0.6180339887498949;
        double from = sample.from;
        double to = sample.to;
        double left = to - kGolden * (to - from);
        double right = from + kGolden * (to - from);
        double at_left = distance2_of(sample.cubic, left);
        double at_right = distance2_of(sample.cubic, right);
        double largest2 = std::max(at_left, at_right);
        for (int step = 0; step < kGoldenSteps; ++step) {
            if (at_left > at_right) {
                to = right;
                right = left;
                at_right = at_left;
                left = to - kGolden * (to - from);
                at_left = distance2_of(sample.cubic, left);
            } else {
                from = left;
                left = right;
                at_left = at_right;
                right = from + kGolden * (to - from);
                at_right = distance2_of(sample.cubic, right);
            }
            largest2 = std::max({largest2, at_left, at_right});
        }
        return largest2;
    }

    std::span<const PlaneCubic> curve_;
    const NearestCubic& other_;
    double rounding2_;
    std::vector<Sample> samples_;
};

}  // namespace

double hausdorff(std::span<const PlaneCubic> a,
                 std::span<const PlaneCubic> b,
                 double usual) {
    assert(!a.empty() && !b.empty());
    const double segments = static_cast<double>(std::max(a.size(), b.size()));
    const double spacing =
        std::max(total_length(a), total_length(b)) / (segments * kSamplesPerSegment);
    const NearestCubic near_a(a);
    const NearestCubic near_b(b);
    const double rounding = std::max(rounding_of(a), rounding_of(b));
    return std::sqrt(std::max(OneSided(a, near_b, spacing, usual, rounding).distance2(),
                              OneSided(b, near_a, spacing, usual, rounding).distance2()));
}

}  // namespace haarmony::curve
