#include "engine/image/picture_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>
#include <set>

#include "engine/image/query.h"

namespace haarmony::image {
namespace {

struct Pictures {
    std::vector<PictureTerms> terms;
    std::vector<CoarseSigns> signs;
    std::vector<int> group;  // what they were planted as

    [[nodiscard]] std::size_t size() const { return terms.size(); }
    [[nodiscard]] std::vector<std::uint32_t> order() const {
        return picture_order(terms, signs);
    }
};

std::int32_t random_average(std::mt19937& random) {
    return static_cast<std::int32_t>(random() % (1U << 24));
}

PictureTerms random_terms(std::mt19937& random) {
    return {{random_average(random), random_average(random), random_average(random)}, 0};
}

CoarseSigns random_signs(std::mt19937& random) {
    CoarseSigns signs;
    for (int bit = 0; bit < CoarseSigns::kCount; ++bit) {
        if (random() % 3 == 0) signs.set(bit);
    }
    return signs;
}

Pictures random_pictures(std::size_t count, std::mt19937& random) {
    Pictures pictures;
    for (std::size_t i = 0; i < count; ++i) {
        pictures.terms.push_back(random_terms(random));
        pictures.signs.push_back(random_signs(random));
    }
    return pictures;
}

enum class Differ { kInAverages, kInSigns, kInBoth };

// Groups of those sizes, shuffled; the pictures of a group are the same.
Pictures planted(const std::vector<std::size_t>& sizes,
                 Differ differ,
                 std::mt19937& random) {
    std::vector<int> group;
    for (std::size_t g = 0; g < sizes.size(); ++g)
        group.insert(group.end(), sizes[g], static_cast<int>(g));
    std::ranges::shuffle(group, random);
    const PictureTerms same_terms = random_terms(random);
    const CoarseSigns same_signs = random_signs(random);
    std::vector<PictureTerms> terms;
    std::vector<CoarseSigns> signs;
    for (std::size_t g = 0; g < sizes.size(); ++g) {
        terms.push_back(differ == Differ::kInSigns ? same_terms : random_terms(random));
        signs.push_back(differ == Differ::kInAverages ? same_signs
                                                      : random_signs(random));
    }
    Pictures pictures;
    for (const int g : group) {
        pictures.terms.push_back(terms[std::size_t(g)]);
        pictures.signs.push_back(signs[std::size_t(g)]);
    }
    pictures.group = std::move(group);
    return pictures;
}

void expect_permutation(const Pictures& pictures) {
    std::vector<std::uint32_t> order = pictures.order();
    std::ranges::sort(order);
    std::vector<std::uint32_t> all(pictures.size());
    std::iota(all.begin(), all.end(), 0U);
    EXPECT_EQ(order, all) << pictures.size() << " pictures";
}

TEST(PictureOrder, HasEveryPictureOnce) {
    std::mt19937 random(421);
    for (const std::size_t count : {0U, 1U, 2U, 255U, 256U, 257U, 511U, 513U, 5000U})
        expect_permutation(random_pictures(count, random));
}

TEST(PictureOrder, EndsWhereAllPicturesAreEqual) {
    std::mt19937 random(422);
    for (const std::size_t count : {1U, 256U, 257U, 5000U})
        expect_permutation(planted({count}, Differ::kInBoth, random));
}

// No sample of a node need show what few of its pictures have.
TEST(PictureOrder, EndsWhereFewPicturesDiffer) {
    std::mt19937 random(423);
    for (int run = 0; run < 20; ++run) {
        expect_permutation(planted({4998, 1, 1}, Differ::kInBoth, random));
        expect_permutation(planted({4999, 1}, Differ::kInAverages, random));
    }
}

TEST(PictureOrder, BearsTheLargestAverages) {
    std::mt19937 random(424);
    Pictures pictures = random_pictures(2000, random);
    for (PictureTerms& terms : pictures.terms) {
        for (std::int32_t& average : terms.average) {
            average = random() % 2 == 0 ? std::numeric_limits<std::int32_t>::min()
                                        : std::numeric_limits<std::int32_t>::max();
        }
    }
    expect_permutation(pictures);
}

TEST(PictureOrder, BlocksOfGroupsAreOfOneGroup) {
    std::mt19937 random(425);
    for (const Differ differ : {Differ::kInAverages, Differ::kInSigns, Differ::kInBoth}) {
        for (const std::vector<std::size_t>& sizes : {std::vector<std::size_t>(2, 256),
                                                      std::vector<std::size_t>(3, 256),
                                                      std::vector<std::size_t>(21, 256),
                                                      {512, 256, 1024, 256, 768}}) {
            const Pictures pictures = planted(sizes, differ, random);
            const std::vector<std::uint32_t> order = pictures.order();
            for (std::size_t i = 0; i < order.size(); ++i) {
                const std::size_t first = i / kBlockSlots * kBlockSlots;
                ASSERT_EQ(pictures.group[order[i]], pictures.group[order[first]])
                    << "place " << i << " of " << order.size() << ", groups differ in "
                    << int(differ);
            }
        }
    }
}

TEST(PictureOrder, EachChannelAloneTellsGroupsApart) {
    std::mt19937 random(428);
    for (std::size_t channel = 0; channel < kChannels; ++channel) {
        Pictures pictures =
            planted(std::vector<std::size_t>(9, 256), Differ::kInAverages, random);
        const PictureTerms same = random_terms(random);
        for (PictureTerms& terms : pictures.terms) {
            const std::int32_t own = terms.average[channel];
            terms = same;
            terms.average[channel] = own;
        }
        const std::vector<std::uint32_t> order = pictures.order();
        for (std::size_t i = 0; i < order.size(); ++i) {
            const std::size_t first = i / kBlockSlots * kBlockSlots;
            ASSERT_EQ(pictures.group[order[i]], pictures.group[order[first]])
                << "channel " << channel << ", place " << i;
        }
    }
}

TEST(PictureOrder, GroupsOfSignsStayTogetherWhateverTheirSizes) {
    std::mt19937 random(426);
    std::vector<std::size_t> sizes;
    for (int group = 0; group < 12; ++group) sizes.push_back(257 + random() % 300);
    const Pictures pictures = planted(sizes, Differ::kInSigns, random);
    const std::vector<std::uint32_t> order = pictures.order();
    std::size_t changes = 0;
    for (std::size_t i = 1; i < order.size(); ++i)
        changes += pictures.group[order[i]] != pictures.group[order[i - 1]] ? 1 : 0;
    EXPECT_EQ(changes, sizes.size() - 1);
}

// The pictures of a block lie closer than those of a block of another order.
TEST(PictureOrder, NarrowsTheAveragesOfEveryChannelAndTheSignsOfBlocks) {
    std::mt19937 random(427);
    Pictures pictures = random_pictures(64 * kBlockSlots, random);
    // Signs as pictures have them: few, and the same ones where the colours are alike.
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        CoarseSigns signs;
        for (int bit = 0; bit < CoarseSigns::kCount; ++bit) {
            const bool bright = pictures.terms[i].average[bit % 3] > 1 << 23;
            if (random() % 8 < (bright ? 7U : 1U)) signs.set(bit);
        }
        pictures.signs[i] = signs;
    }
    struct Spread {
        std::array<double, kChannels> range{};  // of averages, over all blocks
        double mixed = 0;  // pairs in a block that a sign tells apart
    };
    const auto spread_of = [&](const std::vector<std::uint32_t>& order) {
        Spread spread;
        for (std::size_t first = 0; first < order.size(); first += kBlockSlots) {
            const auto block = std::span(order).subspan(first, kBlockSlots);
            for (int c = 0; c < kChannels; ++c) {
                const auto [low, high] =
                    std::ranges::minmax(block, {}, [&](std::uint32_t picture) {
                        return pictures.terms[picture].average[std::size_t(c)];
                    });
                spread.range[std::size_t(c)] +=
                    double(pictures.terms[high].average[std::size_t(c)]) -
                    double(pictures.terms[low].average[std::size_t(c)]);
            }
            for (int bit = 0; bit < CoarseSigns::kCount; ++bit) {
                const auto with =
                    std::ranges::count_if(block, [&](std::uint32_t picture) {
                        return pictures.signs[picture].test(bit);
                    });
                spread.mixed += double(with) * double(kBlockSlots - with);
            }
        }
        return spread;
    };
    std::vector<std::uint32_t> as_given(pictures.size());
    std::iota(as_given.begin(), as_given.end(), 0U);
    const Spread given = spread_of(as_given);
    const Spread ordered = spread_of(pictures.order());
    for (std::size_t c = 0; c < kChannels; ++c)
        EXPECT_LT(ordered.range[c], given.range[c]) << "channel " << c;
    EXPECT_LT(ordered.mixed, given.mixed);
}

// By the definition: each place below row and column 4, but for the mean, with each sign.
TEST(CoarseSigns, HaveABitForEachCoarseKeyAndNoOther) {
    std::set<int> bits;
    for (int channel = 0; channel < kChannels; ++channel) {
        for (int row = 0; row < kSide; ++row) {
            for (int column = 0; column < kSide; ++column) {
                const int index = row * kSide + column;
                if (index == 0) continue;
                const bool coarse = row < 4 && column < 4;
                for (const int signed_index : {index, -index}) {
                    const int bit =
                        CoarseSigns::bit_of(coefficient_key(channel, signed_index));
                    if (!coarse) {
                        ASSERT_EQ(bit, -1) << row << ' ' << column;
                        continue;
                    }
                    ASSERT_GE(bit, 0) << row << ' ' << column;
                    ASSERT_LT(bit, CoarseSigns::kCount) << row << ' ' << column;
                    ASSERT_TRUE(bits.insert(bit).second) << row << ' ' << column;
                }
            }
        }
    }
    EXPECT_EQ(bits.size(), std::size_t{CoarseSigns::kCount});
}

TEST(CoarseSigns, HaveNoBitForTheMean) {
    for (int list = 0; list < 2 * kChannels; ++list) {
        EXPECT_EQ(
            CoarseSigns::bit_of(static_cast<std::uint32_t>(list * kCoefficientCount)),
            -1);
    }
}

TEST(CoarseSigns, HaveABitWhereTheySay) {
    for (std::uint32_t key = 0; key < std::uint32_t{kKeyCount}; ++key)
        ASSERT_EQ(CoarseSigns::has_bit(key), CoarseSigns::bit_of(key) >= 0) << key;
}

TEST(CoarseSigns, HoldWhatWasSet) {
    for (int set = 0; set < CoarseSigns::kCount; ++set) {
        CoarseSigns signs;
        signs.set(set);
        signs.set(set);
        for (int bit = 0; bit < CoarseSigns::kCount; ++bit)
            ASSERT_EQ(signs.test(bit), bit == set) << set << ' ' << bit;
        EXPECT_EQ(signs.words()[std::size_t(set) / 64], std::uint64_t{1} << (set % 64));
        EXPECT_EQ(signs.words()[1 - std::size_t(set) / 64], 0U);
    }
}

}  // namespace
}  // namespace haarmony::image
