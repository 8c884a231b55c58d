#include "engine/image/bit_sums.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "tests/engine/image/bit_planes.h"
#include "tests/engine/image/each_target.h"

namespace haarmony::image {
namespace {

// Rows that end where the blocks do, so that a sanitizer sees whoever reads on.
class RandomRows {
  public:
    RandomRows(std::size_t count, std::size_t words, std::mt19937_64& random) {
        for (std::size_t row = 0; row < count; ++row) {
            std::vector<std::uint64_t>& bits = rows_.emplace_back(words);
            // Full rows carry furthest; empty and sparse ones hide what is read twice least.
            const std::uint64_t kind = random() % 8;
            for (std::uint64_t& word : bits) {
                word = kind < 3    ? ~std::uint64_t{0}
                       : kind == 3 ? 0
                       : kind == 4 ? random() & random() & random()
                                   : random();
            }
        }
        for (const auto& row : rows_) begins_.push_back(row.data());
    }

    [[nodiscard]] std::span<const std::uint64_t* const> begins() const { return begins_; }
    [[nodiscard]] bool test(std::size_t row, std::size_t bit) const {
        return (rows_[row][bit / 64] & (std::uint64_t{1} << (bit % 64))) != 0;
    }
    void fill() {
        for (auto& row : rows_) std::ranges::fill(row, ~std::uint64_t{0});
    }

