#include "tests/eval/ranking.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/image/metric.h"
#include "tests/eval/test/generated_pictures.h"

namespace haarmony::eval {
namespace {

class Ranking : public ::testing::Test {
  protected:
    InlineExecutor executor_;
    PictureSource source_ = generated_pictures(24);
    Database database_ =
        make_database(source_, {image::SignatureKind{}}, executor_).value();
};

TEST(RankOf, CountsTheCloserAndTheEarlierEquals) {
    const std::vector<std::uint64_t> distances{5, 3, 5, 9, 5};
    EXPECT_EQ(rank_of(distances, 0), 2);
    EXPECT_EQ(rank_of(distances, 1), 1);
    EXPECT_EQ(rank_of(distances, 2), 3);
    EXPECT_EQ(rank_of(distances, 3), 5);
    EXPECT_EQ(rank_of(distances, 4), 4);
}

TEST(RankIn, IsOneBeyondTheEndForAStranger) {
    const std::vector<image::Match> matches{{id_of(4), 0}, {id_of(2), 1}};
    EXPECT_EQ(rank_in(matches, 4), 1);
    EXPECT_EQ(rank_in(matches, 2), 2);
    EXPECT_EQ(rank_in(matches, 3), 3);
}

TEST_F(Ranking, WaveletRanksAreThoseOfEquation43) {
    const WaveletSearch search(database_, image::SignatureKind{});
    const auto& pictures = database_.signatures.at(image::SignatureKind{});
    const image::Profile profile = *image::built_in_profile("painted");
    for (const std::size_t target : {0U, 7U, 23U}) {
        const image::Signature query =
            image::make_signature(mosaic(generated_picture(int(target)), 8).view());
        std::vector<std::uint64_t> distances;
        for (const image::Signature& picture : pictures) {
            distances.push_back(static_cast<std::uint64_t>(
                image::metric(query, picture, profile, profile.m)));
        }
        EXPECT_EQ(search.rank(query, profile, target), rank_of(distances, target));
    }
}

TEST_F(Ranking, EveryMetricFindsAPictureByItself) {
    const MetricPanel panel(database_);
    for (const int target : {0, 11, 23}) {
        const RgbPicture picture = generated_picture(target);
        for (const std::int64_t rank : panel.ranks(picture.view(), target))
            EXPECT_EQ(rank, 1) << target;
    }
}

TEST_F(Ranking, ColumnsAreTheProfilesAndTheRivals) {
    const MetricPanel panel(database_);
    ASSERT_EQ(panel.columns().size(), 2 + kRivals.size());
    EXPECT_EQ(panel.columns()[0].name, (MetricName{"L^q", "m=40"}));
    EXPECT_EQ(panel.columns()[0].profile, "scanned");
    EXPECT_EQ(panel.columns()[1].name, (MetricName{"L^q", "m=60"}));
    EXPECT_EQ(panel.columns().back().name.metric, "histogram");
}

TEST(DatabaseOfPictures, LeavesOutWhatCannotBeReadAndSaysSo) {
    PictureSource source = generated_pictures(4);
    const auto load = source.load;
    source.load = [load](std::size_t i) -> Result<RgbPicture> {
        if (i == 1) return Error{ErrorCode::kUndecodable, "torn"};
        return load(i);
    };
    InlineExecutor executor;
    const auto database = make_database(source, {image::SignatureKind{}}, executor);
    ASSERT_TRUE(database);
    EXPECT_EQ(database->size(), 3);
    EXPECT_EQ(database->source_places, (std::vector<std::size_t>{0, 2, 3}));
    EXPECT_EQ(database->unreadable, (std::vector<std::string>{"1: torn"}));
}

TEST(DatabaseOfPictures, IsAnErrorWithoutAny) {
    InlineExecutor executor;
    const auto database = make_database(generated_pictures(0), {}, executor);
    ASSERT_FALSE(database);
    EXPECT_EQ(database.error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace haarmony::eval
