#include "server/app/rebuild.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "engine/image/aspect.h"
#include "engine/image/segment_layout.h"
#include "engine/image/signature_codec.h"
#include "server/app/thread_executor.h"
#include "tests/engine/image/random_signatures.h"
#include "tests/server/app/collection.h"

namespace haarmony::server {
namespace {

class RebuildTest : public testing::Test {
  protected:
    // So many pictures, every third of them with a second signature.
    void fill(int count) {
        std::mt19937 random(5);
        const auto connection = beside(collection_);
        ASSERT_TRUE(connection->images().transaction([&]() -> Result<void> {
            for (int i = 1; i <= count; ++i) {
                schema::NewImage row;
                row.origin = schema::ImageOrigin::kFile;
                row.uri = "file:///p/" + std::to_string(i);
                row.width = 100 + i;
                row.height = 100;
                row.media_type = "image/jpeg";
                row.signature =
                    image::encode_signature(image::random_signature(random, {6}));
                if (i % 3 == 0)
                    row.variants = {
                        {"other",
                         image::encode_signature(image::random_signature(random, {4}))}};
                const auto added = connection->images().add(row);
                if (!added) return added.error();
            }
            return {};
        }));
    }
    Result<Rebuilt> rebuilt(int threads) {
        RebuildOptions options;
        options.index_m = 60;
        options.threads = threads;
        options.go_on = [this] { return visits_left_-- > 0; };
        ThreadExecutor executor(threads - 1);
        return rebuild(connections_, options, executor);
    }
    // How many pictures of each variant it has, each once.
    static std::map<std::string, std::size_t> pictures_of(const SegmentsByVariant& of) {
        std::map<std::string, std::size_t> pictures;
        for (const auto& [variant, segments] : of) {
            std::vector<std::int64_t> ids;
            for (const image::LiveSegment& live : segments) {
                const auto& own = live.segment->view().ids;
                ids.insert(ids.end(), own.begin(), own.end());
            }
            std::ranges::sort(ids);
            EXPECT_EQ(std::ranges::adjacent_find(ids), ids.end());
            pictures[variant] = ids.size();
        }
        return pictures;
    }

