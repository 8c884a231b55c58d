#include "engine/curve/fit.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/curve/bspline.h"
#include "engine/curve/least_squares.h"

namespace haarmony::curve {
namespace {

// Rounds gain at most a factor of about 2 to 3 in the largest error of drawn strokes; where
// the tolerance is further off, the next level is tried at once.
constexpr double kWithinReach = 4;

// A round that gains less is the last one.
constexpr double kWorthwhile = 0.99;

// Samples moved to the middle of their box and divided by half its size (x and y by one), so
// that neither size nor place of a stroke costs digits or overflows.
struct Box {
    std::array<double, kMostDimensions> middle{};
    std::array<double, kMostDimensions> half{};

    explicit Box(const Points& samples) {
        const std::size_t dimension = std::size_t(samples.dimension());
        for (std::size_t axis = 0; axis < dimension; ++axis) {
            double low = samples[0][axis];
            double high = low;
            for (std::size_t i = 1; i < samples.size(); ++i) {
                low = std::min(low, samples[i][axis]);
                high = std::max(high, samples[i][axis]);
            }
            middle[axis] = low / 2 + high / 2;
            half[axis] = high / 2 - low / 2;
        }
        if (dimension > 1) half[0] = half[1] = std::max(half[0], half[1]);
        for (double& size : half) {
            // Also where the numbers differ by less than can be divided by.
            if (size < 1e-300) size = 1;
        }
    }
    [[nodiscard]] Points inside(const Points& samples) const {
        Points moved = samples;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            for (std::size_t axis = 0; axis < moved[i].size(); ++axis)
                moved[i][axis] = (moved[i][axis] - middle[axis]) / half[axis];
        }
        return moved;
    }
    [[nodiscard]] Points outside(const Points& control) const {
        Points moved = control;
        for (std::size_t i = 0; i < control.size(); ++i) {
            for (std::size_t axis = 0; axis < moved[i].size(); ++axis)
                moved[i][axis] = moved[i][axis] * half[axis] + middle[axis];
        }
        return moved;
    }
};

std::size_t plane_axes(const Points& points) {
    return std::min<std::size_t>(2, std::size_t(points.dimension()));
}

std::vector<double> spaced(const Points& samples, Ends ends, Spacing spacing) {
    const std::size_t count = samples.size();
    const std::size_t axes = plane_axes(samples);
    const auto chord = [&](std::size_t from, std::size_t to) {
        double square = 0;
        for (std::size_t axis = 0; axis < axes; ++axis) {
            const double d = samples[to][axis] - samples[from][axis];
            square += d * d;
        }
        const double length = std::sqrt(square);
        return spacing == Spacing::kCentripetal ? std::sqrt(length) : length;
    };
    std::vector<double> parameters(count);
    for (std::size_t i = 1; i < count; ++i)
        parameters[i] = parameters[i - 1] + chord(i - 1, i);
    const double total =
        parameters.back() + (ends == Ends::kClosed ? chord(count - 1, 0) : 0);
    for (std::size_t i = 0; i < count; ++i) {
        const double steps = double(ends == Ends::kClosed ? count : count - 1);
        parameters[i] = total > 0 ? parameters[i] / total : double(i) / steps;
    }
    return parameters;
}

// The fit of samples in a box, all in its units.
class Fitter {
  public:
    Fitter(const Points& samples, int level, const FitOptions& options)
        : samples_(samples), level_(level), options_(options) {}

    // Until the error is `enough`, and only as long as it is within `reach`.
    [[nodiscard]] CurveFit run(const std::vector<double>& parameters,
                               double enough,
                               double reach) const {
        std::vector<double> nearer;
        CurveFit best = solve(parameters, nearer);
        for (int round = 0; round < options_.rounds; ++round) {
            if (best.max_error <= enough || best.max_error > reach) break;
            CurveFit next = solve(std::vector<double>(nearer), nearer);
            const bool worthwhile = next.max_error < kWorthwhile * best.max_error;
            if (next.max_error < best.max_error) best = std::move(next);
            if (!worthwhile) break;
        }
        return best;
    }

  private:
    // `nearer` becomes parameters that are nearer to the samples.
    CurveFit solve(std::vector<double> parameters, std::vector<double>& nearer) const {
        LeastSquares squares(level_, options_.ends, samples_.dimension());
        std::vector<double> mean(std::size_t(samples_.dimension()));
        for (std::size_t i = 0; i < samples_.size();) {
            // A pen that rests gives many samples with one parameter.
            std::size_t end = i + 1;
            std::ranges::copy(samples_[i], mean.begin());
            for (; end < samples_.size() && parameters[end] == parameters[i]; ++end) {
                for (std::size_t axis = 0; axis < mean.size(); ++axis)
                    mean[axis] += samples_[end][axis];
            }
            for (double& number : mean) number /= double(end - i);
            squares.add(parameters[i], mean, double(end - i));
            i = end;
        }
        CurveFit result;
        result.level = level_;
        const bool pinned = options_.pin_ends && options_.ends == Ends::kOpen;
        using Row = std::span<const double>;
        result.control = squares.solve(pinned ? samples_[0] : Row{},
                                       pinned ? samples_[samples_.size() - 1] : Row{});
        nearer.resize(parameters.size());
        double sum = 0;
        double worst = 0;
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            const auto [square, step] = error_and_step(result.control, parameters[i], i);
            sum += square;
            worst = std::max(worst, square);
            nearer[i] = moved(parameters, i, step);
        }
        result.max_error = std::sqrt(worst);
        result.rms_error = std::sqrt(sum / double(samples_.size()));
        result.parameters = std::move(parameters);
        return result;
    }

