#include "engine/curve/cubic_fit.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace haarmony::curve {
namespace {

// More take longer and find no more: the proof looks at the whole run anyway.
constexpr std::size_t kMostSamples = 16;
constexpr int kFewSteps = 2;
constexpr int kMostSteps = 10;
// Steps go on while the squared distance of the worst sample falls to less than this.
constexpr double kFalling = 0.4;
// Of the squared tolerance: where steps end, as what is between the samples may be farther
// away, and what the last one may have made good.
constexpr double kWell = 0.5;
constexpr double kNear = 4;
// Tangents of almost no length make loops and corners, those longer than twice the run
// leave it.
constexpr double kShortest = 0.02;
constexpr double kLongest = 2;
// Keeps a step finite where the samples do not say how long a tangent should be.
constexpr double kDamping = 1e-4;

// Normal equations for two unknowns.
struct TwoUnknowns {
    double aa = 0, ab = 0, bb = 0, a = 0, b = 0;

    void add(double with_a, double with_b, double value) {
        aa += with_a * with_a;
        ab += with_a * with_b;
        bb += with_b * with_b;
        a += with_a * value;
        b += with_b * value;
    }
    [[nodiscard]] double determinant() const { return aa * bb - ab * ab; }
    [[nodiscard]] double first() const { return (a * bb - b * ab) / determinant(); }
    [[nodiscard]] double second() const { return (aa * b - ab * a) / determinant(); }
};

}  // namespace

void CubicFitter::choose_samples(std::size_t first, std::size_t last, double length) {
    const std::size_t begin = first * kSamplesPerPiece;
    const std::size_t end = last * kSamplesPerPiece;
    const std::size_t stride = (end - begin + kMostSamples - 1) / kMostSamples;
    samples_.clear();
    t_.clear();
    for (std::size_t i = begin + stride; i < end; i += stride) {
        samples_.push_back(chain_.samples[i]);
        t_.push_back(chain_.length(begin, i) / length);
    }
}

void CubicFitter::by_least_squares(Frame& frame) const {
    TwoUnknowns equations;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        const double t = t_[i];
        const double s = 1 - t;
        const double b1 = 3 * t * s * s;
        const double b2 = 3 * t * t * s;
        const PlaneVector rest =
            samples_[i] - ((s * s * s + b1) * frame.start + (b2 + t * t * t) * frame.end);
        const PlaneVector leave = b1 * frame.from;
        const PlaneVector arrive = -b2 * frame.to;
        equations.add(leave.x, arrive.x, rest.x);
        equations.add(leave.y, arrive.y, rest.y);
    }
    if (!(equations.determinant() > 1e-12 * equations.aa * equations.bb)) return;
    const double leave = equations.first();
    const double arrive = equations.second();
    const double least = kShortest * frame.length;
    const double most = kLongest * frame.length;
    if (leave > least && arrive > least && leave < most && arrive < most) {
        frame.leave = leave;
        frame.arrive = arrive;
    }
}

double CubicFitter::by_tangent_distance(Frame& frame) {
    const PlanePolynomial cubic(frame.cubic());
    TwoUnknowns equations;
    double worst2 = 0;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        t_[i] = cubic.nearest(samples_[i], t_[i], 0, 1, 1);
        const double t = t_[i];
        const double s = 1 - t;
        const PlaneVector along = unit(cubic.slope(t));
        const PlaneVector normal{-along.y, along.x};
        const PlaneVector off = samples_[i] - cubic.value(t);
        worst2 = std::max(worst2, squared(off));
        equations.add(3 * t * s * s * dot(frame.from, normal),
                      -3 * t * t * s * dot(frame.to, normal),
                      dot(off, normal));
    }
    const double damping = kDamping * (equations.aa + equations.bb);
    equations.aa += damping;
    equations.bb += damping;
    if (equations.determinant() > 0) {
        const double least = kShortest * frame.length;
        const double most = kLongest * frame.length;
        frame.leave = std::clamp(frame.leave + equations.first(), least, most);
        frame.arrive = std::clamp(frame.arrive + equations.second(), least, most);
    }
    return worst2;
}

std::optional<PlaneCubic> CubicFitter::fit(std::size_t first, std::size_t last) {
    assert(first < last && last <= chain_.pieces.size());
    const double length =
        chain_.length(first * kSamplesPerPiece, last * kSamplesPerPiece);
    Frame frame{chain_.pieces[first][0],
                chain_.leaving[first],
                chain_.arriving[last - 1],
                chain_.pieces[last - 1][3],
                length,
                length / 3,
                length / 3};
    if (!(length > 0)) return frame.cubic();
    choose_samples(first, last, length);
    by_least_squares(frame);
    double last2 = std::numeric_limits<double>::infinity();
    for (int step = 1; step <= kMostSteps; ++step) {
        const PlaneCubic before = frame.cubic();
        const double worst2 = by_tangent_distance(frame);
        // Parameters by chord length say little about distances.
        if (step == 1) continue;
        if (worst2 < kWell * tolerance2_) return before;
        const bool falling = worst2 < kFalling * last2;
        last2 = worst2;
        if (!falling && step > kFewSteps) break;
    }
    // The last step may have been enough.
    if (last2 < kNear * tolerance2_) return frame.cubic();
    return std::nullopt;
}

}  // namespace haarmony::curve
