#include "engine/image/search_arrays.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <tuple>

#include "tests/engine/image/random_signatures.h"

namespace haarmony::image {
namespace {

std::vector<Signature> random_signatures(int count, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<Signature> signatures;
    for (int i = 0; i < count; ++i) {
        signatures.push_back(
            random_signature(random, {.max_count = 50, .max_index = 90}));
    }
    return signatures;
}

SearchArrays arrays_of(const std::vector<Signature>& signatures, int index_m) {
    return SearchArrays(index_m, [&](const auto& sink) {
        for (std::size_t slot = 0; slot < signatures.size(); ++slot) {
            for (int c = 0; c < kChannels; ++c) {
                int rank = 0;
                for (const std::int16_t i :
                     signatures[slot].channels[c].largest(index_m)) {
                    sink(Posting{coefficient_key(c, i), static_cast<int>(slot), rank++});
                }
            }
        }
    });
}

TEST(SearchArrays, CountTheMatchesOfEveryPictureForEveryM) {
    constexpr int kIndexM = 30;
    const std::vector<Signature> signatures = random_signatures(40, 101);
    const SearchArrays arrays = arrays_of(signatures, kIndexM);
    const Profile profile = *built_in_profile("scanned");
    for (int m = 1; m <= kIndexM; ++m) {
        const Query query = make_query(signatures[std::size_t(m)], profile, m);
        std::vector<std::int32_t> matched(signatures.size(), 0);
        arrays.add_matches(query, matched);
        for (std::size_t slot = 0; slot < signatures.size(); ++slot) {
            std::int32_t expected = 0;
            for (const QueryTerm& term : query.terms) {
                for (int c = 0; c < kChannels; ++c) {
                    for (const std::int16_t i : signatures[slot].channels[c].largest(m)) {
                        expected += coefficient_key(c, i) == term.key ? term.weight : 0;
                    }
                }
            }
            ASSERT_EQ(matched[slot], expected) << "m " << m << ", slot " << slot;
        }
    }
}

TEST(SearchArrays, GiveBackEveryPosting) {
    const std::vector<Signature> signatures = random_signatures(25, 102);
    const SearchArrays arrays = arrays_of(signatures, kMaxCoefficients);
    std::set<std::tuple<std::uint32_t, int, int>> expected;
    for (std::size_t slot = 0; slot < signatures.size(); ++slot) {
        for (int c = 0; c < kChannels; ++c) {
            const auto indices = signatures[slot].channels[c].largest(kMaxCoefficients);
            for (std::size_t rank = 0; rank < indices.size(); ++rank) {
                expected.emplace(coefficient_key(c, indices[rank]), int(slot), int(rank));
            }
        }
    }
    std::set<std::tuple<std::uint32_t, int, int>> found;
    std::size_t count = 0;
    arrays.for_each_posting([&](const Posting& posting) {
        found.emplace(posting.key, posting.slot, posting.rank);
        ++count;
    });
    EXPECT_EQ(found, expected);
    EXPECT_EQ(count, expected.size());
}

TEST(SearchArrays, HoldTheLastSlotAndTheLastKey) {
    const Posting last{kKeyCount - 1, kMaxSlots - 1, kMaxCoefficients - 1};
    const SearchArrays arrays(kMaxCoefficients, [&](const auto& sink) { sink(last); });
    Query query;
    query.m = kMaxCoefficients;
    query.terms = {{last.key, 9}};
    std::vector<std::int32_t> matched(kMaxSlots, 0);
    arrays.add_matches(query, matched);
    EXPECT_EQ(matched.back(), 9);
    query.m = kMaxCoefficients - 1;
    arrays.add_matches(query, matched);
    EXPECT_EQ(matched.back(), 9);
}

TEST(SearchArrays, CountTheirBytes) {
    const std::vector<Signature> signatures = random_signatures(25, 103);
    std::int64_t postings = 0;
    for (const Signature& signature : signatures) {
        for (const ChannelSignature& channel : signature.channels)
            postings += channel.count;
    }
    EXPECT_EQ(arrays_of(signatures, kMaxCoefficients).bytes(),
              postings * 3 + 4 * (kKeyCount + 1));
}

}  // namespace
}  // namespace haarmony::image
