#include "server/app/find_duplicates_job.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "engine/image/duplicates.h"
#include "engine/image/symmetric_metric.h"
#include "ingest/thumbnail.h"
#include "tests/schema/raw_sql.h"
#include "tests/server/app/collection.h"
#include "tests/server/app/job_watch.h"

namespace haarmony::server {
namespace {

using Bytes = std::vector<std::uint8_t>;
using schema::JobState;
using Pair = std::tuple<ImageId, ImageId, std::string, double>;

Bytes jpeg(const image::Pixels& pixels, int quality) {
    return ingest::encode_jpeg(pixels.view(), quality).value();
}

image::Pixels darker(image::Pixels pixels, int percent) {
    for (std::uint8_t& byte : pixels.bytes)
        byte = static_cast<std::uint8_t>(byte * percent / 100);
    return pixels;
}

class FindDuplicatesTest : public testing::Test {
  protected:
    FindDuplicatesTest() : other_(beside(collection_)) { collection_.open(); }

    ImageId add(const Bytes& bytes) {
        return collection_.service->add(bytes, {}).value();
    }

    // Scenes of their own, copies of some of them, and pages with next to nothing on them.
    void fill() {
        for (unsigned number = 1; number <= 8; ++number) add(jpeg_scene(number));
        for (unsigned number = 1; number <= 3; ++number) {
            const image::Pixels scene = image::scene(96, 64, number);
            add(jpeg(scene, 60));
            add(jpeg(darker(scene, 93), 90));
            add(jpeg(darker(scene, 70), 30));
        }
        add(jpeg_scene(4));  // the same bytes
        for (const int quality : {90, 50})
            add(jpeg(image::flat(40, 40, {9, 9, 9}), quality));
    }
    schema::Job find(const std::string& request = "{}") {
        JobRunnerOptions options;
        options.database_path = collection_.path();
        const auto runner = JobRunner::start(options, types());
        return done(*runner.value(), "find_duplicates", request);
    }
    JobTypes types() {
        return {{"find_duplicates", find_duplicates_job(collection_.service->index())}};
    }
    std::vector<Pair> stored() {
        std::vector<Pair> pairs;
        const auto found = other_->duplicates().pairs(0);
        for (const schema::DuplicatePair& pair : found.value())
            pairs.emplace_back(pair.a, pair.b, pair.level, pair.similarity);
        return pairs;
    }
    // Every picture with every other one, without an index.
    std::vector<Pair> expected(double least) {
        const image::Profile profile = image::duplicate_profile();
        std::vector<Pair> pairs;
        const auto rows = collection_.service->list({}).value();
        for (const schema::Image& a : rows)
            for (const schema::Image& b : rows) {
                if (a.id >= b.id || a.stamp.content_hash == b.stamp.content_hash)
                    continue;
                const double similarity =
                    image::mutual_similarity(collection_.service->signature(a.id).value(),
                                             collection_.service->signature(b.id).value(),
                                             profile,
                                             profile.m);
                const auto level = image::level_of(
                    {similarity, false, a.low_information || b.low_information});
                if (level && similarity >= least)
                    pairs.emplace_back(a.id,
                                       b.id,
                                       std::string(image::duplicate_level_name(*level)),
                                       similarity);
            }
        return pairs;
    }
    std::int64_t generations() {
        const schema::RawConnection raw(collection_.path());
        return schema::sql_integer(raw.handle(),
                                   "SELECT count(*) FROM duplicate_generations");
    }