  private:
    std::vector<std::vector<std::uint64_t>> rows_;
    std::vector<const std::uint64_t*> begins_;
};

// The definition: slot by slot, row by row.
void add_literally(const RandomRows& rows,
                   std::span<const std::uint32_t> weights,
                   std::size_t offset,
                   int blocks,
                   Sums& sums) {
    for (std::size_t slot = 0; slot < std::size_t(blocks) * kBlockSlots; ++slot) {
        for (std::size_t row = 0; row < weights.size(); ++row) {
            if (rows.test(row, offset * 64 + slot)) sums[slot] += weights[row];
        }
    }
}

struct Shape {
    int blocks = 1;
    std::size_t offset = 0;
    std::uint32_t most_before = 0;
    bool full = false;  // all bits of all rows
};

// The scalar code and that of every target give the literal sums, and touch nothing else.
void expect_literal_sums(const std::vector<std::uint32_t>& weights,
                         const Shape& shape,
                         std::mt19937_64& random) {
    const BitSumPlan plan(weights, shape.most_before);
    RandomRows rows(
        weights.size(), shape.offset + std::size_t(shape.blocks) * kBlockWords, random);
    if (shape.full) rows.fill();
    int first_planes = 0;
    while (shape.most_before >> first_planes != 0) ++first_planes;

    Sums sums = random_sums(shape.most_before, random);
    if (shape.full) std::ranges::fill(sums, shape.most_before);
    const BitSumsPtr before = random_planes(random);
    write(sums, first_planes, *before);
    add_literally(rows, weights, shape.offset, shape.blocks, sums);
    sums.resize(std::size_t(shape.blocks) * kBlockSlots);
    const BitSumsPtr expected = copy_of(*before);
    write(sums, plan.planes(), *expected);

    const auto expect = [&](const BitSums& actual, const char* name) {
        ASSERT_EQ(first_difference(actual, *expected), "none")
            << name << ", " << weights.size() << " rows, the first of weight "
            << (weights.empty() ? 0 : weights.front()) << ", " << shape.blocks
            << " blocks, offset " << shape.offset << ", before " << shape.most_before;
    };
    const BitSumsPtr scalar = copy_of(*before);
    add_rows_scalar(
        plan, rows.begins(), shape.offset, shape.blocks, first_planes, *scalar);
    expect(*scalar, "scalar");
    for_each_target([&](const char* name) {
        const BitSumsPtr vector = copy_of(*before);
        // What is asked for ahead changes nothing.
        add_rows(plan,
                 rows.begins(),
                 shape.offset,
                 shape.blocks,
                 first_planes,
                 {0, shape.blocks},
                 *vector);
        expect(*vector, name);
    });
}

// Random weights whose sum is `total` exactly.
std::vector<std::uint32_t> random_weights(std::size_t count,
                                          std::uint32_t total,
                                          std::mt19937_64& random) {
    std::vector<std::uint32_t> cuts(count - 1);
    for (std::uint32_t& cut : cuts)
        cut = static_cast<std::uint32_t>(random() % (total + 1U));
    std::ranges::sort(cuts);
    cuts.push_back(total);
    std::vector<std::uint32_t> weights(count);
    std::adjacent_difference(cuts.begin(), cuts.end(), weights.begin());
    return weights;
}

// Around the groups of eight that are added at once, and around what a pair leaves over.
constexpr std::size_t kRowCounts[] = {0,  1,  2,  3,  6,  7,  8,  9,  10,  14, 15,
                                      16, 17, 23, 24, 25, 63, 64, 65, 511, 512};

TEST(AddRows, OfOneColumnIsTheLiteralSum) {
    std::mt19937_64 random(401);
    for (const std::size_t count : kRowCounts) {
        for (const std::uint32_t weight : {1U, 2U, 64U}) {
            const std::vector<std::uint32_t> weights(count, weight);
            expect_literal_sums(weights, {.blocks = 1}, random);
            expect_literal_sums(weights, {.blocks = 3, .full = true}, random);
        }
    }
}

TEST(AddRows, OfAnyWeightsIsTheLiteralSum) {
    std::mt19937_64 random(402);
    for (const std::size_t count : kRowCounts) {
        if (count == 0) continue;
        for (const std::uint32_t total : {7U, 1000U, kLargestSum}) {
            const auto weights = random_weights(count, total, random);
            expect_literal_sums(weights, {.blocks = 2}, random);
            expect_literal_sums(weights, {.blocks = 1, .full = true}, random);
        }
    }
}

TEST(AddRows, HoldsForEveryNumberOfBlocksAndEveryOffset) {
    std::mt19937_64 random(403);
    for (int blocks = 1; blocks <= kBlocksAtOnce; ++blocks) {
        for (const std::size_t offset : {0, 1, 4, 33}) {
            const auto weights = random_weights(37, 9000, random);
            expect_literal_sums(weights, {blocks, offset}, random);
            expect_literal_sums(weights, {blocks, offset, 500}, random);
        }
    }
}

TEST(AddRows, AddsToWhatTheSumsBeginWith) {
    std::mt19937_64 random(404);
    for (const std::uint32_t before : {1U, 2U, 255U, 256U, 40'000U, kLargestSum - 1}) {
        for (const std::size_t count : {1U, 7U, 9U, 100U}) {
            for (const std::uint32_t most : {1U, kLargestSum - before}) {
                const auto weights = random_weights(count, most, random);
                expect_literal_sums(weights, {2, 4, before}, random);
                expect_literal_sums(weights, {1, 0, before, true}, random);
            }
        }
        expect_literal_sums({}, {2, 0, before}, random);
    }
}

TEST(AddRows, ReachesTheLargestSum) {
    std::mt19937_64 random(405);
    std::vector<std::uint32_t> powers;
    for (int p = 0; p < kMaxPlanes; ++p) powers.push_back(1U << p);
    // 511 rows of seven ones each and one that has all the rest: the fullest columns.
    std::vector<std::uint32_t> crowded(kMaxRows, 127);
    crowded.back() += kLargestSum - kMaxRows * 127;
    for (const std::vector<std::uint32_t>& weights :
         {std::vector<std::uint32_t>{kLargestSum},
          {0, kLargestSum, 0},
          {32'768, 32'767},
          powers,
          crowded}) {
        expect_literal_sums(weights, {.blocks = kBlocksAtOnce}, random);
        expect_literal_sums(weights, {.blocks = 1, .full = true}, random);
    }
}

TEST(AddRows, OfWeight0AddNothing) {
    std::mt19937_64 random(406);
    for (const std::uint32_t before : {0U, 77U}) {
        for (const std::size_t count : {1U, 9U, 512U}) {
            expect_literal_sums(
                std::vector<std::uint32_t>(count, 0), {2, 0, before, true}, random);
        }
    }
}

TEST(AddRows, OfAPlanOfNothingTouchesNothing) {
    std::mt19937_64 random(407);
    const BitSumsPtr before = random_planes(random);
    const BitSumsPtr after = copy_of(*before);
    EXPECT_EQ(BitSumPlan().planes(), 0);
    add_rows(BitSumPlan(), {}, 0, kBlocksAtOnce, 0, {}, *after);
    EXPECT_EQ(first_difference(*after, *before), "none");
}

TEST(BitSumPlan, HasEachRowInTheColumnsOfItsOnes) {
    std::mt19937_64 random(408);
    for (const std::size_t count : {1U, 5U, 300U, 512U}) {
        const auto weights = random_weights(count, kLargestSum - 9, random);
        const BitSumPlan plan(weights, 9);
        std::vector<std::uint32_t> gathered(count, 0);
        for (int p = 0; p < plan.planes(); ++p) {
            const auto column = plan.column(p);
            EXPECT_TRUE(std::ranges::is_sorted(column)) << p;
            for (const std::uint16_t row : column) gathered[row] += 1U << p;
        }
        EXPECT_EQ(gathered, weights);
    }
}

TEST(BitSumPlan, HasThePlanesOfTheLargestSum) {
    for (std::uint32_t most = 0; most <= kLargestSum; most = most * 2 + 1) {
        for (const std::uint32_t total : {most, most / 2 + 1}) {
            const int planes =
                BitSumPlan(std::array{total / 3, total - total / 3}, 0).planes();
            EXPECT_LT(total, 1U << planes);
            EXPECT_TRUE(planes == 0 || total >= 1U << (planes - 1)) << total;
            EXPECT_EQ(BitSumPlan(std::array{total / 3}, total - total / 3).planes(),
                      planes);
            EXPECT_EQ(BitSumPlan({}, total).planes(), planes);
        }
    }
}

// As a segment is searched: rows that four slots share first, then those of each slot.
TEST(Spread, SumsOfGroupsAreWhatTheSlotsBeginWith) {
    std::mt19937_64 random(412);
    const auto coarse_weights = random_weights(11, 3000, random);
    const auto fine_weights = random_weights(60, 20'000, random);
    const RandomRows coarse(coarse_weights.size(), 2 * kBlockWords, random);
    const RandomRows fine(fine_weights.size(), kBlocksAtOnce * kBlockWords, random);
    const BitSumPlan coarse_plan(coarse_weights, 0);
    const BitSumPlan fine_plan(fine_weights, 3000);
    for_each_target([&](const char* name) {
        const BitSumsPtr groups = random_planes(random);
        const BitSumsPtr sums = random_planes(random);
        add_rows(coarse_plan, coarse.begins(), 0, 2, 0, {}, *groups);
        const int begun = coarse_plan.planes();
        for (int block = 0; block < kBlocksAtOnce; ++block)
            spread(*groups, begun, block / 4, block % 4, block, *sums);
        add_rows(fine_plan, fine.begins(), 0, kBlocksAtOnce, begun, {}, *sums);
        for (std::size_t slot = 0; slot < kSlotsAtOnce; ++slot) {
            std::uint32_t expected = 0;
            for (std::size_t row = 0; row < coarse_weights.size(); ++row)
                expected += coarse.test(row, slot / 4) ? coarse_weights[row] : 0;
            for (std::size_t row = 0; row < fine_weights.size(); ++row)
                expected += fine.test(row, slot) ? fine_weights[row] : 0;
            ASSERT_EQ(sums->at(int(slot), fine_plan.planes()), expected)
                << name << ", slot " << slot;
        }
    });
}

}  // namespace
}  // namespace haarmony::image
