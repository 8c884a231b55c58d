#include "engine/image/logit.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace haarmony::image {
namespace {

// A symmetric positive definite matrix, later its Cholesky factor, row-major; only the
// lower triangle is used.
class Cholesky {
  public:
    explicit Cholesky(std::size_t size) : size_(size), cells_(size * size, 0.0) {}

    double& at(std::size_t i, std::size_t j) { return cells_[i * size_ + j]; }

    void factorize() {
        for (std::size_t j = 0; j < size_; ++j) {
            for (std::size_t i = j; i < size_; ++i) {
                double sum = at(i, j);
                for (std::size_t k = 0; k < j; ++k) sum -= at(i, k) * at(j, k);
                if (i == j) {
                    assert(sum > 0);
                    at(j, j) = std::sqrt(sum);
                } else {
                    at(i, j) = sum / at(j, j);
                }
            }
        }
    }

    // Requires: factorize() was called.
    [[nodiscard]] std::vector<double> solve(std::vector<double> right) {
        for (std::size_t i = 0; i < size_; ++i) {
            for (std::size_t k = 0; k < i; ++k) right[i] -= at(i, k) * right[k];
            right[i] /= at(i, i);
        }
        for (std::size_t i = size_; i-- > 0;) {
            for (std::size_t k = i + 1; k < size_; ++k) right[i] -= at(k, i) * right[k];
            right[i] /= at(i, i);
        }
        return right;
    }

  private:
    std::size_t size_;
    std::vector<double> cells_;
};

// log F(x) without overflow.
double log_logistic(double x) {
    return x >= 0 ? -std::log1p(std::exp(-x)) : x - std::log1p(std::exp(x));
}

double null_log_likelihood(const LogitRows& rows) {
    const auto matches =
        static_cast<double>(std::ranges::count(rows.outcomes, std::uint8_t{1}));
    const double mismatches = static_cast<double>(rows.size()) - matches;
    const auto all = static_cast<double>(rows.size());
    return matches * std::log(matches / all) + mismatches * std::log(mismatches / all);
}

// The unknowns are the intercept (0) and the weights (1 and on): one vector.
class Problem {
  public:
    Problem(const LogitRows& rows, const LogitOptions& options)
        : rows_(rows),
          ridge_(options.ridge),
          direction_(options.direction),
          lower_(options.lower) {
        const auto features = std::size_t(rows.features);
        if (direction_.empty()) direction_.assign(features, 0.0);
        if (lower_.empty()) {
            lower_.assign(features, -std::numeric_limits<double>::infinity());
        }
        assert(direction_.size() == features && lower_.size() == features);
        assert(rows.values.size() == rows.size() * features);
        const double length = std::sqrt(std::inner_product(
            direction_.begin(), direction_.end(), direction_.begin(), 0.0));
        assert(length > 0 || options.direction.empty());
        if (length > 0) {
            for (double& part : direction_) part /= length;
        }
    }

    [[nodiscard]] std::size_t unknowns() const { return lower_.size() + 1; }

    [[nodiscard]] std::vector<double> start() const {
        const auto matches =
            static_cast<double>(std::ranges::count(rows_.outcomes, std::uint8_t{1}));
        const double mismatches = static_cast<double>(rows_.size()) - matches;
        assert(matches > 0 && mismatches > 0);
        std::vector<double> x{std::log(matches / mismatches)};
        x.resize(unknowns(), 0.0);
        return projected(std::move(x));
    }

    [[nodiscard]] std::vector<double> projected(std::vector<double> x) const {
        for (std::size_t k = 0; k < lower_.size(); ++k) {
            x[k + 1] = std::max(x[k + 1], lower_[k]);
        }
        return x;
    }

    [[nodiscard]] double log_likelihood(const std::vector<double>& x) const {
        double sum = 0;
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            const double eta = linear(x, i);
            sum += log_logistic(rows_.outcomes[i] != 0 ? eta : -eta);
        }
        return sum;
    }

    [[nodiscard]] double objective(const std::vector<double>& x) const {
        double squares = 0;
        for (std::size_t k = 1; k < x.size(); ++k) squares += x[k] * x[k];
        return log_likelihood(x) -
               ridge_ / 2 * (squares - kAlongFree * along(x) * along(x));
    }

