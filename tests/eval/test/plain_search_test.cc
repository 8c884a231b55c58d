#include "tests/eval/plain_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/core/executor.h"
#include "engine/image/metric.h"
#include "tests/eval/exhaustive_matches.h"
#include "tests/eval/list_popularity.h"
#include "tests/eval/synthetic_signatures.h"
#include "tests/eval/test/generated_pictures.h"

namespace haarmony::eval {
namespace {

constexpr int kPictures = 60;
constexpr int kQueries = 20;

const SyntheticCollection& collection() {
    static const SyntheticCollection made = [] {
        InlineExecutor executor;
        const SmallPhotos photos = *load_small_photos(generated_pictures(5), executor);
        return make_synthetic_collection(photos, {2, kPictures, kQueries}, executor);
    }();
    return made;
}

image::Signature query_signature(int number) {
    return unpack(collection().queries[number % 3][number].signature);
}

image::Profile profile_with(image::BinRule rule) {
    image::Profile profile = *image::built_in_profile("painted");
    profile.bin_rule = rule;
    return profile;
}

// Equation (4.4) of one picture in doubles, term by term, from the signatures.
double direct_score(const image::Signature& query,
                    const PackedSignature& target,
                    const image::Profile& profile,
                    int m) {
    double score = 0;
    for (int c = 0; c < image::kChannels; ++c) {
        const double difference =
            double(query.channels[c].average) - double(target.average[c]);
        score += profile.weights[c][0] / 100.0 * std::fabs(difference) /
                 double(image::kAverageOne);
        for (const int index : query.channels[c].largest(m)) {
            const auto in_target = target.largest(c, m);
            if (std::ranges::find(in_target, index) == in_target.end()) continue;
            const int place = std::abs(index);
            const int bin =
                image::bin(profile.bin_rule, place / image::kSide, place % image::kSide);
            score -= profile.weights[c][bin] / 100.0;
        }
    }
    return score;
}

TEST(PlainSearch, ScoresAreEquation44) {
    for (const int m : {1, 20, 60}) {
        PlainSearch search(collection().signatures, m);
        for (const auto rule : {image::BinRule::kLiteral, image::BinRule::kLinear}) {
            const image::Profile profile = profile_with(rule);
            for (int q = 0; q < 6; ++q) {
                const image::Signature signature = query_signature(q);
                const auto scores =
                    search.score(plain_query(image::make_query(signature, profile, m)));
                ASSERT_EQ(scores.size(), std::size_t{kPictures});
                for (std::size_t i = 0; i < scores.size(); ++i) {
                    // Up to 180 sums of numbers below 128, each rounded at 2^-24 of them.
                    EXPECT_NEAR(
                        scores[i],
                        direct_score(signature, collection().signatures[i], profile, m),
                        1e-3)
                        << m << ' ' << q << ' ' << i;
                }
            }
        }
    }
}

TEST(PlainSearch, BestAreTheSmallestScoresInOrder) {
    PlainSearch search(collection().signatures, 40);
    const PlainQuery query = plain_query(
        image::make_query(query_signature(1), profile_with(image::BinRule::kLinear), 40));
    const auto scores = search.score(query);
    std::vector<PlainMatch> all;
    for (std::uint32_t i = 0; i < scores.size(); ++i) all.push_back({scores[i], i});
    std::ranges::sort(all);
    for (const int limit : {0, 1, 20, kPictures, kPictures + 5}) {
        const auto best = search.search(query, limit);
        ASSERT_EQ(best.size(), std::min<std::size_t>(limit, all.size()));
        EXPECT_TRUE(std::ranges::equal(best, std::span(all).first(best.size()))) << limit;
    }
}

TEST(PlainSearch, EqualScoresGoToTheSmallerNumber) {
    const std::vector<PackedSignature> equal(5, collection().signatures.front());
    PlainSearch search(equal, 20);
    const auto best =
        search.search(plain_query(image::make_query(
                          query_signature(0), profile_with(image::BinRule::kLinear), 20)),
                      3);
    ASSERT_EQ(best.size(), 3U);
    for (std::uint32_t i = 0; i < 3; ++i) EXPECT_EQ(best[i].picture, i);
}

TEST(PlainSearch, TakesFourBytesAPosting) {
    std::int64_t postings = 0;
    for (const PackedSignature& signature : collection().signatures) {
        for (int c = 0; c < image::kChannels; ++c)
            postings += static_cast<std::int64_t>(signature.largest(c, 40).size());
    }
    const PlainSearch full(collection().signatures, 40);
    const PlainSearch empty({}, 40);
    // Three averages and a score beside the postings.
    EXPECT_EQ(full.bytes() - empty.bytes(), 4 * postings + kPictures * 16);
}

TEST(ExhaustiveMatches, AreTheMetricsOwnOrder) {
    for (const auto rule : {image::BinRule::kLiteral,
                            image::BinRule::kLog2Plus1,
                            image::BinRule::kLinear}) {
        const image::Profile profile = profile_with(rule);
        constexpr int kM = 40;
        std::vector<image::Query> queries;
        for (int q = 0; q < kQueries; ++q)
            queries.push_back(image::make_query(query_signature(q), profile, kM));
        InlineExecutor executor;
        const auto matches =
            exhaustive_matches(collection().signatures, queries, 7, executor);
        ASSERT_EQ(matches.size(), queries.size());
        for (int q = 0; q < kQueries; q += 5) {
            std::vector<std::pair<std::int64_t, std::int64_t>> expected;
            for (int i = 0; i < kPictures; ++i) {
                expected.emplace_back(image::metric(query_signature(q),
                                                    unpack(collection().signatures[i]),
                                                    profile,
                                                    kM),
                                      i + 1);
            }
            std::ranges::sort(expected);
            ASSERT_EQ(matches[q].size(), 7U);
            for (std::size_t i = 0; i < matches[q].size(); ++i) {
                EXPECT_EQ(to_int(matches[q][i].id), expected[i].second) << q << ' ' << i;
                EXPECT_EQ(image::full_distance(queries[q], matches[q][i].score),
                          expected[i].first)
                    << q << ' ' << i;
            }
        }
    }
}

TEST(ExhaustiveMatches, EqualPicturesAreInTheOrderOfTheirIds) {
    const std::vector<PackedSignature> equal(9, collection().signatures.front());
    const std::vector<image::Query> queries = {image::make_query(
        query_signature(3), profile_with(image::BinRule::kLog2Plus1), 20)};
    InlineExecutor executor;
    const auto matches = exhaustive_matches(equal, queries, 4, executor);
    ASSERT_EQ(matches.front().size(), 4U);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_EQ(to_int(matches.front()[i].id), static_cast<std::int64_t>(i) + 1);
}

// Three pictures; the list of +5 in Y names two of them, of -6 one; a query reads both.
TEST(ListPopularity, CountsWhatQueriesRead) {
    PackedSignature both;
    both.count = {2, 0, 0};
    both.indices[0] = {5, -6};
    PackedSignature one;
    one.count = {1, 0, 0};
    one.indices[0] = {5};
    PackedSignature other;
    other.count = {0, 1, 0};
    other.indices[1] = {5};
    const std::vector<PackedSignature> signatures = {both, one, other};
    const std::vector<PackedSignature> queries = {both};
    const ListPopularity popularity = ListLengths(signatures, 20).read_by(queries);
    EXPECT_EQ(popularity.m, 20);
    EXPECT_EQ(popularity.non_empty_lists, 3);
    EXPECT_DOUBLE_EQ(popularity.hits_per_picture, 1);
    EXPECT_DOUBLE_EQ(popularity.median_density, 1.0 / 3);
    EXPECT_DOUBLE_EQ(popularity.p90_density, 2.0 / 3);
    EXPECT_DOUBLE_EQ(popularity.largest_density, 2.0 / 3);
    EXPECT_EQ(popularity.popular_lists, 3);
    EXPECT_DOUBLE_EQ(popularity.popular_share, 1);
    const ListPopularity first = ListLengths(signatures, 1).read_by(queries);
    EXPECT_EQ(first.non_empty_lists, 2);
}

TEST(ListPopularity, PicturesWithoutCoefficientsReadNothing) {
    const std::vector<PackedSignature> empty(3);
    const ListPopularity popularity = ListLengths(empty, 20).read_by(empty);
    EXPECT_EQ(popularity.non_empty_lists, 0);
    EXPECT_EQ(popularity.hits_per_picture, 0);
    EXPECT_EQ(popularity.popular_share, 0);
}

}  // namespace
}  // namespace haarmony::eval
