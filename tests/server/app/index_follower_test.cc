#include "server/app/index_follower.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "engine/image/query.h"
#include "engine/image/signature_codec.h"
#include "tests/schema/raw_sql.h"
#include "tests/server/app/collection.h"

namespace haarmony::server {
namespace {

class IndexFollowerTest : public testing::Test {
  protected:
    IndexFollowerTest() : other_(beside(collection_)) {}

    ImageId add(unsigned number) {
        const auto id =
            other_->images().add(file_row(number, "file:///p/" + std::to_string(number)));
        EXPECT_TRUE(id);
        return id.value();
    }
    void sql(const std::string& statement) {
        const schema::RawConnection raw(collection_.path());
        schema::run_sql(raw.handle(), "PRAGMA busy_timeout = 5000");
        schema::run_sql(raw.handle(), statement);
    }
    // A signature that no longer is one, as a failing disk may leave it.
    void damage(ImageId id) {
        sql("UPDATE images SET signature = x'00112233' WHERE id = " +
            std::to_string(to_int(id)));
    }

    void start(std::chrono::milliseconds poll_interval = std::chrono::milliseconds(1)) {
        FollowerOptions options;
        options.database_path = collection_.path();
        options.index.tail_capacity = 4;
        options.poll_interval = poll_interval;
        auto started = IndexFollower::start(options);
        ASSERT_TRUE(started) << started.error().message;
        follower_ = std::move(started).value();
    }
    void start_and_load() {
        start();
        ASSERT_TRUE(becomes_true([&] { return follower_->ready(); }));
    }

    // Every picture in the index: a query finds all of them, however far off.
    [[nodiscard]] std::set<ImageId> indexed() const {
        const image::Query query =
            image::make_query(image::make_signature(image::scene(32, 32, 1).view()),
                              *image::built_in_profile("painted"),
                              60);
        std::set<ImageId> ids;
        for (const image::Match& match :
             follower_->snapshot()->search(query, {1000}).matches)
            ids.insert(match.id);
        return ids;
    }
    [[nodiscard]] bool comes_to_hold(const std::set<ImageId>& ids) const {
        return becomes_true([&] { return indexed() == ids; });
    }