    // The squared distance of sample i, and Newton's step towards the nearest parameter.
    std::pair<double, double> error_and_step(const Points& control,
                                             double u,
                                             std::size_t i) const {
        const BasisAt basis = basis_at(level_, options_.ends, u);
        // x and y of the curve, its derivative and its second one.
        std::array<double, 2> value{};
        std::array<double, 2> slope{};
        std::array<double, 2> second{};
        const std::size_t axes = plane_axes(samples_);
        const std::size_t count = control_count(level_, options_.ends);
        for (std::size_t k = 0; k < 4; ++k) {
            std::size_t row = basis.first + k;
            while (row >= count) row -= count;
            const std::span<const double> point = control[row];
            for (std::size_t axis = 0; axis < axes; ++axis) {
                value[axis] += basis.value[k] * point[axis];
                slope[axis] += basis.slope[k] * point[axis];
                second[axis] += basis.bend[k] * point[axis];
            }
        }
        double square = 0;
        double along = 0;
        double speed = 0;
        double bend = 0;
        for (std::size_t axis = 0; axis < axes; ++axis) {
            const double off = samples_[i][axis] - value[axis];
            square += off * off;
            along += off * slope[axis];
            speed += slope[axis] * slope[axis];
            bend += off * second[axis];
        }
        // Where the sample is beyond the centre of curvature, Newton would go the wrong way.
        const double curvature = std::max(speed - bend, speed / 4);
        return {square, curvature > 0 ? along / curvature : 0.0};
    }

    // Not beyond the middles between neighbours, so that the order stays; the ends stay.
    double moved(const std::vector<double>& parameters,
                 std::size_t i,
                 double step) const {
        const double u = parameters[i];
        if (i == 0) return u;
        const bool last = i + 1 == parameters.size();
        if (last && options_.ends == Ends::kOpen) return u;
        const double low = (parameters[i - 1] + u) / 2;
        const double high = ((last ? 1.0 : parameters[i + 1]) + u) / 2;
        return std::clamp(u + step, low, high);
    }

    const Points& samples_;
    int level_;
    const FitOptions& options_;
};

// One stroke, to be fitted at several levels.
class Stroke {
  public:
    Stroke(const Points& samples, const FitOptions& options)
        : samples_(samples),
          options_(options),
          box_(samples),
          boxed_(box_.inside(samples)) {
        assert(samples.size() >= 2);
        assert(options.parameters.empty() || options.parameters.size() == samples.size());
        if (options.parameters.empty())
            parameters_ = spaced(boxed_, options.ends, options.spacing);
        else
            parameters_.assign(options.parameters.begin(), options.parameters.end());
    }

    // `enough` and `reach` are errors in the units of the samples.
    [[nodiscard]] CurveFit at(int level, double enough, double reach) const {
        const double scale = box_.half[0];
        CurveFit result = Fitter(boxed_, level, options_)
                              .run(parameters_, enough / scale, reach / scale);
        result.control = box_.outside(result.control);
        if (options_.pin_ends && options_.ends == Ends::kOpen) {
            // Exactly, not to rounding: pieces that meet share these points.
            std::ranges::copy(samples_[0], result.control[0].begin());
            std::ranges::copy(samples_[samples_.size() - 1],
                              result.control[result.control.size() - 1].begin());
        }
        result.max_error *= scale;
        result.rms_error *= scale;
        return result;
    }

  private:
    const Points& samples_;
    const FitOptions& options_;
    Box box_;
    Points boxed_;
    std::vector<double> parameters_;
};

}  // namespace

std::vector<double> stroke_parameters(const Points& samples, Ends ends, Spacing spacing) {
    return spaced(Box(samples).inside(samples), ends, spacing);
}

CurveFit fit(const Points& samples, int level, const FitOptions& options) {
    assert(level >= 0 && level <= kMostLevel);
    return Stroke(samples, options).at(level, 0, std::numeric_limits<double>::infinity());
}

CurveFit fit_within(const Points& samples, double tolerance, const FitOptions& options) {
    assert(tolerance >= 0);
    const Stroke stroke(samples, options);
    int level = options.ends == Ends::kClosed ? kLeastClosedFitLevel : 0;
    CurveFit result = stroke.at(level, tolerance, kWithinReach * tolerance);
    while (result.max_error > tolerance && level < kMostFitLevel)
        result = stroke.at(++level, tolerance, kWithinReach * tolerance);
    return result;
}

}  // namespace haarmony::curve