    Collection collection_;
    ReadConnections connections_{[this] {
        return Connection::open(collection_.path(), schema::Database::Mode::kReadOnly);
    }};
    std::atomic<std::int64_t> visits_left_{1'000'000};
};

TEST_F(RebuildTest, SegmentsAreAsLargeAsThreadsAndTheirLimitAllow) {
    EXPECT_EQ(pictures_per_segment(0, 1), 1);
    EXPECT_EQ(pictures_per_segment(100, 8), 100);
    EXPECT_EQ(pictures_per_segment(20'000, 8), 10'000);
    EXPECT_EQ(pictures_per_segment(100'000, 2), 50'000);
    EXPECT_EQ(pictures_per_segment(image::kMaxSegmentSlots, 1), image::kMaxSegmentSlots);
    EXPECT_EQ(pictures_per_segment(image::kMaxSegmentSlots + 1, 1),
              image::kMaxSegmentSlots / 2 + 1);
    EXPECT_EQ(pictures_per_segment(1'000'000, 2), 125'000);
    EXPECT_EQ(pictures_per_segment(1'000'000, 16), 62'500);
}

TEST_F(RebuildTest, HasEveryPictureOfEveryVariantOnce) {
    fill(500);
    const auto all = rebuilt(2);
    ASSERT_TRUE(all) << all.error().message;
    EXPECT_EQ(all->images, 500);
    EXPECT_EQ(all->sequence, beside(collection_)->images().last_sequence().value());
    EXPECT_EQ(
        pictures_of(all->segments),
        (std::map<std::string, std::size_t>{{"yiq-standard", 500}, {"other", 166}}));
}

// The same pictures, each time cut into other segments.
TEST_F(RebuildTest, SignaturesAreThoseOfTheDatabaseHoweverManyThreadsReadThem) {
    fill(17'000);
    for (const int threads : {1, 2}) {
        const auto all = rebuilt(threads);
        ASSERT_TRUE(all) << all.error().message;
        EXPECT_EQ(all->segments.at("yiq-standard").size(), std::size_t(threads));
        image::Index parallel({60, 64});
        parallel.reset(all->segments.at("yiq-standard"), image::SegmentOrigin::kBuilt);

        image::Index one_by_one({60, 64});
        const auto scanned =
            beside(collection_)
                ->images()
                .for_each_searchable([&](const schema::SearchableImage& image) {
                    const std::vector<image::Record> record{
                        {image.id,
                         image::decode_signature(image.signature).value(),
                         image::log_aspect(image.width, image.height)}};
                    if (to_int(image.id) % 100 == 0) one_by_one.apply(record, {});
                });
        ASSERT_TRUE(scanned);
        std::mt19937 random(6);
        image::Query query = image::make_query(image::random_signature(random, {60}),
                                               *image::built_in_profile("painted"),
                                               40);
        query.aspect_weight = 100;
        std::map<ImageId, image::Score> scores;
        for (const image::Match& match : parallel.snapshot()->score_all(query, nullptr))
            scores[match.id] = match.score;
        EXPECT_EQ(scores.size(), 17'000U);
        for (const image::Match& match : one_by_one.snapshot()->score_all(query, nullptr))
            EXPECT_EQ(scores.at(match.id), match.score) << to_int(match.id);
    }
}

TEST_F(RebuildTest, WhatIsDamagedIsNamedAndLeftOut) {
    fill(10);
    const auto connection = beside(collection_);
    ASSERT_TRUE(connection->images().set_variant(ImageId{3}, {"other", {1, 2}}));
    const auto all = rebuilt(1);
    ASSERT_TRUE(all) << all.error().message;
    ASSERT_EQ(all->damaged.size(), 1U);
    EXPECT_EQ(all->damaged[0].id, ImageId{3});
    EXPECT_TRUE(all->damaged[0].reason.starts_with("other: ")) << all->damaged[0].reason;
    EXPECT_EQ(pictures_of(all->segments),
              (std::map<std::string, std::size_t>{{"yiq-standard", 10}, {"other", 2}}));
}

// The ids of each piece of a variant.
std::vector<std::vector<std::int64_t>> ids_of(const StoredPictures& stored,
                                              const std::string& variant) {
    std::vector<std::vector<std::int64_t>> pieces;
    for (const image::PackedPictures& piece : stored.variants().at(variant)) {
        std::vector<std::int64_t>& ids = pieces.emplace_back();
        for (const ImageId id : piece.columns().ids) ids.push_back(to_int(id));
    }
    return pieces;
}

TEST_F(RebuildTest, MorePicturesThanASegmentHoldsAreSeveralPieces) {
    fill(7);
    StoredPictures stored(60, 3);
    const auto on = [] { return true; };
    const auto connection = beside(collection_);
    ASSERT_TRUE(stored.read(connection->images(), {ImageId{1}, ImageId{7}}, 7, on));
    EXPECT_EQ(stored.images(), 7);
    EXPECT_EQ(ids_of(stored, "yiq-standard"),
              (std::vector<std::vector<std::int64_t>>{{1, 2, 3}, {4, 5, 6}, {7}}));
    EXPECT_EQ(ids_of(stored, "other"), (std::vector<std::vector<std::int64_t>>{{3, 6}}));
}

TEST_F(RebuildTest, WhatIsReadAgainIsReadAnew) {
    fill(9);
    const auto connection = beside(collection_);
    schema::ImageStore& images = connection->images();
    ASSERT_TRUE(images.set_variant(ImageId{3}, {"other", {1, 2}}));
    StoredPictures stored(60, 2);
    const auto on = [] { return true; };
    ASSERT_TRUE(stored.read(images, {ImageId{1}, ImageId{7}}, 7, on));
    EXPECT_EQ(stored.damaged().size(), 1U);
    ASSERT_TRUE(stored.read(images, {ImageId{7}, ImageId{8}}, 1, on));
    EXPECT_EQ(stored.images(), 2);
    EXPECT_TRUE(stored.damaged().empty());
    EXPECT_EQ(ids_of(stored, "yiq-standard"),
              (std::vector<std::vector<std::int64_t>>{{7, 8}}));
    EXPECT_EQ(ids_of(stored, "other"), (std::vector<std::vector<std::int64_t>>{{}}));
}

TEST_F(RebuildTest, OfNothingIsNothing) {
    const auto all = rebuilt(3);
    ASSERT_TRUE(all) << all.error().message;
    EXPECT_EQ(all->images, 0);
    EXPECT_TRUE(all->segments.at("yiq-standard").empty());
}

TEST_F(RebuildTest, EndsEarlyWhenItIsToldTo) {
    fill(50);
    for (const int visits : {0, 1, 49, 50}) {
        visits_left_ = visits;
        const auto all = rebuilt(1);
        ASSERT_FALSE(all) << visits;
        EXPECT_EQ(all.error().code, ErrorCode::kUnavailable);
        // It was told once, and asked no more.
        EXPECT_EQ(visits_left_, -1);
    }
}

TEST_F(RebuildTest, ADatabaseThatFailsIsAnError) {
    fill(5);
    std::filesystem::remove(collection_.path());
    const auto all = rebuilt(1);
    ASSERT_FALSE(all);
    EXPECT_EQ(all.error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace haarmony::server