    Collection collection_;
    std::unique_ptr<Connection> other_;
    std::unique_ptr<IndexFollower> follower_;
};

TEST_F(IndexFollowerTest, LoadsWhatIsStored) {
    const std::set<ImageId> stored{add(1), add(2), add(3)};
    start_and_load();
    EXPECT_EQ(indexed(), stored);
    EXPECT_EQ(follower_->damaged(), 0);
}

TEST_F(IndexFollowerTest, AnEmptyDatabaseIsReadyAtOnce) {
    start_and_load();
    EXPECT_TRUE(indexed().empty());
}

TEST_F(IndexFollowerTest, SeesWhatAnotherConnectionAddsChangesAndRemoves) {
    const ImageId first = add(1);
    start_and_load();
    const ImageId second = add(2);
    EXPECT_TRUE(comes_to_hold({first, second}));

    // The row keeps its id and gets the signature of another picture.
    ASSERT_TRUE(other_->images().update(first, file_row(9, "file:///p/1")));
    const image::Signature changed =
        image::make_signature(image::scene(96, 64, 9).view());
    const image::Query query =
        image::make_query(changed, *image::built_in_profile("painted"), 60);
    EXPECT_TRUE(becomes_true([&] {
        const auto best = follower_->snapshot()->search(query, {1}).matches;
        // Through a JPEG: near, not equal. The former picture is far.
        return best.front().id == first &&
               image::similarity(query, best.front().score) > 0.5;
    }));

    ASSERT_TRUE(other_->images().remove(first));
    EXPECT_TRUE(comes_to_hold({second}));
    ASSERT_TRUE(other_->images().purge(second));
    EXPECT_TRUE(comes_to_hold({}));
}

TEST_F(IndexFollowerTest, FollowsTheFurtherSignaturesOfAPicture) {
    const ImageId before = add(1);
    const auto variant = [](unsigned number) {
        const image::SignatureKind lab{image::ColorSpace::kLab,
                                       image::Decomposition::kStandard};
        return schema::SignatureVariant{"lab-standard",
                                        image::encode_signature(image::make_signature(
                                            image::scene(96, 64, number).view(), lab))};
    };
    ASSERT_TRUE(other_->images().set_variant(before, variant(1)));
    start_and_load();
    const auto pictures = [&] {
        const Snapshots snapshots = follower_->snapshots();
        const auto found = snapshots.find("lab-standard");
        return found == snapshots.end() ? -1 : found->second->stats().images;
    };
    EXPECT_EQ(pictures(), 1);
    const ImageId later = add(2);
    ASSERT_TRUE(other_->images().set_variant(later, variant(2)));
    EXPECT_TRUE(becomes_true([&] { return pictures() == 2; }));
    // Damage costs the one signature, not the picture.
    ASSERT_TRUE(other_->images().set_variant(later, {"lab-standard", {1, 2, 3}}));
    EXPECT_TRUE(becomes_true([&] { return pictures() == 1; }));
    EXPECT_EQ(indexed(), (std::set<ImageId>{before, later}));
    EXPECT_EQ(follower_->damaged(), 1);
    ASSERT_TRUE(other_->images().remove(before));
    EXPECT_TRUE(becomes_true([&] { return pictures() == 0; }));
}

TEST_F(IndexFollowerTest, FollowsMoreChangesThanOneBatchHolds) {
    start_and_load();
    constexpr int kMany = 5000;
    const schema::NewImage row = file_row(1, "");
    ASSERT_TRUE(other_->images().transaction([&]() -> Result<void> {
        for (int i = 0; i < kMany; ++i) {
            schema::NewImage copy = row;
            copy.uri = "file:///p/" + std::to_string(i);
            const auto added = other_->images().add(copy);
            if (!added) return added.error();
        }
        return {};
    }));
    EXPECT_TRUE(
        becomes_true([&] { return follower_->snapshot()->stats().images == kMany; }));
}

TEST_F(IndexFollowerTest, LoadsMoreThanOneBatchHolds) {
    constexpr int kMany = 5000;
    const schema::NewImage row = file_row(1, "");
    ASSERT_TRUE(other_->images().transaction([&]() -> Result<void> {
        for (int i = 0; i < kMany; ++i) {
            schema::NewImage copy = row;
            copy.uri = "file:///p/" + std::to_string(i);
            const auto added = other_->images().add(copy);
            if (!added) return added.error();
        }
        return {};
    }));
    start_and_load();
    EXPECT_EQ(follower_->snapshot()->stats().images, kMany);
}

TEST_F(IndexFollowerTest, CatchUpShowsACommitWithoutWaitingForThePoll) {
    start_and_load();
    follower_.reset();
    start(std::chrono::hours(1));
    ASSERT_TRUE(becomes_true([&] { return follower_->ready(); }));
    const ImageId id = add(1);
    EXPECT_TRUE(indexed().empty());
    ASSERT_TRUE(follower_->catch_up());
    EXPECT_EQ(indexed(), (std::set<ImageId>{id}));
}

TEST_F(IndexFollowerTest, ADamagedSignatureIsCountedAndLeftOut) {
    const ImageId sound = add(1);
    const ImageId broken = add(2);
    damage(broken);
    start_and_load();
    EXPECT_EQ(indexed(), (std::set<ImageId>{sound}));
    EXPECT_EQ(follower_->damaged(), 1);
}

TEST_F(IndexFollowerTest, DamageThatComesLaterTakesThePictureOutUntilItIsRepaired) {
    const ImageId sound = add(1);
    const ImageId broken = add(2);
    start_and_load();
    damage(broken);
    EXPECT_TRUE(comes_to_hold({sound}));
    EXPECT_TRUE(becomes_true([&] { return follower_->damaged() == 1; }));
    ASSERT_TRUE(other_->images().update(broken, file_row(2, "file:///p/2")));
    EXPECT_TRUE(comes_to_hold({sound, broken}));
    EXPECT_TRUE(becomes_true([&] { return follower_->damaged() == 0; }));
}

TEST_F(IndexFollowerTest, IsNotReadyWhileLoadingFailsAndTriesAgain) {
    const ImageId id = add(1);
    sql("ALTER TABLE changes RENAME TO elsewhere");
    start();
    ASSERT_TRUE(follower_->catch_up());
    EXPECT_FALSE(follower_->ready());
    sql("ALTER TABLE elsewhere RENAME TO changes");
    EXPECT_TRUE(becomes_true([&] { return follower_->ready(); }));
    EXPECT_EQ(indexed(), (std::set<ImageId>{id}));
}

TEST_F(IndexFollowerTest, RecoversWhenFollowingFailsForAWhile) {
    const ImageId first = add(1);
    start_and_load();
    sql("ALTER TABLE changes RENAME TO elsewhere");
    EXPECT_FALSE(follower_->catch_up());
    EXPECT_EQ(indexed(), (std::set<ImageId>{first}));
    sql("ALTER TABLE elsewhere RENAME TO changes");
    const ImageId second = add(2);
    EXPECT_TRUE(comes_to_hold({first, second}));
}

TEST_F(IndexFollowerTest, MergesSegmentsInTheBackground) {
    start_and_load();
    for (unsigned number = 1; number <= 40; ++number) add(number);
    EXPECT_TRUE(becomes_true([&] {
        const image::IndexStats stats = follower_->snapshot()->stats();
        // 40 pictures fill ten tails of 4; unmerged they would be ten segments.
        return stats.images == 40 && stats.segments + stats.tail < 10;
    }));
}

TEST_F(IndexFollowerTest, StopsMoreThanOnceAndAnswersAfterwards) {
    const ImageId id = add(1);
    start_and_load();
    follower_->stop();
    follower_->stop();
    EXPECT_EQ(indexed(), (std::set<ImageId>{id}));
}

TEST_F(IndexFollowerTest, ADatabaseThatIsNotThereIsAnError) {
    FollowerOptions options;
    options.database_path = collection_.folder.file("gone.db");
    EXPECT_FALSE(IndexFollower::start(options));
}

}  // namespace
}  // namespace haarmony::server
