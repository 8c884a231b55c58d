#include "schema/duplicate_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <random>
#include <set>

#include "schema/image_store.h"
#include "tests/schema/pictures.h"
#include "tests/schema/raw_sql.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::schema {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kAny = -1e300;

DuplicatePair pair_of(int a, int b, double similarity) {
    return {ImageId{a}, ImageId{b}, "near", similarity};
}

class Duplicates : public testing::Test {
  protected:
    void SetUp() override {
        expect(images_.transaction([&]() -> Result<void> {
            for (int i = 1; i <= 8; ++i) expect(images_.add(file_picture(i)));
            return {};
        }));
    }
    std::int64_t publish(const std::vector<DuplicatePair>& pairs) {
        const auto generation = expect(store_.begin_generation());
        expect(store_.add(generation, pairs));
        expect(store_.publish(generation));
        return generation;
    }
    [[nodiscard]] std::vector<DuplicatePair> shown(double min_similarity = kAny) {
        return expect(store_.pairs(min_similarity));
    }
    [[nodiscard]] std::int64_t rows(const std::string& table) const {
        return sql_integer(database_.handle(), "SELECT count(*) FROM " + table);
    }

    ScratchFolder folder_;
    Database database_ = open_database(folder_.file("x.db"));
    ImageStore images_{database_};
    DuplicateStore store_{database_};
};

TEST_F(Duplicates, AreShownInOrderFromASimilarityOn) {
    EXPECT_EQ(expect(store_.published_generation()), 0);
    EXPECT_THAT(shown(), IsEmpty());
    const auto generation =
        publish({pair_of(3, 4, 0.5), pair_of(1, 7, 0.9), pair_of(1, 2, 0.7)});
    EXPECT_EQ(expect(store_.published_generation()), generation);
    EXPECT_THAT(shown(),
                ElementsAre(pair_of(1, 2, 0.7), pair_of(1, 7, 0.9), pair_of(3, 4, 0.5)));
    EXPECT_THAT(shown(0.7), ElementsAre(pair_of(1, 2, 0.7), pair_of(1, 7, 0.9)));
    EXPECT_THAT(shown(0.95), IsEmpty());
}

TEST_F(Duplicates, AGenerationIsUnseenUntilItIsPublishedAndThenAlone) {
    const auto first = publish({pair_of(1, 2, 1)});
    const auto abandoned = expect(store_.begin_generation());
    expect(store_.add(abandoned, std::vector{pair_of(5, 6, 1)}));
    const auto second = expect(store_.begin_generation());
    EXPECT_GT(second, first);
    expect(store_.add(second, std::vector{pair_of(3, 4, 1)}));
    expect(store_.add(second, std::vector{pair_of(2, 3, 1)}));
    EXPECT_THAT(shown(), ElementsAre(pair_of(1, 2, 1)));
    const auto third = expect(store_.begin_generation());
    expect(store_.add(third, std::vector{pair_of(7, 8, 1)}));

    expect(store_.publish(second));
    EXPECT_THAT(shown(), ElementsAre(pair_of(2, 3, 1), pair_of(3, 4, 1)));
    EXPECT_EQ(rows("duplicates"), 3);  // the older ones are gone, the newer one goes on
    EXPECT_EQ(rows("duplicate_generations"), 2);

    for (const auto& [result, code] :
         {std::pair(store_.add(second, {}), ErrorCode::kConflict),
          std::pair(store_.publish(second), ErrorCode::kConflict),
          std::pair(store_.discard(second), ErrorCode::kConflict),
          std::pair(store_.add(first, {}), ErrorCode::kNotFound),
          std::pair(store_.publish(abandoned), ErrorCode::kNotFound),
          std::pair(store_.discard(99), ErrorCode::kNotFound)}) {
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, code) << result.error().message;
        EXPECT_NE(result.error().message.find("generation "), std::string::npos);
    }
    expect(store_.discard(third));
    EXPECT_EQ(rows("duplicates"), 2);
    EXPECT_GT(expect(store_.begin_generation()), third);
}

TEST_F(Duplicates, ABatchIsAllOrNothing) {
    const auto generation = expect(store_.begin_generation());
    const std::pair<DuplicatePair, ErrorCode> bad[] = {
        {pair_of(4, 3, 1), ErrorCode::kInvalidArgument},
        {pair_of(4, 4, 1), ErrorCode::kInvalidArgument},
        {pair_of(3, 4, std::numeric_limits<double>::infinity()),
         ErrorCode::kInvalidArgument},
        {pair_of(3, 4, std::numeric_limits<double>::quiet_NaN()),
         ErrorCode::kInvalidArgument},
        {{ImageId{3}, ImageId{4}, "", 1}, ErrorCode::kInvalidArgument},
        {pair_of(1, 2, 0.5), ErrorCode::kConflict},
    };
    for (const auto& [pair, code] : bad) {
        const auto refused = store_.add(generation, std::vector{pair_of(1, 2, 1), pair});
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, code) << refused.error().message;
        EXPECT_NE(refused.error().message.find("pair " + std::to_string(to_int(pair.a)) +
                                               ", " + std::to_string(to_int(pair.b))),
                  std::string::npos)
            << refused.error().message;
        EXPECT_EQ(rows("duplicates"), 0);
    }
}

