#include "engine/image/collection_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "engine/image/profile.h"
#include "tests/engine/image/random_signatures.h"
#include "tests/engine/image/scattered_executor.h"

namespace haarmony::image {
namespace {

// Coefficients of which some are in most pictures, some in a few, many in hardly any: dense
// rows of every tier, coarse rows, and own lists.
Signature popular_signature(std::mt19937& random, int max_count) {
    Signature signature;
    std::geometric_distribution<int> popularity(0.02);
    for (ChannelSignature& channel : signature.channels) {
        channel.average = static_cast<std::int32_t>(random() % 5) * (kAverageOne / 8);
        std::vector<int> taken;
        const int wanted = static_cast<int>(random() % unsigned(max_count + 1));
        for (int tries = 0; tries < 4 * wanted && channel.count < wanted; ++tries) {
            const bool anywhere = random() % 4 == 0;
            const int index =
                1 + (anywhere ? static_cast<int>(random() % (kCoefficientCount - 1))
                              : std::min(popularity(random), kCoefficientCount - 2));
            if (std::ranges::count(taken, index) != 0) continue;
            taken.push_back(index);
            channel.indices[channel.count++] =
                static_cast<std::int16_t>(random() % 3 == 0 ? -index : index);
        }
    }
    return signature;
}

// All scores, picture by picture and term by term.
std::vector<Match> score_literally(const std::vector<Record>& records,
                                   const Query& query) {
    std::vector<std::int64_t> weight(kKeyCount, 0);
    for (const QueryTerm& term : query.terms) weight[term.key] += term.weight;
    std::vector<Match> matches;
    for (const Record& record : records) {
        Score total = query.aspect_weight *
                      std::abs(std::int64_t{query.log_aspect} - record.log_aspect);
        for (int c = 0; c < kChannels; ++c) {
            const ChannelSignature& channel = record.signature.channels[c];
            total += query.average_weight[c] *
                     std::abs(std::int64_t{query.average[c]} - channel.average);
            for (const std::int16_t signed_index : channel.largest(query.m))
                total -= weight[coefficient_key(c, signed_index)] * kAverageOne;
        }
        matches.push_back({record.id, total});
    }
    std::ranges::sort(matches, better);
    return matches;
}

struct Settings {
    int index_m = 60;
    int pictures = 0;
    int segments = 0;
    int max_count = 0;
    unsigned seed = 0;
};

// A collection, and the records that are live in it.
struct Made {
    Collection collection;
    std::vector<Record> live;
};

Made make(const Settings& settings, std::mt19937& random) {
    Made made;
    made.collection.index_m = settings.index_m;
    made.collection.tail = {std::make_shared<Tail>(20), 0, nullptr};
    std::vector<Record> records;
    for (int id = 1; id <= settings.pictures; ++id) {
        const bool copy = id > 1 && random() % 4 == 0;  // ties, crowded blocks
        records.push_back({ImageId{id},
                           copy ? records[random() % records.size()].signature
                                : popular_signature(random, settings.max_count),
                           static_cast<std::int32_t>(random() % 3) * 1000});
    }
    const std::size_t parts = std::size_t(settings.segments) + 1;
    std::vector<std::vector<const Record*>> part(parts);
    for (const Record& record : records) {
        const std::size_t p = random() % parts;
        const bool to_tail = p == parts - 1 && part[p].size() < 20;
        part[to_tail ? p : p % std::size_t(settings.segments)].push_back(&record);
    }
    std::vector<ImageId> removed;
    for (const Record& record : records) {
        if (random() % 5 == 0) {
            removed.push_back(record.id);
        } else {
            made.live.push_back(record);
        }
    }
    for (int s = 0; s < settings.segments; ++s) {
        if (part[std::size_t(s)].empty()) continue;
        made.collection.segments.push_back(
            {Segment::from_records(part[std::size_t(s)], settings.index_m), nullptr});
    }
    auto tail = std::make_shared<Tail>(20);
    auto gone = std::make_shared<Tombstones>(20);
    for (const Record* record : part.back()) {
        const int slot = made.collection.tail.count++;
        tail->write(slot, *record);
        if (std::ranges::count(removed, record->id) != 0) gone->set(slot);
    }
    made.collection.tail.records = tail;
    made.collection.tail.removed = gone;
    remove(made.collection, removed);
    return made;
}

Profile random_profile(std::mt19937& random) {
    Profile profile = *built_in_profile(random() % 2 == 0 ? "painted" : "scanned");
    profile.bin_rule = static_cast<BinRule>(random() % 3);
    if (random() % 3 == 0) {
        const int most = random() % 2 == 0 ? 40 : kMaxWeight;
        for (auto& channel : profile.weights) {
            for (std::int32_t& weight : channel)
                weight = static_cast<std::int32_t>(random() % unsigned(most + 1));
        }
    }
    return profile;
}

class SearchOfACollection : public testing::TestWithParam<Settings> {};

TEST_P(SearchOfACollection, IsThatOfEveryPictureOneByOne) {
    const Settings& settings = GetParam();
    std::mt19937 random(settings.seed);
    const Made made = make(settings, random);
    ScatteredExecutor executor(4);
    for (int round = 0; round < 40; ++round) {
        const Signature asked = round % 2 == 0
                                    ? made.live[random() % made.live.size()].signature
                                    : popular_signature(random, settings.max_count);
        const int m = 1 + static_cast<int>(random() % unsigned(settings.index_m));
        Query query = make_query(
            asked, random_profile(random), round % 3 == 0 ? settings.index_m : m);
        query.log_aspect = 500;
        query.aspect_weight = round % 4 == 0 ? 70 : 0;

        std::vector<Record> wanted = made.live;
        std::vector<ImageId> only_ids;
        if (round % 5 != 0) {
            // Few, so that they are looked up; or most, so that slots are looked at.
            const unsigned share = round % 5 == 1 ? 40 : 2;
            std::erase_if(wanted, [&](const Record&) { return random() % share != 0; });
            for (const Record& record : wanted) only_ids.push_back(record.id);
            only_ids.push_back(ImageId{settings.pictures + 5});
        }
        const IdSet only(only_ids);
        const int limit = static_cast<int>(random() % 30);
        std::vector<Match> expected = score_literally(wanted, query);

        SearchScope scope{limit, only_ids.empty() ? nullptr : &only};
        std::vector<Match> all = score_all(made.collection, query, scope.only);
        std::ranges::sort(all, better);
        ASSERT_EQ(all, expected) << "round " << round;
        expected.resize(std::min(expected.size(), std::size_t(limit)));
        for (const bool exhaustive : {false, true}) {
            for (Executor* const helping :
                 {static_cast<Executor*>(nullptr), static_cast<Executor*>(&executor)}) {
                scope.exhaustive = exhaustive;
                scope.executor = helping;
                const SearchResult found = search(made.collection, query, scope);
                ASSERT_EQ(found.matches, expected)
                    << "round " << round << ", m " << query.m << ", limit " << limit
                    << ", exhaustive " << exhaustive;
                ASSERT_EQ(found.searched, std::int64_t(wanted.size()));
            }
        }
    }
}

std::vector<Settings> all_settings() {
    std::vector<Settings> settings = {{60, 3000, 2, 60, 1},
                                      {60, 900, 3, 100, 2},
                                      {40, 1500, 1, 50, 3},
                                      {20, 700, 2, 30, 4},
                                      {100, 600, 2, 100, 5}};
    // Many small ones: a block that is not full, a segment of one picture.
    for (unsigned seed = 10; seed < 40; ++seed)
        settings.push_back(
            {1 + int(seed * 7 % 100), 1 + int(seed * 37 % 300), 3, 40, seed});
    return settings;
}

INSTANTIATE_TEST_SUITE_P(Collections,
                         SearchOfACollection,
                         testing::ValuesIn(all_settings()),
                         [](const testing::TestParamInfo<Settings>& test) {
                             return "Seed" + std::to_string(test.param.seed);
                         });

// Pictures of few kinds: a query is sure of its own kind, and the blocks of others are not
// visited.
TEST(SearchOfACollection, LeavesOutBlocksThatCannotHoldAMatch) {
    std::mt19937 random(50);
    std::vector<Signature> kinds;
    for (int k = 0; k < 16; ++k) {
        Signature signature;
        for (ChannelSignature& channel : signature.channels) {
            channel.average = k * (kAverageOne / 16);
            for (int i = 0; i < 30; ++i)
                channel.indices[channel.count++] =
                    static_cast<std::int16_t>(1 + k * 100 + i);
        }
        kinds.push_back(signature);
    }
    std::vector<Record> records;
    std::vector<const Record*> pointers;
    for (int id = 1; id <= 16 * kBlockSlots; ++id)
        records.push_back({ImageId{id}, kinds[random() % kinds.size()], 0});
    for (const Record& record : records) pointers.push_back(&record);
    Collection collection;
    collection.index_m = 60;
    collection.tail = {std::make_shared<Tail>(1), 0, nullptr};
    collection.segments.push_back({Segment::from_records(pointers, 60), nullptr});
    const Query query = make_query(kinds[3], *built_in_profile("scanned"), 40);

    const SearchResult found = search(collection, query, {.limit = 20});
    EXPECT_EQ(found.effort.blocks, 16);
    EXPECT_LT(found.effort.blocks_visited, 8);
    EXPECT_LT(found.effort.compared, 8 * kBlockSlots);
    SearchScope everything{.limit = 20};
    everything.exhaustive = true;
    const SearchResult all = search(collection, query, everything);
    EXPECT_EQ(all.matches, found.matches);
    EXPECT_EQ(all.effort.blocks_visited, 16);
    EXPECT_GT(all.effort.rows, found.effort.rows);
}

TEST(SearchOfACollection, OfAFilterVisitsOnlyItsBlocks) {
    std::mt19937 random(51);
    std::vector<Record> records;
    std::vector<const Record*> pointers;
    for (int id = 1; id <= 20 * kBlockSlots; ++id)
        records.push_back({ImageId{id}, popular_signature(random, 40), 0});
    for (const Record& record : records) pointers.push_back(&record);
    Collection collection;
    collection.index_m = 60;
    collection.tail = {std::make_shared<Tail>(1), 0, nullptr};
    collection.segments.push_back({Segment::from_records(pointers, 60), nullptr});
    const std::vector<ImageId> ids = {ImageId{17}, ImageId{4000}};
    const IdSet only(ids);
    const SearchResult found =
        search(collection,
               make_query(records[100].signature, *built_in_profile("painted"), 60),
               {.limit = 5, .only = &only});
    EXPECT_EQ(found.searched, 2);
    EXPECT_EQ(found.matches.size(), 2U);
    EXPECT_LE(found.effort.blocks_visited, 2);
    EXPECT_EQ(found.effort.compared, 2);
}

}  // namespace
}  // namespace haarmony::image
