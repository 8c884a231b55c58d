#include "server/app/cluster_overview.h"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "engine/image/signature_codec.h"
#include "ingest/describe.h"
#include "tests/schema/raw_sql.h"
#include "tests/server/app/collection.h"

namespace haarmony::server {
namespace {

class ClusterOverviewTest : public testing::Test {
  protected:
    ClusterOverviewTest() {
        collection_.open();
        for (unsigned number = 1; number <= 9; ++number)
            ids_.push_back(collection_.add(number % 3 + 1, {"", {tag(number)}, "{}"}));
        overview_ = std::make_unique<ClusterOverview>(
            collection_.path(), collection_.service->index(), 1);
    }

    static std::string tag(unsigned number) { return number % 2 == 0 ? "even" : "odd"; }
    static OverviewOptions options(int count) {
        OverviewOptions options;
        options.profile = *image::built_in_profile("painted");
        options.count = count;
        return options;
    }
    Overview make(const OverviewOptions& options) {
        return overview_->make(options).value();
    }

    Collection collection_;
    std::vector<ImageId> ids_;
    std::unique_ptr<ClusterOverview> overview_;
};

TEST_F(ClusterOverviewTest, SaysWhatTheEngineSays) {
    std::vector<image::Record> records;
    for (const ImageId id : ids_)
        records.push_back({id, collection_.service->signature(id).value(), 0});
    InlineExecutor executor;
    for (const int count : {1, 2, 3}) {
        image::ClusterOptions wanted;
        wanted.count = count;
        const image::Clustering expected =
            image::find_clusters(records, options(count).profile, wanted, executor);
        const Overview overview = make(options(count));
        EXPECT_EQ(overview.cost, expected.cost);
        EXPECT_EQ(overview.searched, 9);
        ASSERT_EQ(overview.clusters.size(), expected.clusters.size());
        for (std::size_t i = 0; i < expected.clusters.size(); ++i) {
            const OverviewCluster& cluster = overview.clusters[i];
            EXPECT_EQ(cluster.representative.id, expected.clusters[i].medoid);
            EXPECT_EQ(cluster.size,
                      static_cast<std::int64_t>(expected.clusters[i].members.size()));
            std::set<ImageId> members;
            for (const schema::Image& image : cluster.members) members.insert(image.id);
            for (const image::ClusterMember& member : expected.clusters[i].members)
                EXPECT_TRUE(members.contains(member.id));
        }
    }
}

TEST_F(ClusterOverviewTest, ListsTheRepresentativeFirstAndNoMoreThanAskedFor) {
    OverviewOptions wanted = options(1);
    wanted.members = 4;
    const OverviewCluster cluster = make(wanted).clusters.at(0);
    ASSERT_EQ(cluster.members.size(), 4);
    EXPECT_EQ(cluster.members.front().id, cluster.representative.id);
    EXPECT_EQ(cluster.size, 9);
    wanted.members = 0;
    EXPECT_TRUE(make(wanted).clusters.at(0).members.empty());
}

TEST_F(ClusterOverviewTest, IsMadeOnceUntilTheCollectionChanges) {
    make(options(3));
    OverviewOptions fewer = options(3);
    fewer.members = 1;
    make(fewer);
    EXPECT_EQ(overview_->computed(), 1);
    OverviewOptions other_seed = options(3);
    other_seed.seed = 7;
    make(other_seed);
    OverviewOptions other_profile = options(3);
    other_profile.profile = *image::built_in_profile("scanned");
    make(other_profile);
    make(options(2));
    EXPECT_EQ(overview_->computed(), 4);
    make(options(3));
    EXPECT_EQ(overview_->computed(), 4);
    collection_.add(5);
    EXPECT_EQ(make(options(3)).searched, 10);
    EXPECT_EQ(overview_->computed(), 5);
}

TEST_F(ClusterOverviewTest, AFilterNarrowsItAndSeesNewTags) {
    OverviewOptions wanted = options(2);
    wanted.filter.tags = {"even"};
    EXPECT_EQ(make(wanted).searched, 4);
    const auto other = beside(collection_);
    ASSERT_TRUE(other->images().describe(
        ids_[0], {std::nullopt, std::vector<std::string>{"even"}, std::nullopt}));
    EXPECT_EQ(make(wanted).searched, 5);
    wanted.filter.tags = {"none"};
    EXPECT_TRUE(make(wanted).clusters.empty());
}

TEST_F(ClusterOverviewTest, AProfileOfAnotherKindSeesThePicturesThatHaveIt) {
    OverviewOptions wanted = options(2);
    wanted.profile.kind.color_space = image::ColorSpace::kLab;
    EXPECT_EQ(make(wanted).searched, 0);
    const auto other = beside(collection_);
    const auto variants = ingest::signature_variants(image::scene(64, 64, 1).view(),
                                                     std::vector{wanted.profile.kind});
    ASSERT_TRUE(other->images().set_variant(ids_[2], variants.front()));
    EXPECT_TRUE(becomes_true([&] { return make(wanted).searched == 1; }));
}

TEST_F(ClusterOverviewTest, DamagedSignaturesAreLeftOut) {
    {
        const schema::RawConnection raw(collection_.path());
        schema::run_sql(raw.handle(), "PRAGMA busy_timeout = 5000");
        schema::run_sql(raw.handle(),
                        "UPDATE images SET signature = x'4853' WHERE id = 1");
    }
    EXPECT_EQ(make(options(2)).searched, 8);
}

TEST_F(ClusterOverviewTest, ADatabaseThatFailsIsAnError) {
    const schema::RawConnection raw(collection_.path());
    schema::run_sql(raw.handle(), "PRAGMA busy_timeout = 5000");
    schema::run_sql(raw.handle(), "ALTER TABLE images RENAME TO elsewhere");
    const auto failed = overview_->make(options(2));
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace haarmony::server
