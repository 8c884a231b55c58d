#include "tests/eval/experiment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/eval/test/generated_pictures.h"

namespace haarmony::eval {
namespace {

using Places = std::set<std::size_t>;

Places set_of(const std::vector<std::size_t>& places) {
    return {places.begin(), places.end()};
}

struct Prepared {
    InlineExecutor executor;
    PictureSource source;
    Database database;
    Result<Experiment> experiment;

    Prepared(int pictures, std::uint64_t seed, int queries)
        : source(generated_pictures(pictures)),
          database(make_database(source, {}, executor).value()),
          experiment(Experiment::prepare(source, database, seed, queries, executor)) {}
};

TEST(Experiment, TrainingSetsNeverOverlapEachOther) {
    const Prepared prepared(21, 3, 5);
    const Experiment& experiment = *prepared.experiment;
    const Places fitting = set_of(experiment.fitting());
    const Places selection = set_of(experiment.selection());
    EXPECT_EQ(experiment.evaluation().size(), 5U);
    EXPECT_EQ(experiment.distorted().size(), 21U);
    EXPECT_EQ(fitting.size(), 10U);
    EXPECT_EQ(selection.size(), 11U);
    for (const std::size_t place : fitting) EXPECT_FALSE(selection.contains(place));
    EXPECT_TRUE(experiment.training_overlaps());
}

TEST(Experiment, TheSeedAloneDecidesTheOrder) {
    const Prepared a(20, 3, 8);
    const Prepared b(20, 3, 8);
    const Prepared c(20, 4, 8);
    EXPECT_EQ(a.experiment->evaluation(), b.experiment->evaluation());
    EXPECT_NE(a.experiment->evaluation(), c.experiment->evaluation());
}

TEST(Experiment, RandomNumbersDependOnProtocolAndPicture) {
    const Prepared prepared(4, 3, 4);
    const Experiment& experiment = *prepared.experiment;
    std::set<std::uint64_t> first;
    for (const char* protocol : {"scanned", "painted"}) {
        for (const std::size_t place : {0U, 1U}) {
            EXPECT_EQ(experiment.random(protocol, place).next(),
                      experiment.random(protocol, place).next());
            first.insert(experiment.random(protocol, place).next());
        }
    }
    EXPECT_EQ(first.size(), 4U);
}

TEST(Experiment, QueryPicturesAreNoLargerThanNeeded) {
    InlineExecutor executor;
    PictureSource source;
    source.names = {"wide", "small"};
    source.load = [](std::size_t i) -> Result<RgbPicture> {
        return i == 0 ? gradient(1024, 512) : gradient(100, 60);
    };
    const Database database = make_database(source, {}, executor).value();
    const auto experiment = Experiment::prepare(source, database, 1, 2, executor);
    ASSERT_TRUE(experiment);
    EXPECT_EQ(experiment->picture(0).width, 256);
    EXPECT_EQ(experiment->picture(0).height, 128);
    EXPECT_EQ(experiment->picture(1).width, 100);
}

TEST(Experiment, APictureThatIsGoneIsAnError) {
    InlineExecutor executor;
    PictureSource source = generated_pictures(3);
    const Database database = make_database(source, {}, executor).value();
    source.load = [](std::size_t i) -> Result<RgbPicture> {
        return Error{ErrorCode::kIo, std::to_string(i) + ": gone"};
    };
    const auto experiment = Experiment::prepare(source, database, 1, 3, executor);
    ASSERT_FALSE(experiment);
    EXPECT_EQ(experiment.error().code, ErrorCode::kIo);
}

TEST(Shuffled, IsAPermutation) {
    Random random(6);
    const std::vector<std::size_t> order = shuffled(50, random);
    EXPECT_EQ(set_of(order).size(), 50U);
    EXPECT_EQ(*set_of(order).rbegin(), 49U);
    EXPECT_FALSE(std::ranges::is_sorted(order));
}

}  // namespace
}  // namespace haarmony::eval