    Collection collection_;
    std::unique_ptr<Connection> other_;
};

TEST_F(FindDuplicatesTest, FindsThePairsThatComparingAllWithAllFinds) {
    fill();
    const std::vector<Pair> pairs = expected(0);
    // Some of both levels, or nothing would be compared here.
    const auto with_level = [&](const std::string& level) {
        return std::count_if(pairs.begin(), pairs.end(), [&](const Pair& pair) {
            return std::get<2>(pair) == level;
        });
    };
    ASSERT_GE(with_level("near"), 3);
    const schema::Job job = find();
    EXPECT_EQ(job.state, JobState::kDone);
    EXPECT_EQ(job.counts.seen, 20);
    EXPECT_EQ(job.total, 20);
    EXPECT_EQ(job.counts.skipped, 2);  // the empty pages
    EXPECT_EQ(job.counts.failed, 0);
    EXPECT_EQ(job.counts.added, static_cast<std::int64_t>(pairs.size()));
    EXPECT_EQ(stored(), pairs);
}

TEST_F(FindDuplicatesTest, LeavesOutWhatIsLessSimilarThanAskedFor) {
    fill();
    std::vector<double> similarities;
    for (const Pair& pair : expected(0)) similarities.push_back(std::get<3>(pair));
    std::ranges::sort(similarities);
    const double middle = similarities[similarities.size() / 2];
    ASSERT_GT(middle, similarities.front());
    const schema::Job job =
        find(R"({"min_similarity":)" + std::to_string(middle - 1e-4) + "}");
    EXPECT_EQ(job.state, JobState::kDone);
    EXPECT_EQ(stored(), expected(middle - 1e-4));
}

TEST_F(FindDuplicatesTest, ANewSearchReplacesTheOneBefore) {
    fill();
    ASSERT_EQ(find().state, JobState::kDone);
    const std::vector<Pair> before = stored();
    const std::int64_t first = other_->duplicates().published_generation().value();
    ASSERT_TRUE(collection_.service->remove(std::get<0>(before.front())));
    ASSERT_EQ(find().state, JobState::kDone);
    EXPECT_LT(stored().size(), before.size());
    EXPECT_EQ(stored(), expected(0));
    EXPECT_GT(other_->duplicates().published_generation().value(), first);
    EXPECT_EQ(generations(), 1);
}

TEST_F(FindDuplicatesTest, MoreCopiesThanOneLookSeesAreAllFound) {
    const image::Pixels scene = image::scene(96, 64, 1);
    std::set<Bytes> different;
    for (int quality = 50; quality < 95; ++quality)
        different.insert(jpeg(scene, quality));
    ASSERT_GT(different.size(), 40);
    for (const Bytes& bytes : different) add(bytes);
    ASSERT_EQ(find().state, JobState::kDone);
    EXPECT_EQ(stored(), expected(0));
    EXPECT_GT(stored().size(), 40 * 39 / 4);
}

TEST_F(FindDuplicatesTest, ADamagedSignatureIsNamedAndTheRestIsCompared) {
    fill();
    {
        const schema::RawConnection raw(collection_.path());
        schema::run_sql(raw.handle(), "PRAGMA busy_timeout = 5000");
        schema::run_sql(raw.handle(),
                        "UPDATE images SET signature = x'4853' WHERE id = 1");
    }
    const schema::Job job = find();
    EXPECT_EQ(job.state, JobState::kDone);
    EXPECT_EQ(job.counts.failed, 1);
    ASSERT_EQ(job.errors.size(), 1);
    EXPECT_TRUE(job.errors[0].starts_with("image 1: the stored signature is damaged"));
    EXPECT_FALSE(stored().empty());
    for (const Pair& pair : stored()) EXPECT_NE(std::get<0>(pair), ImageId{1});
}

TEST_F(FindDuplicatesTest, CancelledItLeavesWhatWasThere) {
    fill();
    ASSERT_EQ(find().state, JobState::kDone);
    const std::vector<Pair> before = stored();
    const std::int64_t published = other_->duplicates().published_generation().value();
    // A generation that a search left behind when its process died, and a search that takes
    // its place and is stopped at once.
    const std::int64_t left_over = other_->duplicates().begin_generation().value();
    const std::int64_t id = other_->jobs().create("find_duplicates", "{}")->id;
    ASSERT_TRUE(other_->jobs().start(id));
    ASSERT_TRUE(other_->jobs().progress(id, {}, -1, std::to_string(left_over), {}));
    const std::atomic<bool> stop{true};
    JobContext job(
        *other_, other_->jobs().get(id).value(), stop, std::chrono::milliseconds(0));
    ASSERT_TRUE(types().at("find_duplicates").run(job));
    EXPECT_TRUE(job.was_interrupted());
    EXPECT_EQ(other_->duplicates().published_generation().value(), published);
    EXPECT_EQ(stored(), before);
    EXPECT_EQ(generations(), 1);
}

TEST_F(FindDuplicatesTest, ADatabaseThatFailsInTheMiddleFailsTheJob) {
    fill();
    {
        const schema::RawConnection raw(collection_.path());
        schema::run_sql(raw.handle(), "PRAGMA busy_timeout = 5000");
        schema::run_sql(raw.handle(),
                        "CREATE TRIGGER refuse BEFORE INSERT ON duplicates BEGIN "
                        "SELECT raise(ABORT, 'no room'); END");
    }
    const schema::Job job = find();
    EXPECT_EQ(job.state, JobState::kFailed);
    EXPECT_EQ(job.errors.size(), 1);
    EXPECT_EQ(generations(), 0);
}

TEST_F(FindDuplicatesTest, ARequestThatMakesNoSenseFailsTheJob) {
    const schema::Job job = find(R"({"min_similarity":"x"})");
    EXPECT_EQ(job.state, JobState::kFailed);
    EXPECT_EQ(job.errors.size(), 1);
}

}  // namespace
}  // namespace haarmony::server
