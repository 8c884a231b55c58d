#include "engine/image/training.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <utility>

#include "engine/image/logit.h"
#include "engine/image/query.h"
#include "engine/image/random_order.h"
#include "engine/image/symmetric_metric.h"

namespace haarmony::image {
namespace {

constexpr int kFeatures = kChannels * kBins;
constexpr double kWeightOne = 100;  // stored weights are in 1/100

Error invalid(std::string message, std::string param) {
    return {ErrorCode::kInvalidArgument, std::move(message), std::move(param)};
}

bool has_coefficients(const Signature& signature) {
    return std::ranges::any_of(signature.channels,
                               [](const ChannelSignature& c) { return c.count > 0; });
}

double coefficient_sum(const RealWeights& weights) {
    double sum = 0;
    for (const auto& channel : weights) {
        sum = std::accumulate(channel.begin() + 1, channel.end(), sum);
    }
    return sum;
}

RealWeights real(const Weights& weights) {
    RealWeights result{};
    for (int c = 0; c < kChannels; ++c) {
        for (int b = 0; b < kBins; ++b) result[c][b] = weights[c][b] / kWeightOne;
    }
    return result;
}

std::optional<Error> why_not(std::span<const TrainingPair> pairs,
                             std::span<const Signature> mismatches,
                             const Profile& base,
                             const TrainingOptions& options) {
    if (options.mismatches_per_query < 1) {
        return invalid(
            "mismatches per query: " + std::to_string(options.mismatches_per_query) +
                " is less than 1",
            "mismatches_per_query");
    }
    if (!(options.held_back_share >= 0.1 && options.held_back_share <= 0.9)) {
        return invalid("held-back share: " + std::to_string(options.held_back_share) +
                           " is outside 0.1 to 0.9",
                       "held_back_share");
    }
    if (!(options.ridge > 0 && std::isfinite(options.ridge))) {
        return invalid("ridge: " + std::to_string(options.ridge) + " is not above 0",
                       "ridge");
    }
    if (coefficient_sum(real(base.weights)) == 0) {
        return invalid("profile " + base.name + " weighs no coefficient", "base");
    }
    if (pairs.size() < std::size_t{kMinTrainingPairs}) {
        return invalid(std::to_string(pairs.size()) + " pairs: at least " +
                           std::to_string(kMinTrainingPairs) + " are needed",
                       "pairs");
    }
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const std::string pair = "pair " + std::to_string(i + 1);
        for (const Signature* signature : {&pairs[i].query, &pairs[i].target}) {
            if (signature->kind == base.kind) continue;
            return invalid(pair + " is " + kind_name(signature->kind) + ", the profile " +
                               kind_name(base.kind),
                           "pairs");
        }
        if (pairs[i].query.low_information || !has_coefficients(pairs[i].query)) {
            return invalid(pair + ": the query has no information", "pairs");
        }
    }
    if (mismatches.empty()) return invalid("no mismatches", "mismatches");
    for (std::size_t i = 0; i < mismatches.size(); ++i) {
        if (mismatches[i].kind == base.kind) continue;
        return invalid("mismatch " + std::to_string(i + 1) + " is " +
                           kind_name(mismatches[i].kind) + ", the profile " +
                           kind_name(base.kind),
                       "mismatches");
    }
    return std::nullopt;
}

struct Rows {
    std::vector<RealWeights> features;
    std::vector<std::uint8_t> outcomes;

