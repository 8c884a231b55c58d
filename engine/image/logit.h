// The logit model: which weights make a sum of features tell matches from mismatches
// (from pairs to a profile: [logit.h] -> training.h -> profile.h).
//
// P(match) = F(intercept + sum of weights[k] * feature[k]), F(x) = 1 / (1 + e^-x), fitted by
// iteratively reweighted least squares: Newton steps on the log-likelihood less the ridge,
// ridge / 2 * (|across|^2 + kRidgeAlong * |along|^2), where `along` is the part of the
// weights along `direction` and `across` the rest. The intercept is not held back.
//
// Units   those of the features; scale them before, the ridge treats all alike.
// Errors  none; a wrong shape is a caller's bug and asserts.
// Source  sec. 4.3.3; the ridge is ours: it keeps the weights finite where a feature tells
//         matches from mismatches perfectly, is always zero, or repeats another one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace haarmony::image {

struct LogitRows {
    int features = 0;
    std::vector<double> values;          // row after row, `features` each
    std::vector<std::uint8_t> outcomes;  // 1 for a match, 0 for a mismatch

    [[nodiscard]] std::size_t size() const { return outcomes.size(); }
    [[nodiscard]] std::span<const double> row(std::size_t i) const {
        return std::span(values).subspan(i * std::size_t(features),
                                         std::size_t(features));
    }
};

// Just enough to keep the weights finite where the direction alone separates the outcomes.
inline constexpr double kRidgeAlong = 1e-3;

struct LogitOptions {
    double ridge = 1;                    // above 0
    std::vector<double> direction = {};  // of any length but 0; empty: there is none
    std::vector<double> lower = {};      // no weight falls below; empty: no bounds
    int max_iterations = 100;
};

struct LogitFit {
    double intercept = 0;
    std::vector<double> weights;
    std::vector<double> standard_errors;  // of the weights; 0 for those at their bound
    std::vector<bool> at_bound;           // would fall below `lower` if they could
    double log_likelihood = 0;            // without the ridge
    double null_log_likelihood = 0;       // of the best model without features
    int iterations = 0;
    bool converged = false;
};

// 1 / (1 + e^-x), for any x.
[[nodiscard]] double logistic(double x);

// The one optimum (the problem is strictly concave), within rounding, where `converged`.
// Requires: at least one match and one mismatch. Cost per iteration: rows x features^2.
[[nodiscard]] LogitFit fit_logit(const LogitRows& rows, const LogitOptions& options);

}  // namespace haarmony::image
