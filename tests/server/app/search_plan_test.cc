#include "server/app/search_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <random>
#include <vector>

#include "engine/image/aspect.h"
#include "engine/image/metric.h"
#include "engine/image/window.h"
#include "tests/engine/image/random_signatures.h"

namespace haarmony::server {
namespace {

using image::Symmetry;

constexpr int kM = 30;
constexpr double kUnit = 100.0 * image::kAverageOne;
constexpr image::SignatureKind kLab{image::ColorSpace::kLab,
                                    image::Decomposition::kStandard};

// Few places and few averages: matches, misses and ties.
constexpr image::SignatureShape kShape{.max_count = 40,
                                       .max_index = 90,
                                       .average_steps = 3};

struct Collection {
    std::map<std::string, std::map<std::int64_t, image::Signature>> pictures;
    std::map<std::int64_t, std::int32_t> shapes;
    std::unique_ptr<VariantIndexes> indexes;
};

// Pictures 1..60: all have the main signature, every third has no Lab one, every fourth has
// borders.
Collection make_collection(std::mt19937& random) {
    Collection made;
    made.indexes = std::make_unique<VariantIndexes>(
        image::IndexOptions{.index_m = kM, .tail_capacity = 16});
    std::vector<SearchablePicture> pictures;
    for (std::int64_t id = 1; id <= 60; ++id) {
        SearchablePicture picture{ImageId{id}, 0, {}};
        picture.log_aspect = static_cast<std::int32_t>(random() % 5) * 1'000'000;
        made.shapes[id] = picture.log_aspect;
        picture.signatures["yiq-standard"] = random_signature(random, kShape);
        if (id % 3 != 0) {
            image::Signature lab = random_signature(random, kShape);
            lab.kind = kLab;
            picture.signatures["lab-standard"] = lab;
        }
        if (id % 4 == 0)
            picture.signatures["yiq-standard-content"] = random_signature(random, kShape);
        for (const auto& [variant, signature] : picture.signatures)
            made.pictures[variant][id] = signature;
        pictures.push_back(std::move(picture));
    }
    made.indexes->apply(pictures, {});
    return made;
}

class SearchPlanTest : public testing::Test {
  protected:
    SearchPlanTest() {
        image::Signature lab = random_signature(random_, kShape);
        lab.kind = kLab;
        picture_.signatures = {{{}, {random_signature(random_, kShape)}}, {kLab, {lab}}};
        picture_.log_aspect = 2'000'000;
        options_.profiles = {*image::built_in_profile("painted")};
    }

    [[nodiscard]] image::Profile lab_profile() const {
        image::Profile profile = *image::built_in_profile("scanned");
        profile.name = "lab";
        profile.kind = kLab;
        return profile;
    }
    [[nodiscard]] Result<SearchPlan> make() const {
        return SearchPlan::make(picture_, options_, collection_.indexes->snapshots(), kM);
    }

    // Equation (4.3) of a picture in every way that `symmetries` and `variants` allow, with
    // the term of the shape: the least of them.
    [[nodiscard]] double least_distance(std::int64_t id,
                                        const std::vector<Symmetry>& symmetries,
                                        const std::vector<std::string>& variants) const {
        double least = 1e300;
        for (const Symmetry symmetry : symmetries) {
            const image::Signature turned =
                image::transformed(picture_.signatures.at({}).front(), symmetry);
            const std::int32_t shape = image::swaps_sides(symmetry)
                                           ? -*picture_.log_aspect
                                           : *picture_.log_aspect;
            for (const std::string& variant : variants) {
                const auto& stored = collection_.pictures.at(variant);
                if (!stored.contains(id)) continue;
                const std::int64_t units =
                    image::metric(turned, stored.at(id), options_.profiles[0], kM) +
                    options_.aspect_weight *
                        std::abs(std::int64_t{shape} - collection_.shapes.at(id));
                least = std::min(least, static_cast<double>(units) / kUnit);
            }
        }
        return least;
    }

    void expect_all(const Candidates& found,
                    const std::vector<Symmetry>& symmetries,
                    const std::vector<std::string>& variants) const {
        std::vector<std::pair<double, std::int64_t>> expected;
        for (std::int64_t id = 1; id <= 60; ++id)
            expected.emplace_back(least_distance(id, symmetries, variants), id);
        std::ranges::sort(expected);
        ASSERT_EQ(found.best.size(), expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i) {
            EXPECT_EQ(found.best[i].distance, expected[i].first) << "place " << i;
            EXPECT_EQ(to_int(found.best[i].id), expected[i].second) << "place " << i;
        }
        EXPECT_EQ(found.searched, 60);
        EXPECT_TRUE(found.exhausted);
    }