    void add(const RealWeights& row, bool match) {
        features.push_back(row);
        outcomes.push_back(match ? 1 : 0);
    }
};

Rows rows_of(std::span<const TrainingPair* const> pairs,
             std::span<const Signature> mismatches,
             const Profile& base,
             int mismatches_per_query,
             std::mt19937_64& random) {
    Rows rows;
    std::vector<const Signature*> others;
    others.reserve(mismatches.size());
    for (const Signature& signature : mismatches) others.push_back(&signature);
    for (const TrainingPair* pair : pairs) {
        rows.add(training_features(pair->query, pair->target, base), true);
        int drawn = 0;
        for (std::size_t i = 0; i < others.size() && drawn < mismatches_per_query; ++i) {
            draw_to_front(random, std::span(others).subspan(i), 1);
            if (*others[i] == pair->target) continue;
            rows.add(training_features(pair->query, *others[i], base), false);
            ++drawn;
        }
    }
    return rows;
}

double dot(const RealWeights& weights, const RealWeights& features) {
    double sum = 0;
    for (int c = 0; c < kChannels; ++c) {
        sum = std::inner_product(
            weights[c].begin(), weights[c].end(), features[c].begin(), sum);
    }
    return sum;
}

// How much the log of the odds falls with one unit of the base's distance: the model of
// one feature, whose spread is made 1 so that the ridge means the same for every profile.
double slope_of_distance(const Rows& rows, const RealWeights& base, double ridge) {
    std::vector<double> distances;
    double mean = 0;
    for (const RealWeights& row : rows.features) {
        distances.push_back(dot(base, row));
        mean += distances.back() / static_cast<double>(rows.features.size());
    }
    double variance = 0;
    for (const double distance : distances) {
        variance +=
            (distance - mean) * (distance - mean) / static_cast<double>(distances.size());
    }
    const double spread = variance > 0 ? std::sqrt(variance) : 1.0;
    LogitRows logit{1, {}, rows.outcomes};
    for (const double distance : distances) logit.values.push_back(-distance / spread);
    // Where the base ranks no better than chance, the model must still start somewhere.
    constexpr double kLeastSlope = 0.01;
    const LogitFit fit =
        fit_logit(logit, {.ridge = ridge * kRidgeAlong, .lower = {kLeastSlope}});
    return fit.weights[0] / spread;
}

// The model in multiples of the base: what has the base's own weight is 1.
struct Multiples {
    LogitRows rows;
    RealWeights units{};  // a weight is its multiple times its unit
    LogitOptions options;
};

Multiples multiples_of(const Rows& rows, const Profile& base, double ridge) {
    // A bin without weight in the base has no multiples; a tenth of the mean weight is
    // little enough to stay at nothing without evidence, and enough to rise with it.
    const RealWeights weights = real(base.weights);
    const double least = coefficient_sum(weights) / (kChannels * (kBins - 1)) / 10;
    const double slope = slope_of_distance(rows, weights, ridge);

    Multiples model;
    model.rows = {kFeatures, {}, rows.outcomes};
    model.options.ridge = ridge;
    for (int c = 0; c < kChannels; ++c) {
        for (int b = 0; b < kBins; ++b) {
            const double unit = std::max(weights[c][b], least);
            model.units[c][b] = slope * unit;
            model.options.direction.push_back(weights[c][b] / unit);
        }
    }
    model.rows.values.reserve(rows.features.size() * std::size_t{kFeatures});
    for (const RealWeights& row : rows.features) {
        for (int c = 0; c < kChannels; ++c) {
            for (int b = 0; b < kBins; ++b) {
                model.rows.values.push_back(-row[c][b] * model.units[c][b]);
            }
        }
    }
    return model;
}

RealWeights weights_of(const LogitFit& fit, const RealWeights& units, double factor) {
    RealWeights weights{};
    for (int c = 0; c < kChannels; ++c) {
        for (int b = 0; b < kBins; ++b) {
            weights[c][b] = fit.weights[c * kBins + b] * units[c][b] * factor;
        }
    }
    return weights;
}

Weights rounded(const RealWeights& weights) {
    Weights result{};
    for (int c = 0; c < kChannels; ++c) {
        for (int b = 0; b < kBins; ++b) {
            const double stored =
                std::min(std::round(weights[c][b] * kWeightOne), double{kMaxWeight});
            result[c][b] = static_cast<std::int32_t>(stored);
        }
    }
    return result;
}

// The rank of each target among the mismatches, ties against it.
class Ranking {
  public:
    Ranking(std::span<const TrainingPair* const> pairs,
            std::span<const Signature> mismatches,
            const Profile& profile)
        : pairs_(pairs), mismatches_(mismatches) {
        for (std::size_t begin = 0; begin < mismatches.size(); begin += kMaxSlots) {
            const std::size_t count =
                std::min(mismatches.size() - begin, std::size_t{kMaxSlots});
            std::vector<const Signature*> block;
            for (const Signature& signature : mismatches.subspan(begin, count)) {
                block.push_back(&signature);
            }
            blocks_.emplace_back(block, profile);
        }
    }

    // Requires: the profile has the m of the constructor's.
    [[nodiscard]] std::vector<std::int64_t> ranks(const Profile& profile) const {
        std::vector<std::int64_t> result;
        for (const TrainingPair* pair : pairs_) result.push_back(rank(*pair, profile));
        return result;
    }

  private:
    [[nodiscard]] std::int64_t rank(const TrainingPair& pair,
                                    const Profile& profile) const {
        const Query query = make_query(pair.query, profile, profile.m);
        const Signature* target = &pair.target;
        Score to_target = 0;
        SignatureBlock({&target, 1}, profile).score(query, {&to_target, 1});
        std::int64_t rank = 1;
        std::size_t begin = 0;
        std::vector<Score> scores;
        for (const SignatureBlock& block : blocks_) {
            scores.resize(std::size_t(block.size()));
            block.score(query, scores);
            for (std::size_t i = 0; i < scores.size(); ++i) {
                if (scores[i] <= to_target && mismatches_[begin + i] != pair.target) {
                    ++rank;
                }
            }
            begin += scores.size();
        }
        return rank;
    }

