#include "engine/image/training.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "engine/image/metric.h"
#include "engine/image/query.h"
#include "tests/engine/image/random_signatures.h"

namespace haarmony::image {
namespace {

constexpr SignatureShape kShape{.max_count = 60, .max_index = 400};

// Every weight 1: knows nothing.
Profile flat_profile() {
    Profile profile;
    profile.name = "flat";
    profile.m = 40;
    for (auto& channel : profile.weights) channel.fill(100);
    return profile;
}

// A query that has kept the share `kept` of its target's Y, and nothing of I and Q.
Signature memory_of(const Signature& target, double kept, std::mt19937& random) {
    Signature query = random_signature(random, kShape);
    query.channels[0] = target.channels[0];
    for (int i = 0; i < query.channels[0].count; ++i) {
        std::int16_t& index = query.channels[0].indices[i];
        // Indices beyond those of any target, so that none is there twice.
        if (static_cast<double>(random() % 1000) >= kept * 1000) {
            index = static_cast<std::int16_t>(500 + i);
        }
    }
    return query;
}

Signature some_signature(std::mt19937& random) {
    Signature signature;
    do signature = random_signature(random, kShape);
    while (signature.channels[0].count < 10);
    return signature;
}

struct Material {
    std::vector<TrainingPair> pairs;
    std::vector<Signature> mismatches;  // the targets among them
};

Material material(std::uint32_t seed, int pairs, int others, double kept) {
    std::mt19937 random(seed);
    Material result;
    for (int i = 0; i < pairs; ++i) {
        const Signature target = some_signature(random);
        result.pairs.push_back({memory_of(target, kept, random), target});
        result.mismatches.push_back(target);
    }
    for (int i = 0; i < others; ++i) result.mismatches.push_back(some_signature(random));
    return result;
}

double coefficient_sum(const Weights& weights) {
    double sum = 0;
    for (const auto& channel : weights) {
        for (int b = 1; b < kBins; ++b) sum += channel[b];
    }
    return sum;
}

// Ranks by equation (4.3) for every candidate.
std::vector<std::int64_t> literal_ranks(const Material& from,
                                        const std::vector<std::size_t>& pairs,
                                        const Profile& profile) {
    std::vector<std::int64_t> ranks;
    for (const std::size_t i : pairs) {
        const TrainingPair& pair = from.pairs[i];
        const std::int64_t to_target =
            metric(pair.query, pair.target, profile, profile.m);
        ranks.push_back(
            1 + std::ranges::count_if(from.mismatches, [&](const Signature& other) {
                return other != pair.target &&
                       metric(pair.query, other, profile, profile.m) <= to_target;
            }));
    }
    return ranks;
}

TEST(TrainingFeatures, AddUpToTheMetric) {
    std::mt19937 random(91);
    for (const BinRule rule : {BinRule::kLog2Plus1, BinRule::kLinear}) {
        Profile profile = *built_in_profile("painted");
        profile.bin_rule = rule;
        for (int i = 0; i < 30; ++i) {
            const Signature query = random_signature(random, kShape);
            const Signature target = random_signature(random, kShape);
            profile.m = 1 + i * 3;
            const RealWeights features = training_features(query, target, profile);
            double sum = 0;
            for (int c = 0; c < kChannels; ++c) {
                for (int b = 0; b < kBins; ++b) {
                    sum += features[c][b] * profile.weights[c][b];
                }
            }
            const auto expected =
                static_cast<double>(metric(query, target, profile, profile.m));
            EXPECT_NEAR(sum * double{kAverageOne}, expected, 1e-9 * expected);
        }
    }
}

TEST(Training, LearnsWhatTellsMatchesFromMismatches) {
    const Material from = material(92, 60, 200, 0.35);
    const auto report = train(from.pairs, from.mismatches, flat_profile(), {});
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_TRUE(report->converged);
    EXPECT_EQ(report->fitted_pairs, 30);
    EXPECT_EQ(report->mismatches, 30 * 100);
    EXPECT_GT(report->log_likelihood, report->null_log_likelihood);
    const RankSummary& before = report->held_back.before_summary;
    const RankSummary& after = report->held_back.after_summary;
    EXPECT_GT(after.mean_reciprocal_rank, before.mean_reciprocal_rank);
    EXPECT_TRUE(report->better);
    // Only Y says anything.
    const auto mean = [&](int c) {
        return (report->fitted[c][3] + report->fitted[c][4] + report->fitted[c][5]) / 3;
    };
    EXPECT_GT(mean(0), 2 * mean(1));
    EXPECT_GT(mean(0), 2 * mean(2));
    EXPECT_EQ(report->profile.name, "flat");
    EXPECT_EQ(report->profile.m, 40);
}

TEST(Training, RanksAreThoseOfTheMetric) {
    const Material from = material(93, 24, 60, 0.4);
    const auto report = train(from.pairs, from.mismatches, flat_profile(), {});
    ASSERT_TRUE(report) << report.error().message;
    const HeldBackRanks& held_back = report->held_back;
    ASSERT_EQ(held_back.pairs.size(), 12U);
    EXPECT_TRUE(std::ranges::is_sorted(held_back.pairs));
    EXPECT_EQ(held_back.candidates, 85);
    EXPECT_EQ(held_back.before, literal_ranks(from, held_back.pairs, flat_profile()));
    EXPECT_EQ(held_back.after, literal_ranks(from, held_back.pairs, report->profile));
    EXPECT_EQ(held_back.before_summary, summarize(held_back.before, 85));
    EXPECT_EQ(held_back.after_summary, summarize(held_back.after, 85));
}

TEST(Training, RanksOfAnyProfileAreThoseOfTheMetric) {
    const Material from = material(101, 24, 60, 0.4);
    std::vector<std::size_t> all(from.pairs.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    const Profile scanned = *built_in_profile("scanned");
    EXPECT_EQ(target_ranks(from.pairs, from.mismatches, scanned),
              literal_ranks(from, all, scanned));
}

TEST(Training, KeepingUpIsInBothMeasures) {
    const RankSummary before{.top_20 = 0.5, .mean_reciprocal_rank = 0.25};
    RankSummary after = before;
    EXPECT_TRUE(keeps_up(before, after));
    after.top_20 = 0.4;
    EXPECT_FALSE(keeps_up(before, after));
    after = {.top_20 = 0.75, .mean_reciprocal_rank = 0.2};
    EXPECT_FALSE(keeps_up(before, after));
    after.mean_reciprocal_rank = 0.3;
    EXPECT_TRUE(keeps_up(before, after));
}

TEST(Training, CoefficientWeightsAddUpToTheBases) {
    const Material from = material(94, 30, 80, 0.4);
    for (const char* name : {"painted", "scanned"}) {
        const Profile base = *built_in_profile(name);
        const auto report = train(from.pairs, from.mismatches, base, {});
        ASSERT_TRUE(report) << report.error().message;
        // Each of the 15 is rounded by at most half of 1/100.
        EXPECT_NEAR(
            coefficient_sum(report->profile.weights), coefficient_sum(base.weights), 7.5);
        for (int c = 0; c < kChannels; ++c) {
            for (int b = 0; b < kBins; ++b) {
                EXPECT_NEAR(report->profile.weights[c][b] / 100.0,
                            report->fitted[c][b],
                            0.005 + 1e-9);
            }
        }
    }
}

TEST(Training, CalibrationIsTheFittedModelOfTheStoredWeights) {
    const Material from = material(95, 40, 100, 0.3);
    // Large weights, so that rounding to 1/100 is little.
    Profile base = flat_profile();
    for (auto& channel : base.weights) channel.fill(10'000);
    const auto report =
        train(from.pairs, from.mismatches, base, {.mismatches_per_query = 1000});
    ASSERT_TRUE(report) << report.error().message;
    ASSERT_TRUE(report->profile.calibration.has_value());
    const Calibration& calibration = *report->profile.calibration;
    EXPECT_GT(calibration.scale, 0);

    // With every mismatch in the fit its rows are known, and so is its log-likelihood: each
    // row's exponent is off by at most the rounding of its weights.
    double log_likelihood = 0;
    double rounding = 0;
    for (std::size_t i = 0; i < from.pairs.size(); ++i) {
        if (std::ranges::binary_search(report->held_back.pairs, i)) continue;
        const Query query = make_query(from.pairs[i].query, report->profile, 40);
        for (const Signature& other : from.mismatches) {
            const bool match = other == from.pairs[i].target;
            const std::int64_t exact =
                metric(from.pairs[i].query, other, report->profile, 40);
            const double away = distance(query, exact - query.weight_sum * kAverageOne);
            const double p = probability(calibration, away);
            log_likelihood += std::log(match ? p : 1 - p);
            double terms = 0;
            for (const auto& channel :
                 training_features(from.pairs[i].query, other, report->profile)) {
                for (const double t : channel) terms += t;
            }
            rounding += calibration.scale * 0.005 * terms;
        }
    }
    EXPECT_NEAR(log_likelihood, report->log_likelihood, rounding);
    EXPECT_LT(rounding, std::abs(report->null_log_likelihood - report->log_likelihood));
}

TEST(Training, ProbabilityFallsWithTheDistance) {
    const Calibration calibration{2.0, 0.5};
    EXPECT_DOUBLE_EQ(probability(calibration, 4), 0.5);
    EXPECT_GT(probability(calibration, 0), 0.85);
    EXPECT_LT(probability(calibration, 10), 0.05);
}

TEST(Training, AWeightThatWouldBeNegativeIsReportedAndClamped) {
    Material from = material(96, 40, 120, 0.5);
    // A match lies further away in the average of I than any mismatch does.
    for (Signature& other : from.mismatches) other.channels[1].average = 0;
    for (TrainingPair& pair : from.pairs) {
        pair.query.channels[1].average = 0;
        pair.target.channels[1].average = kAverageOne / 4;
    }
    const auto report =
        train(from.pairs, from.mismatches, flat_profile(), {.ridge = 1e-6});
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_LT(report->raw[1][0], 0);
    EXPECT_TRUE(report->clamped[1][0]);
    EXPECT_EQ(report->fitted[1][0], 0);
    EXPECT_EQ(report->profile.weights[1][0], 0);
    EXPECT_FALSE(report->clamped[0][5]);
    for (int c = 0; c < kChannels; ++c) {
        for (int b = 0; b < kBins; ++b) EXPECT_GE(report->fitted[c][b], 0);
    }
}

TEST(Training, PairsWithoutEvidenceKeepTheBase) {
    const Material from = material(97, 20, 40, 0.5);
    const Profile base = *built_in_profile("painted");
    const auto report = train(from.pairs, from.mismatches, base, {.ridge = 1e9});
    ASSERT_TRUE(report) << report.error().message;
    for (int c = 0; c < kChannels; ++c) {
        for (int b = 0; b < kBins; ++b) {
            EXPECT_NEAR(report->profile.weights[c][b],
                        base.weights[c][b],
                        0.01 * base.weights[c][b] + 1);
        }
    }
    EXPECT_TRUE(report->better);
}

TEST(Training, IsTheSameUnderOneSeed) {
    const Material from = material(98, 30, 60, 0.4);
    const auto train_with = [&](std::uint64_t seed) {
        return *train(from.pairs, from.mismatches, flat_profile(), {.seed = seed});
    };
    const TrainingReport first = train_with(5);
    const TrainingReport again = train_with(5);
    EXPECT_EQ(first.profile.weights, again.profile.weights);
    EXPECT_EQ(first.profile.calibration, again.profile.calibration);
    EXPECT_EQ(first.held_back.after, again.held_back.after);
    EXPECT_NE(first.held_back.pairs, train_with(6).held_back.pairs);
}

TEST(Training, BetterMeansThatNoHeldBackRankingFell) {
    // Two pairs with one mismatch each teach next to nothing: some fits are worse.
    const Material from = material(99, 20, 200, 0.08);
    Profile base = flat_profile();
    base.weights[1].fill(1);
    base.weights[2].fill(1);
    int better = 0;
    constexpr int kSeeds = 20;
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
        const auto report =
            train(from.pairs,
                  from.mismatches,
                  base,
                  {.mismatches_per_query = 1, .held_back_share = 0.9, .seed = seed});
        ASSERT_TRUE(report) << report.error().message;
        const RankSummary& before = report->held_back.before_summary;
        const RankSummary& after = report->held_back.after_summary;
        EXPECT_EQ(report->better,
                  after.mean_reciprocal_rank >= before.mean_reciprocal_rank &&
                      after.top_20 >= before.top_20);
        better += report->better ? 1 : 0;
    }
    EXPECT_GT(better, 0);
    EXPECT_LT(better, kSeeds);
}

class TrainingErrors : public ::testing::Test {
  protected:
    void expect_error(const std::string& message, const std::string& param) const {
        const auto report = train(from_.pairs, from_.mismatches, base_, options_);
        ASSERT_FALSE(report);
        EXPECT_EQ(report.error().code, ErrorCode::kInvalidArgument);
        EXPECT_NE(report.error().message.find(message), std::string::npos)
            << report.error().message;
        EXPECT_EQ(report.error().param, param);
    }

    Material from_ = material(100, 20, 10, 0.5);
    Profile base_ = flat_profile();
    TrainingOptions options_;
};

TEST_F(TrainingErrors, TooFewPairs) {
    from_.pairs.pop_back();
    expect_error("19 pairs: at least 20 are needed", "pairs");
}

TEST_F(TrainingErrors, NoMismatches) {
    from_.mismatches.clear();
    expect_error("no mismatches", "mismatches");
}

TEST_F(TrainingErrors, MismatchesThatAreTheTarget) {
    for (TrainingPair& pair : from_.pairs) pair.target = from_.pairs[0].target;
    from_.mismatches = {from_.pairs[0].target};
    expect_error("no mismatches: each is the target", "mismatches");
}

TEST_F(TrainingErrors, APairOfAnotherKind) {
    from_.pairs[6].target.kind.color_space = ColorSpace::kLab;
    expect_error("pair 7 is lab-standard, the profile yiq-standard", "pairs");
}

TEST_F(TrainingErrors, AMismatchOfAnotherKind) {
    from_.mismatches[2].kind.decomposition = Decomposition::kNonstandard;
    expect_error("mismatch 3 is yiq-nonstandard, the profile yiq-standard", "mismatches");
}

TEST_F(TrainingErrors, AQueryWithoutInformation) {
    from_.pairs[4].query.low_information = true;
    expect_error("pair 5: the query has no information", "pairs");
}

TEST_F(TrainingErrors, AQueryWithoutCoefficients) {
    for (ChannelSignature& channel : from_.pairs[19].query.channels) channel.count = 0;
    expect_error("pair 20: the query has no information", "pairs");
}

TEST_F(TrainingErrors, ABaseThatWeighsNoCoefficient) {
    for (auto& channel : base_.weights) std::fill(channel.begin() + 1, channel.end(), 0);
    expect_error("profile flat weighs no coefficient", "base");
}

TEST_F(TrainingErrors, OptionsOutOfRange) {
    options_.mismatches_per_query = 0;
    expect_error("0 is less than 1", "mismatches_per_query");
    options_ = {.held_back_share = 0.95};
    expect_error("0.95", "held_back_share");
    options_ = {.held_back_share = std::numeric_limits<double>::quiet_NaN()};
    expect_error("nan", "held_back_share");
    options_ = {.ridge = 0};
    expect_error("0.0", "ridge");
    options_ = {.ridge = std::numeric_limits<double>::infinity()};
    expect_error("inf", "ridge");
}

TEST_F(TrainingErrors, PairsThatSpeakAgainstEveryCoefficient) {
    // Targets have nothing of their query, all mismatches have all of it.
    Signature query;
    query.channels[0].count = 10;
    for (int i = 0; i < 10; ++i) query.channels[0].indices[i] = std::int16_t(i + 1);
    Signature target;
    target.channels[0].average = kAverageOne / 8;
    from_.pairs.assign(20, {query, target});
    from_.mismatches.assign(5, query);
    for (auto& channel : base_.weights) std::fill(channel.begin() + 1, channel.end(), 0);
    base_.weights[0][1] = 100;
    options_.ridge = 1e-9;
    expect_error("leave no coefficient a weight above 0", "pairs");
}

}  // namespace
}  // namespace haarmony::image
