#include "engine/image/best_of.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "engine/image/metric.h"
#include "tests/engine/image/random_signatures.h"

namespace haarmony::image {
namespace {

constexpr SignatureShape kShape{.max_count = 30, .max_index = 60, .average_steps = 2};
constexpr int kM = 20;

struct Asked {
    Signature signature;
    Profile profile;
    const std::vector<Record>* pictures;
};

std::vector<Record> random_records(std::mt19937& random, int count, int first_id) {
    std::vector<Record> records;
    for (int i = 0; i < count; ++i) {
        records.push_back({ImageId{first_id + i}, random_signature(random, kShape)});
    }
    return records;
}

// Equation (4.3) of every picture in every way, and the smallest for each.
std::vector<BestMatch> best_literally(const std::vector<Asked>& asked) {
    std::vector<BestMatch> best;
    for (std::size_t way = 0; way < asked.size(); ++way) {
        for (const Record& record : *asked[way].pictures) {
            const Score distance =
                metric(asked[way].signature, record.signature, asked[way].profile, kM);
            auto known = std::ranges::find(best, record.id, &BestMatch::id);
            if (known == best.end()) {
                best.push_back({record.id, distance, way, 0});
            } else if (distance < known->distance) {
                *known = {record.id, distance, way, 0};
            }
        }
    }
    std::ranges::sort(best, [](const BestMatch& a, const BestMatch& b) {
        return a.distance != b.distance ? a.distance < b.distance : a.id < b.id;
    });
    return best;
}

// Two collections that share half their pictures' ids, asked in three ways.
class SeveralWays : public testing::Test {
  protected:
    SeveralWays() {
        for (const Asked& asked : asked_) {
            queries_.push_back(make_query(asked.signature, asked.profile, kM));
        }
        ways_ = {{snapshots_[0].get(), &queries_[0]},
                 {snapshots_[0].get(), &queries_[1]},
                 {snapshots_[1].get(), &queries_[2]}};
    }

    std::mt19937 random_{181};
    std::vector<Record> pictures_ = random_records(random_, 40, 1);
    std::vector<Record> others_ = random_records(random_, 40, 21);
    Index first_{{.index_m = kM, .tail_capacity = 10}};
    Index second_{{.index_m = kM, .tail_capacity = 10}};
    std::vector<Asked> asked_ = {
        {random_signature(random_, kShape), *built_in_profile("painted"), &pictures_},
        {random_signature(random_, kShape), *built_in_profile("painted"), &pictures_},
        {random_signature(random_, kShape), *built_in_profile("scanned"), &others_}};
    std::vector<Query> queries_;
    std::vector<std::shared_ptr<const IndexSnapshot>> snapshots_ = fill();
    std::vector<Way> ways_;

  private:
    std::vector<std::shared_ptr<const IndexSnapshot>> fill() {
        first_.apply(pictures_, {});
        second_.apply(others_, {});
        return {first_.snapshot(), second_.snapshot()};
    }
};

TEST_F(SeveralWays, GiveEachPictureItsSmallestDistance) {
    const std::vector<BestMatch> expected = best_literally(asked_);
    for (int limit = 0; limit <= 65; limit += 5) {
        const BestResult found = search_best(ways_, {limit});
        ASSERT_EQ(found.matches.size(), std::min<std::size_t>(limit, expected.size()));
        for (std::size_t i = 0; i < found.matches.size(); ++i) {
            const BestMatch& match = found.matches[i];
            EXPECT_EQ(match.id, expected[i].id) << "limit " << limit << ", place " << i;
            EXPECT_EQ(match.distance, expected[i].distance);
            EXPECT_EQ(match.way, expected[i].way);
            EXPECT_EQ(full_distance(queries_[match.way], match.score), match.distance);
        }
        EXPECT_EQ(found.searched, 40);
    }
}

TEST_F(SeveralWays, ScoreEveryPictureOnce) {
    std::vector<BestMatch> expected = best_literally(asked_);
    std::ranges::sort(expected, {}, &BestMatch::id);
    const std::vector<BestMatch> found = score_all_best(ways_, nullptr);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].id, expected[i].id);
        EXPECT_EQ(found[i].distance, expected[i].distance);
        EXPECT_EQ(found[i].way, expected[i].way);
    }
}

TEST_F(SeveralWays, StayWithinTheFilter) {
    const std::vector<ImageId> wanted = {ImageId{2}, ImageId{30}, ImageId{60}};
    const IdSet only(wanted);
    std::vector<ImageId> found;
    for (const BestMatch& match : score_all_best(ways_, &only)) found.push_back(match.id);
    EXPECT_EQ(found, wanted);
    EXPECT_EQ(search_best(ways_, {10, &only}).matches.size(), 3U);
    EXPECT_EQ(search_best(ways_, {10, &only}).searched, 2);
}

TEST(BestOf, ReportsTheEarlierOfTwoEqualWays) {
    Index index({});
    index.apply(std::vector{Record{ImageId{1}, {}}}, {});
    const auto snapshot = index.snapshot();
    const Query query = make_query({}, *built_in_profile("painted"), 1);
    const std::vector<Way> ways(3, Way{snapshot.get(), &query});
    const BestResult found = search_best(ways, {5});
    ASSERT_EQ(found.matches.size(), 1U);
    EXPECT_EQ(found.matches[0].way, 0U);
}

}  // namespace
}  // namespace haarmony::image