    std::span<const TrainingPair* const> pairs_;
    std::span<const Signature> mismatches_;
    std::vector<SignatureBlock> blocks_;
};

HeldBackRanks rank_held_back(std::span<const TrainingPair* const> pairs,
                             std::span<const Signature> mismatches,
                             const Profile& base,
                             const Profile& fitted) {
    const Ranking ranking(pairs, mismatches, base);
    HeldBackRanks held_back;
    held_back.candidates = std::int64_t(mismatches.size()) + 1;
    held_back.before = ranking.ranks(base);
    held_back.after = ranking.ranks(fitted);
    held_back.before_summary = summarize(held_back.before, held_back.candidates);
    held_back.after_summary = summarize(held_back.after, held_back.candidates);
    return held_back;
}

}  // namespace

RealWeights training_features(const Signature& query,
                              const Signature& target,
                              const Profile& profile) {
    RealWeights features{};
    for (int c = 0; c < kChannels; ++c) {
        const ChannelSignature& from = query.channels[c];
        const ChannelSignature& to = target.channels[c];
        const std::int64_t difference = std::int64_t{from.average} - to.average;
        features[c][0] = static_cast<double>(std::abs(difference)) / double{kAverageOne};
        std::array<std::int16_t, kMaxCoefficients> sorted;
        const std::span<const std::int16_t> cut = to.largest(profile.m);
        const auto end = std::ranges::copy(cut, sorted.begin()).out;
        std::sort(sorted.begin(), end);
        for (const std::int16_t signed_index : from.largest(profile.m)) {
            if (std::binary_search(sorted.begin(), end, signed_index)) continue;
            const int index = std::abs(int{signed_index});
            features[c][bin(profile.bin_rule, index / kSide, index % kSide)] += 1;
        }
    }
    return features;
}

Result<TrainingReport> train(std::span<const TrainingPair> pairs,
                             std::span<const Signature> mismatches,
                             const Profile& base,
                             const TrainingOptions& options) {
    if (std::optional<Error> error = why_not(pairs, mismatches, base, options)) {
        return *std::move(error);
    }
    std::mt19937_64 random(options.seed);
    std::vector<const TrainingPair*> order;
    for (const TrainingPair& pair : pairs) order.push_back(&pair);
    const auto held_back = static_cast<std::size_t>(
        std::lround(options.held_back_share * static_cast<double>(pairs.size())));
    draw_to_front(random, std::span(order), held_back);
    // The draw has lost the order of the pairs, in which ranks are reported.
    std::ranges::sort(order.begin(), order.begin() + std::ptrdiff_t(held_back));
    const auto tested = std::span<const TrainingPair* const>(order).first(held_back);
    const auto learned = std::span<const TrainingPair* const>(order).subspan(held_back);

    const Rows rows =
        rows_of(learned, mismatches, base, options.mismatches_per_query, random);
    if (rows.outcomes.size() == learned.size()) {
        return invalid("no mismatches: each is the target of every pair", "mismatches");
    }
    Multiples model = multiples_of(rows, base, options.ridge);
    const LogitFit raw = fit_logit(model.rows, model.options);
    model.options.lower.assign(kFeatures, 0.0);
    const LogitFit fit = fit_logit(model.rows, model.options);

    const double sum = coefficient_sum(weights_of(fit, model.units, 1.0));
    if (sum == 0) {
        return invalid("the pairs leave no coefficient a weight above 0", "pairs");
    }
    const double factor = coefficient_sum(real(base.weights)) / sum;

    TrainingReport report;
    report.fitted_pairs = static_cast<int>(learned.size());
    report.mismatches = static_cast<int>(rows.outcomes.size() - learned.size());
    report.raw = weights_of(raw, model.units, factor);
    report.fitted = weights_of(fit, model.units, factor);
    for (int i = 0; i < kFeatures; ++i) {
        report.clamped[i / kBins][i % kBins] = fit.at_bound[i];
    }
    report.log_likelihood = fit.log_likelihood;
    report.null_log_likelihood = fit.null_log_likelihood;
    report.iterations = fit.iterations;
    report.converged = fit.converged;
    report.profile = base;
    report.profile.weights = rounded(report.fitted);
    report.profile.calibration = Calibration{fit.intercept, 1 / factor};
    report.held_back = rank_held_back(tested, mismatches, base, report.profile);
    for (const TrainingPair* pair : tested) {
        report.held_back.pairs.push_back(std::size_t(pair - pairs.data()));
    }
    report.better =
        keeps_up(report.held_back.before_summary, report.held_back.after_summary);
    return report;
}

std::vector<std::int64_t> target_ranks(std::span<const TrainingPair> pairs,
                                       std::span<const Signature> mismatches,
                                       const Profile& profile) {
    std::vector<const TrainingPair*> all;
    for (const TrainingPair& pair : pairs) all.push_back(&pair);
    return Ranking(all, mismatches, profile).ranks(profile);
}

bool keeps_up(const RankSummary& before, const RankSummary& after) {
    return after.mean_reciprocal_rank >= before.mean_reciprocal_rank &&
           after.top_20 >= before.top_20;
}

}  // namespace haarmony::image