    // The gradient of the objective, and its negative second derivative.
    void differentiate(const std::vector<double>& x,
                       std::vector<double>& gradient,
                       Cholesky& curvature) const {
        const std::size_t n = unknowns();
        gradient.assign(n, 0.0);
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            const std::span<const double> row = rows_.row(i);
            const double p = logistic(linear(x, i));
            const double residual = (rows_.outcomes[i] != 0 ? 1.0 : 0.0) - p;
            const double weight = p * (1 - p);
            gradient[0] += residual;
            curvature.at(0, 0) += weight;
            for (std::size_t k = 1; k < n; ++k) {
                if (row[k - 1] == 0) continue;
                gradient[k] += residual * row[k - 1];
                const double weighted = weight * row[k - 1];
                curvature.at(k, 0) += weighted;
                for (std::size_t j = 1; j <= k; ++j) {
                    curvature.at(k, j) += weighted * row[j - 1];
                }
            }
        }
        const double free = kAlongFree * along(x);
        for (std::size_t k = 1; k < n; ++k) {
            gradient[k] -= ridge_ * (x[k] - free * direction_[k - 1]);
            curvature.at(k, k) += ridge_;
            for (std::size_t j = 1; j <= k; ++j) {
                curvature.at(k, j) -=
                    ridge_ * kAlongFree * direction_[k - 1] * direction_[j - 1];
            }
        }
        // Far from the optimum every p may be 0 or 1, which would leave nothing here. It
        // only shortens the step: the optimum is where the gradient is zero.
        curvature.at(0, 0) += kLeastCurvature;
    }

    // At its bound, and the objective would grow beyond it.
    [[nodiscard]] std::vector<bool> held(const std::vector<double>& x,
                                         const std::vector<double>& gradient) const {
        std::vector<bool> result(unknowns(), false);
        for (std::size_t k = 1; k < unknowns(); ++k) {
            result[k] = x[k] <= lower_[k - 1] && gradient[k] <= 0;
        }
        return result;
    }

  private:
    static constexpr double kLeastCurvature = 1e-9;
    static constexpr double kAlongFree = 1 - kRidgeAlong;

    [[nodiscard]] double along(const std::vector<double>& x) const {
        return std::inner_product(
            direction_.begin(), direction_.end(), x.begin() + 1, 0.0);
    }

    [[nodiscard]] double linear(const std::vector<double>& x, std::size_t i) const {
        const std::span<const double> row = rows_.row(i);
        return std::inner_product(row.begin(), row.end(), x.begin() + 1, x[0]);
    }

    const LogitRows& rows_;
    double ridge_;
    std::vector<double> direction_;  // of length 1, or 0 where there is none
    std::vector<double> lower_;
};

// Takes the unknowns that are held out of the system: their step is zero.
void hold(const std::vector<bool>& held,
          std::vector<double>& gradient,
          Cholesky& curvature) {
    for (std::size_t i = 0; i < held.size(); ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            if (held[i] || held[j]) curvature.at(i, j) = i == j ? 1.0 : 0.0;
        }
        if (held[i]) gradient[i] = 0;
    }
}

// The point that a step leads to, halved until the objective does not fall by more than
// its rounding.
std::vector<double> advance(const Problem& problem,
                            const std::vector<double>& x,
                            const std::vector<double>& step) {
    constexpr int kHalvings = 60;
    constexpr double kRounding = 1e-12;
    const double before = problem.objective(x);
    const double enough = before - kRounding * (1 + std::abs(before));
    double share = 1;
    for (int i = 0; i < kHalvings; ++i, share /= 2) {
        std::vector<double> next = x;
        for (std::size_t k = 0; k < x.size(); ++k) next[k] += share * step[k];
        next = problem.projected(std::move(next));
        if (problem.objective(next) >= enough) return next;
    }
    return x;
}

}  // namespace

double logistic(double x) {
    if (x >= 0) return 1 / (1 + std::exp(-x));
    const double e = std::exp(x);
    return e / (1 + e);
}

LogitFit fit_logit(const LogitRows& rows, const LogitOptions& options) {
    assert(options.ridge > 0 && options.max_iterations >= 1);
    // What a whole further step could still gain, as a part of the objective.
    constexpr double kGain = 1e-16;
    const Problem problem(rows, options);
    const std::size_t n = problem.unknowns();

    LogitFit fit;
    fit.null_log_likelihood = null_log_likelihood(rows);
    std::vector<double> x = problem.start();
    std::vector<double> gradient;
    std::vector<bool> held(n, false);
    for (;;) {
        Cholesky curvature(n);
        problem.differentiate(x, gradient, curvature);
        held = problem.held(x, gradient);
        hold(held, gradient, curvature);
        curvature.factorize();
        const std::vector<double> step = curvature.solve(gradient);
        const double gain =
            std::inner_product(step.begin(), step.end(), gradient.begin(), 0.0) / 2;
        fit.converged = gain <= kGain * (1 + std::abs(problem.objective(x)));
        if (fit.converged || fit.iterations == options.max_iterations) {
            for (std::size_t k = 1; k < n; ++k) {
                std::vector<double> unit(n, 0.0);
                unit[k] = 1;
                const double variance = curvature.solve(std::move(unit))[k];
                fit.standard_errors.push_back(held[k] ? 0.0 : std::sqrt(variance));
            }
            break;
        }
        ++fit.iterations;
        x = advance(problem, x, step);
    }
    fit.intercept = x[0];
    fit.weights.assign(x.begin() + 1, x.end());
    fit.at_bound.assign(held.begin() + 1, held.end());
    fit.log_likelihood = problem.log_likelihood(x);
    return fit;
}

}  // namespace haarmony::image