    std::mt19937 random_{211};
    Collection collection_ = make_collection(random_);
    QueryPicture picture_;
    PlanOptions options_;
};

const std::vector<Symmetry> kAll(image::kSymmetries.begin(), image::kSymmetries.end());

TEST_F(SearchPlanTest, AsksForThePictureAsItIs) {
    expect_all(
        make()->best(1000, nullptr, nullptr), {Symmetry::kIdentity}, {"yiq-standard"});
    EXPECT_EQ(make()->m(), kM);
    options_.m = 7;
    EXPECT_EQ(make()->m(), 7);
}

TEST_F(SearchPlanTest, EveryOrientationCountsAtItsBest) {
    options_.orientations = Orientations::kMirror;
    expect_all(make()->best(1000, nullptr, nullptr),
               {Symmetry::kIdentity, Symmetry::kMirrorX},
               {"yiq-standard"});
    options_.orientations = Orientations::kAll;
    expect_all(make()->best(1000, nullptr, nullptr), kAll, {"yiq-standard"});
}

TEST_F(SearchPlanTest, WhatIsWithinBordersIsAnotherLook) {
    options_.content = true;
    options_.orientations = Orientations::kAll;
    expect_all(make()->best(1000, nullptr, nullptr),
               kAll,
               {"yiq-standard", "yiq-standard-content"});
}

TEST_F(SearchPlanTest, TheShapeTurnsWithThePicture) {
    options_.aspect_weight = 300;
    options_.orientations = Orientations::kAll;
    expect_all(make()->best(1000, nullptr, nullptr), kAll, {"yiq-standard"});
}

// Bins of the linear rule change under a mirror, and with them the sum of the weights.
TEST_F(SearchPlanTest, WaysOfOtherWeightsAreComparedByDistance) {
    options_.profiles[0].bin_rule = image::BinRule::kLinear;
    options_.orientations = Orientations::kAll;
    expect_all(make()->best(1000, nullptr, nullptr), kAll, {"yiq-standard"});
}

// Equation (4.3) under the window's own weights, as with_weight_sum() makes them.
TEST_F(SearchPlanTest, EveryWindowCountsAtItsBest) {
    std::vector<image::Signature>& windows = picture_.signatures.at({});
    for (int i = 0; i < 4; ++i) windows.push_back(random_signature(random_, kShape));
    const Candidates found = make()->best(1000, nullptr, nullptr);
    const image::Profile& profile = options_.profiles[0];
    const image::Query first = image::make_query(windows[0], profile, kM);
    ASSERT_EQ(found.best.size(), 60U);
    for (const Candidate& candidate : found.best) {
        double least = 1e300;
        for (const image::Signature& window : windows) {
            const image::Query query = image::with_weight_sum(
                image::make_query(window, profile, kM), first.weight_sum);
            const image::Signature& target =
                collection_.pictures.at("yiq-standard").at(to_int(candidate.id));
            std::array<std::int32_t, image::kChannels> average{};
            std::int64_t matched = 0;
            for (int c = 0; c < image::kChannels; ++c) {
                average[c] = target.channels[c].average;
                for (const std::int16_t index : target.channels[c].largest(kM))
                    for (const image::QueryTerm& term : query.terms)
                        if (term.key == image::coefficient_key(c, index))
                            matched += term.weight;
            }
            least = std::min(
                least, image::distance(query, image::score(query, average, 0, matched)));
        }
        EXPECT_EQ(candidate.distance, least);
    }
}

TEST_F(SearchPlanTest, AFewAreTheFirstOfAll) {
    options_.orientations = Orientations::kAll;
    options_.content = true;
    const SearchPlan plan = std::move(make()).value();
    const std::vector<Candidate> all = plan.best(1000, nullptr, nullptr).best;
    for (const int limit : {1, 2, 19, 60}) {
        const Candidates few = plan.best(limit, nullptr, nullptr);
        ASSERT_EQ(static_cast<int>(few.best.size()), limit);
        for (int i = 0; i < limit; ++i) EXPECT_EQ(few.best[i].id, all[i].id);
    }
}

TEST_F(SearchPlanTest, MinSimilarityKeepsAllThatAreSimilarEnough) {
    for (const Orientations orientations : {Orientations::kNone, Orientations::kAll}) {
        options_.orientations = orientations;
        options_.profiles[0].bin_rule = image::BinRule::kLinear;
        options_.min_similarity.reset();
        const std::vector<Candidate> all = make()->best(1000, nullptr, nullptr).best;
        for (const std::size_t at : {0U, 5U, 30U, 59U}) {
            options_.min_similarity = all[at].similarity;
            std::vector<ImageId> expected;
            for (const Candidate& candidate : all)
                if (candidate.similarity >= *options_.min_similarity)
                    expected.push_back(candidate.id);
            for (const int limit : {1, 4, 1000}) {
                const Candidates found = make()->best(limit, nullptr, nullptr);
                std::vector<ImageId> ids;
                for (const Candidate& candidate : found.best) ids.push_back(candidate.id);
                std::vector<ImageId> first = expected;
                first.resize(std::min(first.size(), static_cast<std::size_t>(limit)));
                EXPECT_EQ(ids, first) << "limit " << limit;
            }
        }
    }
}

TEST_F(SearchPlanTest, AFilterNarrowsTheSearch) {
    const std::vector<ImageId> wanted{ImageId{7}, ImageId{8}, ImageId{50}};
    const image::IdSet only(wanted);
    const Candidates found = make()->best(2, &only, nullptr);
    EXPECT_EQ(found.best.size(), 2U);
    EXPECT_EQ(found.searched, 3);
}

TEST_F(SearchPlanTest, RanksOfProfilesAreCombined) {
    options_.profiles.push_back(lab_profile());
    for (const image::CombineBy by :
         {image::CombineBy::kMean, image::CombineBy::kWorst}) {
        options_.combine_by = by;
        const Candidates found = make()->best(60, nullptr, nullptr);
        ASSERT_EQ(found.best.size(), 60U);
        for (const Candidate& candidate : found.best) {
            double ranks[2] = {1, 1};
            for (int p = 0; p < 2; ++p) {
                const auto& stored =
                    collection_.pictures.at(p == 0 ? "yiq-standard" : "lab-standard");
                const auto distance = [&](std::int64_t id) {
                    return image::metric(
                        picture_.signatures.at(options_.profiles[p].kind).front(),
                        stored.at(id),
                        options_.profiles[p],
                        kM);
                };
                const std::int64_t self = to_int(candidate.id);
                for (const auto& [id, signature] : stored) {
                    if (!stored.contains(self) ||
                        std::pair(distance(id), id) < std::pair(distance(self), self))
                        ++ranks[p];
                }
            }
            EXPECT_EQ(candidate.combined_rank,
                      by == image::CombineBy::kMean ? (ranks[0] + ranks[1]) / 2
                                                    : std::max(ranks[0], ranks[1]));
            EXPECT_EQ(candidate.distance,
                      least_distance(
                          to_int(candidate.id), {Symmetry::kIdentity}, {"yiq-standard"}));
        }
        EXPECT_TRUE(std::ranges::is_sorted(
            found.best, {}, [](const Candidate& match) { return *match.combined_rank; }));
        EXPECT_EQ(found.searched, 60);
    }
}

TEST_F(SearchPlanTest, CombinedRanksObeyLimitAndSimilarity) {
    options_.profiles.push_back(lab_profile());
    const std::vector<Candidate> all = make()->best(60, nullptr, nullptr).best;
    options_.min_similarity = all[20].similarity;
    const Candidates found = make()->best(3, nullptr, nullptr);
    std::vector<ImageId> expected;
    for (const Candidate& candidate : all)
        if (candidate.similarity >= *options_.min_similarity && expected.size() < 3)
            expected.push_back(candidate.id);
    std::vector<ImageId> ids;
    for (const Candidate& candidate : found.best) ids.push_back(candidate.id);
    EXPECT_EQ(ids, expected);
    EXPECT_TRUE(make()->best(60, nullptr, nullptr).exhausted);
}

TEST_F(SearchPlanTest, RefusesWhatCannotBeCompared) {
    options_.profiles = {lab_profile()};
    options_.profiles[0].kind.decomposition = image::Decomposition::kNonstandard;
    const auto no_index = make();
    ASSERT_FALSE(no_index);
    EXPECT_EQ(no_index.error().code, ErrorCode::kConflict);
    EXPECT_NE(no_index.error().message.find("lab-nonstandard"), std::string::npos);

    options_.profiles = {lab_profile()};
    picture_.signatures.erase(kLab);
    const auto no_signature = make();
    ASSERT_FALSE(no_signature);
    EXPECT_EQ(no_signature.error().code, ErrorCode::kInvalidArgument);
    EXPECT_EQ(no_signature.error().param, "profile");

    options_.profiles = {*image::built_in_profile("painted")};
    options_.aspect_weight = 1;
    picture_.log_aspect.reset();
    const auto no_shape = make();
    ASSERT_FALSE(no_shape);
    EXPECT_EQ(no_shape.error().param, "aspect_weight");
}

}  // namespace
}  // namespace haarmony::server