TEST_F(Duplicates, VanishWithTheirPictures) {
    expect(images_.remove(ImageId{8}));
    static_cast<void>(publish({pair_of(1, 2, 1),
                               pair_of(2, 3, 1),
                               pair_of(3, 4, 1),
                               pair_of(4, 5, 1),
                               pair_of(5, 6, 1),
                               pair_of(6, 8, 1),
                               pair_of(6, 99, 1)}));
    EXPECT_EQ(shown().size(), 5u);  // what is gone already is left out
    expect(images_.purge(ImageId{1}));
    expect(images_.remove(ImageId{3}));  // its row stays
    static_cast<void>(expect(images_.mark_failed(file_picture(6).uri, {}, "cut")));
    EXPECT_THAT(shown(), ElementsAre(pair_of(4, 5, 1)));
    expect(images_.update(ImageId{3}, file_picture(3)));
    EXPECT_THAT(shown(), ElementsAre(pair_of(4, 5, 1)));
}

TEST_F(Duplicates, AnIgnoredPairIsNeverShownAgain) {
    const auto pairs = std::vector{pair_of(1, 2, 1), pair_of(1, 3, 1), pair_of(2, 3, 1)};
    static_cast<void>(publish(pairs));
    expect(store_.ignore(ImageId{3}, ImageId{1}));
    expect(store_.ignore(ImageId{1}, ImageId{3}));
    EXPECT_THAT(shown(), ElementsAre(pairs[0], pairs[2]));
    static_cast<void>(publish(pairs));
    EXPECT_THAT(shown(), ElementsAre(pairs[0], pairs[2]));
    EXPECT_EQ(rows("ignored_duplicates"), 1);
    EXPECT_THAT(expect(store_.ignored()), ElementsAre(std::pair(ImageId{1}, ImageId{3})));
    // Also while one of them cannot be searched; it goes with the row.
    static_cast<void>(expect(images_.mark_failed(file_picture(3).uri, {}, "cut")));
    EXPECT_EQ(rows("ignored_duplicates"), 1);
    expect(images_.purge(ImageId{3}));
    EXPECT_EQ(rows("ignored_duplicates"), 0);
}

TEST_F(Duplicates, OnlyTwoPicturesThatAreThereCanBeIgnored) {
    expect(images_.remove(ImageId{8}));
    const std::tuple<int, int, ErrorCode, std::string> refused[] = {
        {1, 1, ErrorCode::kInvalidArgument, "1, 1"},
        {99, 1, ErrorCode::kNotFound, "no image 99"},
        {-4, 1, ErrorCode::kNotFound, "no image -4"},
        {8, 1, ErrorCode::kNotFound, "no image 8"}};
    for (const auto& [a, b, code, words] : refused) {
        const auto result = store_.ignore(ImageId{a}, ImageId{b});
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, code);
        EXPECT_NE(result.error().message.find(words), std::string::npos)
            << result.error().message;
    }
    EXPECT_EQ(rows("ignored_duplicates"), 0);
}

// Random hashes of few values, against a map of them.
TEST_F(Duplicates, SameContentIsEveryGroupOfEqualHashes) {
    EXPECT_THAT(expect(store_.same_content()), IsEmpty());
    std::mt19937 random(3);
    std::map<std::string, std::vector<ImageId>> model;
    expect(images_.transaction([&]() -> Result<void> {
        for (int i = 0; i < 60; ++i) {
            NewImage image = upload_picture(100 + i);
            const auto value = random() % 30;
            image.stamp.content_hash = value == 0 ? "" : "h" + std::to_string(value);
            const ImageId id = expect(images_.add(image));
            if (random() % 5 == 0) {
                expect(images_.remove(id));
            } else if (value != 0) {
                model[image.stamp.content_hash].push_back(id);
            }
        }
        return {};
    }));
    // Files that failed or were deleted keep their stamp, and are no duplicates.
    expect(images_.touch(ImageId{1}, {1, 1, "same"}));
    expect(images_.touch(ImageId{2}, {1, 1, "same"}));
    expect(images_.remove(ImageId{2}));
    static_cast<void>(expect(images_.mark_failed("file:///f", {1, 1, "same"}, "cut")));

    std::set<std::vector<ImageId>> want;
    for (const auto& [hash, ids] : model) {
        if (ids.size() >= 2) want.insert(ids);
    }
    ASSERT_GT(want.size(), 3u);
    const auto found = expect(store_.same_content());
    EXPECT_EQ(std::set(found.begin(), found.end()), want);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
}

}  // namespace
}  // namespace haarmony::schema
