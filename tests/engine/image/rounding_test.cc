#include "engine/image/rounding.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>

#include "engine/image/bit_sums.h"

namespace haarmony::image {
namespace {

Query query_of(const std::vector<std::int32_t>& weights) {
    Query query;
    query.m = kMaxCoefficients;
    for (const std::int32_t weight : weights) {
        query.terms.push_back({std::uint32_t(query.terms.size() + 1), weight});
        query.weight_sum += weight;
    }
    return query;
}

// Queries as profiles make them, few different weights, and others.
std::vector<std::vector<std::int32_t>> many_weights() {
    std::mt19937 random(521);
    std::vector<std::vector<std::int32_t>> all = {
        {1}, {kMaxWeight}, {3, 3, 3}, {1, kMaxWeight}};
    for (const std::size_t terms : {2U, 17U, 120U, 300U}) {
        for (const int different : {1, 3, 18, 300}) {
            for (const int largest : {2, 130, 4000, int(kMaxWeight)}) {
                std::vector<std::int32_t> table(std::size_t(different), 1);
                for (std::int32_t& weight : table)
                    weight = 1 + static_cast<std::int32_t>(random() % unsigned(largest));
                std::vector<std::int32_t> weights(terms);
                for (std::int32_t& weight : weights)
                    weight = table[random() % table.size()];
                all.push_back(weights);
            }
        }
    }
    all.push_back(std::vector<std::int32_t>(300, kMaxWeight));
    return all;
}

TEST(Rounding, NeverMakesAWeightSmaller) {
    for (const std::vector<std::int32_t>& weights : many_weights()) {
        const Rounding rounding(query_of(weights));
        for (const std::int32_t weight : weights)
            ASSERT_GE(rounding.weight(rounding.units(weight)), weight);
    }
}

TEST(Rounding, AddsNoOneBitsToThoseOfTheUnit) {
    for (const std::vector<std::int32_t>& weights : many_weights()) {
        const Rounding rounding(query_of(weights));
        for (const std::int32_t weight : weights) {
            const auto exact =
                std::uint32_t((weight + rounding.unit() - 1) / rounding.unit());
            ASSERT_LE(std::popcount(rounding.units(weight)), std::popcount(exact))
                << weight << " in units of " << rounding.unit();
        }
    }
}

TEST(Rounding, ManyLikeWeightsOfAProfileLoseLittle) {
    // Table 4.1, scanned: bins 1 to 5 of three channels, eight coefficients in each.
    std::vector<std::int32_t> weights;
    for (const std::int32_t weight :
         {83, 126, 36, 101, 44, 45, 52, 53, 14, 47, 28, 18, 30, 14, 27})
        weights.insert(weights.end(), 8, weight);
    const Query query = query_of(weights);
    const Rounding rounding(query);
    std::int64_t rounded = 0;
    for (const std::int32_t weight : weights)
        rounded += rounding.weight(rounding.units(weight));
    EXPECT_LE(double(rounded) / double(query.weight_sum), 1.04);
}

TEST(Rounding, SumsFitTheirPlanes) {
    for (const std::vector<std::int32_t>& weights : many_weights()) {
        const Rounding rounding(query_of(weights));
        std::uint64_t sum = 0;
        for (const std::int32_t weight : weights) sum += rounding.units(weight);
        ASSERT_EQ(sum >> kMaxPlanes, 0U) << weights.size() << " weights";
    }
}

TEST(Rounding, UnitsForAWeightAreTheFewestThatAreWorthIt) {
    for (const std::vector<std::int32_t>& weights : many_weights()) {
        const Query query = query_of(weights);
        const Rounding rounding(query);
        EXPECT_EQ(rounding.units_for(0), 0U);
        EXPECT_EQ(rounding.units_for(-query.weight_sum), 0U);
        for (const std::int64_t asked :
             {std::int64_t{1}, query.weight_sum / 3 + 1, query.weight_sum}) {
            const std::uint32_t units = rounding.units_for(asked);
            ASSERT_GE(rounding.weight(units), asked);
            ASSERT_LT(rounding.weight(units - 1), asked);
        }
    }
}

TEST(Rounding, WhatNoSumIsWorthIsOutOfReach) {
    const Rounding rounding(query_of({5, 7}));
    EXPECT_GT(rounding.units_for(std::int64_t{1} << 62), 1U << kMaxPlanes);
}

TEST(Rounding, TermsWithoutWeightCountForNothing) {
    const Rounding with(query_of({0, 83, 0, 126}));
    const Rounding without(query_of({83, 126}));
    EXPECT_EQ(with.unit(), without.unit());
    EXPECT_EQ(with.units(83), without.units(83));
}

TEST(Rounding, AQueryWithoutTermsHasAUnitAllTheSame) {
    EXPECT_EQ(Rounding(query_of({})).unit(), 1);
    EXPECT_EQ(Rounding(query_of({0})).unit(), 1);
}

}  // namespace
}  // namespace haarmony::image
