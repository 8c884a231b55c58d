#include "server/app/image_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>
#include <vector>

#include "engine/image/query.h"
#include "engine/image/segment.h"
#include "ingest/variant.h"
#include "tests/server/app/collection.h"

namespace haarmony::server {
namespace {

// An index that says what a test wants: ids 1..count, scores rising with the id. It counts
// how often it is asked.
class FixedSnapshot final : public image::IndexSnapshot {
  public:
    explicit FixedSnapshot(std::int64_t count) : count_(count) {}

    image::SearchResult search(const image::Query& query,
                               const image::SearchScope& scope) const override {
        ++searches;
        image::SearchResult result{score_all(query, scope.only), count_};
        if (count_ > scope.limit) result.matches.resize(std::size_t(scope.limit));
        return result;
    }
    std::vector<image::Match> score_all(const image::Query& /*query*/,
                                        const image::IdSet* /*only*/) const override {
        std::vector<image::Match> matches;
        for (std::int64_t id = 1; id <= count_; ++id)
            matches.push_back({ImageId{id}, score_of(id)});
        return matches;
    }
    image::IndexStats stats() const override { return {}; }
    std::vector<image::LiveSegment> sealed() const override { return {}; }

    static image::Score score_of(std::int64_t id) {
        return -900'000'000 + id * 30'000'000;
    }
    mutable int searches = 0;

  private:
    std::int64_t count_;
};

class ImageSearchTest : public testing::Test {
  protected:
    ImageSearchTest()
        : readers_([this] {
              return Connection::open(collection_.path(),
                                      schema::Database::Mode::kReadOnly);
          }) {
        const auto connection = beside(collection_);
        for (int i = 0; i < kRows; ++i) {
            schema::NewImage row = file_row(7, "file:///p/" + std::to_string(i));
            EXPECT_TRUE(connection->images().add(row));
        }
        const image::Signature signature =
            image::make_signature(image::scene(64, 64, 3).view());
        picture_.signatures = {{signature.kind, {signature}}};
        options_.profiles = {*image::built_in_profile("painted")};
        query_ = image::make_query(signature, options_.profiles.front(), 60);
    }

    [[nodiscard]] SearchPlan plan_over(
        const std::shared_ptr<const FixedSnapshot>& snapshot) const {
        auto plan =
            SearchPlan::make(picture_, options_, {{ingest::kMainVariant, snapshot}}, 60);
        EXPECT_TRUE(plan);
        return std::move(plan).value();
    }

    void remove(const std::set<std::int64_t>& ids) {
        const auto connection = beside(collection_);
        for (const std::int64_t id : ids)
            EXPECT_TRUE(connection->images().remove(ImageId{id}));
    }

    // What should come: the snapshot's order without those that are gone.
    static std::vector<std::int64_t> expected(const std::set<std::int64_t>& gone,
                                              int limit) {
        std::vector<std::int64_t> ids;
        for (std::int64_t id = 1; id <= kRows; ++id)
            if (!gone.contains(id) && static_cast<int>(ids.size()) < limit)
                ids.push_back(id);
        return ids;
    }

    static std::vector<std::int64_t> ids_of(const Found& found) {
        std::vector<std::int64_t> ids;
        for (const FoundImage& image : found.images)
            ids.push_back(to_int(image.image.id));
        return ids;
    }

    static constexpr int kRows = 20;
    Collection collection_;
    ReadConnections readers_;
    QueryPicture picture_;
    PlanOptions options_;
    image::Query query_;
};

TEST_F(ImageSearchTest, TellsRowsAndDistancesOfTheMatches) {
    const auto snapshot = std::make_shared<FixedSnapshot>(kRows);
    const auto found = search_images(plan_over(snapshot), 3, nullptr, nullptr, readers_);
    ASSERT_TRUE(found);
    EXPECT_EQ(ids_of(found.value()), expected({}, 3));
    EXPECT_EQ(found->searched, kRows);
    EXPECT_EQ(snapshot->searches, 1);
    for (const FoundImage& image : found->images) {
        const image::Score score = FixedSnapshot::score_of(to_int(image.image.id));
        EXPECT_EQ(image.match.distance, image::distance(query_, score));
        EXPECT_EQ(image.match.similarity, image::similarity(query_, score));
        EXPECT_EQ(image.image.uri,
                  "file:///p/" + std::to_string(to_int(image.image.id) - 1));
    }
}

TEST_F(ImageSearchTest, RowsThatVanishedAreReplacedByTheNextBest) {
    const std::vector<std::set<std::int64_t>> cases{
        {1},
        {5},
        {1, 2, 3},
        {2, 4, 6, 8, 10, 12},
        {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}};
    std::set<std::int64_t> gone;
    for (const auto& more : cases) {
        std::set<std::int64_t> fresh;
        std::set_difference(more.begin(),
                            more.end(),
                            gone.begin(),
                            gone.end(),
                            std::inserter(fresh, fresh.end()));
        remove(fresh);
        gone.insert(fresh.begin(), fresh.end());
        for (const int limit : {1, 5, 8, kRows, 1000}) {
            const auto snapshot = std::make_shared<FixedSnapshot>(kRows);
            const auto found =
                search_images(plan_over(snapshot), limit, nullptr, nullptr, readers_);
            ASSERT_TRUE(found);
            EXPECT_EQ(ids_of(found.value()), expected(gone, limit))
                << gone.size() << " gone, limit " << limit;
        }
    }
}

TEST_F(ImageSearchTest, NothingLeftIsAnEmptyAnswer) {
    remove({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20});
    const auto snapshot = std::make_shared<FixedSnapshot>(kRows);
    const auto found = search_images(plan_over(snapshot), 5, nullptr, nullptr, readers_);
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->images.empty());
}

TEST_F(ImageSearchTest, MinSimilarityCutsTheTail) {
    remove({2});
    const auto snapshot = std::make_shared<FixedSnapshot>(kRows);
    for (std::int64_t last = 1; last <= kRows; ++last) {
        const double least = image::similarity(query_, FixedSnapshot::score_of(last));
        options_.min_similarity = least;
        const auto found =
            search_images(plan_over(snapshot), 6, nullptr, nullptr, readers_);
        ASSERT_TRUE(found);
        std::vector<std::int64_t> wanted;
        for (const std::int64_t id : expected({2}, 6))
            if (image::similarity(query_, FixedSnapshot::score_of(id)) >= least)
                wanted.push_back(id);
        EXPECT_EQ(ids_of(found.value()), wanted) << "at least " << least;
    }
}

TEST_F(ImageSearchTest, AConnectionThatCannotBeHadIsAnError) {
    ReadConnections broken([]() -> Result<std::unique_ptr<Connection>> {
        return Error{ErrorCode::kIo, "no connection"};
    });
    const auto found = search_images(
        plan_over(std::make_shared<FixedSnapshot>(kRows)), 5, nullptr, nullptr, broken);
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().message, "no connection");
}

}  // namespace
}  // namespace haarmony::server
