// From pairs of a query and what was meant by it to the weights of a profile:
//   signature.h, profile.h -> logit.h -> [training.h] -> profile.h
//
// A pair and the mismatches drawn for its query are rows of the logit model with 18 features
// t_k: per channel the difference of the averages and, per bin, how many of the query's
// coefficients the target lacks. The weights of the metric are the falling slopes, >= 0.
// Few pairs cannot tell 18 weights: the ridge draws all of them to a common multiple of the
// base profile's. What the pairs say nothing about keeps its share.
//
// Scale   the stored coefficient weights (bins 1 to 5 of all channels) add up to what the
//         base's do, up to the rounding to 1/100 each.
// Errors  kInvalidArgument, with what is wrong with which pair or option.
// Source  sec. 4.3.3, 4.5.1; 100 mismatches a query as there (85 matches, 8500 mismatches).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/image/profile.h"
#include "engine/image/rank_summary.h"
#include "engine/image/signature.h"

namespace haarmony::image {

// With fewer, the half that is held back could not show a difference of one rank in ten.
inline constexpr int kMinTrainingPairs = 20;

struct TrainingPair {
    Signature query;
    Signature target;
};

struct TrainingOptions {
    int mismatches_per_query = 100;  // >= 1; all where there are fewer
    double held_back_share = 0.5;    // of the pairs, 0.1 to 0.9
    std::uint64_t seed = 1;          // of the split and of the mismatches
    // Above 0: how strongly the base's proportions are kept. Measured on 85 + 85 simulated
    // painted queries to 900 photos, six splits each: up to 0.01 no held-back ranks were
    // worse than the base's, from 0.03 on some were.
    double ridge = 0.003;
};

using RealWeights = std::array<std::array<double, kBins>, kChannels>;

// Both over the same pairs and candidates.
struct HeldBackRanks {
    std::int64_t candidates = 0;       // mismatches and the target
    std::vector<std::size_t> pairs;    // which of the pairs, rising
    std::vector<std::int64_t> before;  // of the base; one for each of these
    std::vector<std::int64_t> after;
    RankSummary before_summary;
    RankSummary after_summary;
};

struct TrainingReport {
    Profile profile;  // the base with other weights and a calibration
    int fitted_pairs = 0;
    int mismatches = 0;    // rows of the fit
    RealWeights raw{};     // without bounds, in the unit of the profile's weights
    RealWeights fitted{};  // >= 0, before rounding
    std::array<std::array<bool, kBins>, kChannels> clamped{};  // 0: would be negative
    double log_likelihood = 0;
    double null_log_likelihood = 0;  // of a model that knows only the share of matches
    int iterations = 0;
    bool converged = false;
    HeldBackRanks held_back;
    bool better = false;  // keeps_up() with the base on the pairs that were held back
};

// Fits on one part of the pairs, ranks with the other. Targets are ranked among the
// mismatches with ties against them; a mismatch with the target's very signature is none.
// The probability in the calibration is that of a pair drawn as the rows were: one match
// among `mismatches_per_query` mismatches.
[[nodiscard]] Result<TrainingReport> train(std::span<const TrainingPair> pairs,
                                           std::span<const Signature> mismatches,
                                           const Profile& base,
                                           const TrainingOptions& options);

// The rank of each pair's target under a profile, as held_back has them: to compare the
// fitted profile with one that is no base. Requires: all signatures of the profile's kind.
[[nodiscard]] std::vector<std::int64_t> target_ranks(
    std::span<const TrainingPair> pairs,
    std::span<const Signature> mismatches,
    const Profile& profile);

// Whether a profile with the ranks `after` may replace one with the ranks `before`: neither
// the mean reciprocal rank nor the share within the top 20 fell.
[[nodiscard]] bool keeps_up(const RankSummary& before, const RankSummary& after);

// The features t_k of one row, [channel][bin], both signatures cut at profile.m.
[[nodiscard]] RealWeights training_features(const Signature& query,
                                            const Signature& target,
                                            const Profile& profile);

}  // namespace haarmony::image
