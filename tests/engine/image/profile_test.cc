#include "engine/image/profile.h"

#include <gtest/gtest.h>

#include <vector>

namespace haarmony::image {
namespace {

constexpr BinRule kAllRules[] = {BinRule::kLog2Plus1,
                                 BinRule::kLinear,
                                 BinRule::kLiteral};

// The bins of rows and columns 0..3, row by row; (0, 0) is no wavelet and stands as -1.
std::vector<int> first_bins(BinRule rule) {
    std::vector<int> bins = {-1};
    for (int i = 1; i < 16; ++i) bins.push_back(bin(rule, i / 4, i % 4));
    return bins;
}

TEST(Bin, Log2Plus1KeepsBin0ForTheAverage) {
    EXPECT_EQ(first_bins(BinRule::kLog2Plus1),
              (std::vector<int>{-1, 1, 2, 2, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2}));
}

TEST(Bin, LinearIsTheLargerIndex) {
    EXPECT_EQ(first_bins(BinRule::kLinear),
              (std::vector<int>{-1, 1, 2, 3, 1, 1, 2, 3, 2, 2, 2, 3, 3, 3, 3, 3}));
}

TEST(Bin, LiteralPutsTheCoarsestWaveletsInBin0) {
    EXPECT_EQ(first_bins(BinRule::kLiteral),
              (std::vector<int>{-1, 0, 1, 1, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}));
}

TEST(Bin, ChangesWhereTheRuleSaysAndEndsAt5) {
    struct Case {
        int index, log2_plus_1, linear, literal;
    };
    for (const Case& c : {Case{4, 3, 4, 2},
                          {5, 3, 5, 2},
                          {7, 3, 5, 2},
                          {8, 4, 5, 3},
                          {15, 4, 5, 3},
                          {16, 5, 5, 4},
                          {31, 5, 5, 4},
                          {32, 5, 5, 5},
                          {127, 5, 5, 5}}) {
        EXPECT_EQ(bin(BinRule::kLog2Plus1, 0, c.index), c.log2_plus_1) << c.index;
        EXPECT_EQ(bin(BinRule::kLinear, 0, c.index), c.linear) << c.index;
        EXPECT_EQ(bin(BinRule::kLiteral, 0, c.index), c.literal) << c.index;
    }
}

TEST(Bin, IsThatOfTheLargerOfRowAndColumn) {
    for (const BinRule rule : kAllRules) {
        for (int row = 0; row < kSide; ++row) {
            for (int column = row == 0 ? 1 : 0; column < kSide; ++column) {
                ASSERT_EQ(bin(rule, row, column), bin(rule, 0, std::max(row, column)));
            }
        }
    }
}

TEST(BinRule, RoundTripsItsName) {
    for (const BinRule rule : kAllRules) {
        EXPECT_EQ(bin_rule_from_name(bin_rule_name(rule)), rule);
    }
    EXPECT_EQ(bin_rule_from_name("log2_plus_1"), BinRule::kLog2Plus1);
    EXPECT_EQ(bin_rule_from_name("linear"), BinRule::kLinear);
    EXPECT_EQ(bin_rule_from_name("literal"), BinRule::kLiteral);
    EXPECT_EQ(bin_rule_from_name("Linear"), std::nullopt);
    EXPECT_EQ(bin_rule_from_name(""), std::nullopt);
}

// Table 4.1, as restored, column by column as it is printed.
TEST(Profile, BuiltInWeightsAreThoseOfTable4_1) {
    const std::vector<std::array<double, 3>> painted = {{4.04, 15.14, 22.62},
                                                        {0.78, 0.92, 0.40},
                                                        {0.46, 0.53, 0.63},
                                                        {0.42, 0.26, 0.25},
                                                        {0.41, 0.14, 0.15},
                                                        {0.32, 0.07, 0.38}};
    const std::vector<std::array<double, 3>> scanned = {{5.00, 19.21, 34.37},
                                                        {0.83, 1.26, 0.36},
                                                        {1.01, 0.44, 0.45},
                                                        {0.52, 0.53, 0.14},
                                                        {0.47, 0.28, 0.18},
                                                        {0.30, 0.14, 0.27}};
    for (const auto& [name, table] :
         {std::pair("painted", painted), {"scanned", scanned}}) {
        const auto profile = built_in_profile(name);
        ASSERT_TRUE(profile);
        EXPECT_EQ(profile->name, name);
        EXPECT_EQ(profile->bin_rule, BinRule::kLog2Plus1);
        for (int b = 0; b < kBins; ++b) {
            for (int c = 0; c < kChannels; ++c) {
                EXPECT_DOUBLE_EQ(profile->weights[c][b] / 100.0, table[b][c])
                    << name << ", bin " << b << ", channel " << c;
            }
        }
    }
}

TEST(Profile, BuiltInOnesKeepTheirOwnNumberOfCoefficients) {
    EXPECT_EQ(built_in_profile("painted")->m, 60);
    EXPECT_EQ(built_in_profile("scanned")->m, 40);
}

TEST(Profile, OfAnUnknownNameIsNone) {
    EXPECT_EQ(built_in_profile("iqdb2").has_value(), false);
    EXPECT_EQ(built_in_profile("").has_value(), false);
}

}  // namespace
}  // namespace haarmony::image
