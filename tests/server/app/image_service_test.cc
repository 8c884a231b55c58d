#include "server/app/image_service.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "engine/image/metric.h"
#include "tests/schema/raw_sql.h"
#include "tests/server/app/collection.h"

namespace haarmony::server {
namespace {

class ImageServiceTest : public testing::Test {
  protected:
    [[nodiscard]] ImageService& service() { return *collection_.service; }

    static QueryPicture picture(unsigned number, const LookOptions& look = {}) {
        PictureReader reader{ingest::DecodeLimits{}};
        return reader.look(jpeg_scene(number), look).value();
    }
    static image::Signature signature(unsigned number) {
        return picture(number).signatures.at({}).front();
    }
    static SearchOptions options(const std::string& profile = "painted") {
        SearchOptions options;
        options.plan.profiles = {*image::built_in_profile(profile)};
        return options;
    }
    [[nodiscard]] std::vector<ImageId> found(const QueryPicture& query) {
        const auto answer = service().search(query, options());
        EXPECT_TRUE(answer);
        std::vector<ImageId> ids;
        if (answer)
            for (const FoundImage& match : answer->found.images)
                ids.push_back(match.image.id);
        return ids;
    }
    void sql(const std::string& statement) {
        const schema::RawConnection raw(collection_.path());
        schema::run_sql(raw.handle(), "PRAGMA busy_timeout = 5000");
        schema::run_sql(raw.handle(), statement);
    }

    Collection collection_;
};

TEST_F(ImageServiceTest, AWriteIsSeenByTheNextSearchAndTheNextRead) {
    collection_.open();
    for (unsigned number = 1; number <= 20; ++number) {
        const ImageId id = collection_.add(number);
        EXPECT_EQ(found(picture(number)).front(), id);
        EXPECT_TRUE(service().get(id));
        if (number % 2 != 0) continue;
        ASSERT_TRUE(service().remove(id));
        const std::vector<ImageId> left = found(picture(number));
        EXPECT_EQ(std::count(left.begin(), left.end(), id), 0);
        const auto gone = service().get(id);
        ASSERT_FALSE(gone);
        EXPECT_EQ(gone.error().code, ErrorCode::kNotFound);
    }
}

TEST_F(ImageServiceTest, RanksAsTheMetricDoes) {
    collection_.open();
    std::vector<image::Signature> stored;
    for (unsigned number = 1; number <= 12; ++number) {
        collection_.add(number);
        stored.push_back(signature(number));
    }
    for (const std::string profile : {"painted", "scanned"}) {
        SearchOptions wanted = options(profile);
        const QueryPicture query = picture(77);
        const image::Profile& used = wanted.plan.profiles.front();
        const auto answer = service().search(query, wanted);
        ASSERT_TRUE(answer);
        EXPECT_EQ(answer->plan.m(), used.m);
        EXPECT_EQ(answer->found.searched, 12);
        std::vector<std::pair<std::int64_t, std::int64_t>> expected;
        for (std::size_t i = 0; i < stored.size(); ++i)
            expected.emplace_back(
                image::metric(query.signatures.at({}).front(), stored[i], used, used.m),
                static_cast<std::int64_t>(i) + 1);
        std::sort(expected.begin(), expected.end());
        ASSERT_EQ(answer->found.images.size(), expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i)
            EXPECT_EQ(to_int(answer->found.images[i].image.id), expected[i].second)
                << profile << " rank " << i + 1;
    }
}

TEST_F(ImageServiceTest, TheCutIsMadeWhereTheIndexEnds) {
    collection_.open(10);
    collection_.add(1);
    SearchOptions wanted = options();
    const auto by_profile = service().search(picture(1), wanted);
    ASSERT_TRUE(by_profile);
    EXPECT_EQ(by_profile->plan.m(), 10);
    wanted.plan.m = 100;
    EXPECT_EQ(service().search(picture(1), wanted).value().plan.m(), 10);
    wanted.plan.m = 4;
    EXPECT_EQ(service().search(picture(1), wanted).value().plan.m(), 4);
}

TEST_F(ImageServiceTest, KeepsWhatIsSaidAboutAPicture) {
    collection_.open();
    const ImageId id = collection_.add(1, {"x:y", {"b", "a"}, R"({"k":1})"});
    const auto image = service().get(id);
    ASSERT_TRUE(image);
    EXPECT_EQ(image->origin, schema::ImageOrigin::kUpload);
    EXPECT_EQ(image->uri, "x:y");
    EXPECT_EQ(image->tags, (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(image->metadata, R"({"k":1})");
    EXPECT_EQ(image->width, 96);
    EXPECT_EQ(image->height, 64);
    EXPECT_EQ(service().signature(id).value(), signature(1));
    EXPECT_FALSE(service().thumbnail(id).value().bytes.empty());
}

TEST_F(ImageServiceTest, APictureThatCannotBeDecodedIsNotStored) {
    collection_.open();
    std::vector<std::uint8_t> damaged = png_of(image::scene(40, 30, 1).view());
    damaged.resize(60);
    const auto refused = service().add(damaged, {});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kUndecodable);
    EXPECT_TRUE(service().list({}).value().empty());
}

TEST_F(ImageServiceTest, AnswersUnavailableUntilTheCollectionIsLoaded) {
    sql("ALTER TABLE changes RENAME TO elsewhere");
    ImageServiceOptions wanted;
    wanted.database_path = collection_.path();
    wanted.poll_interval = std::chrono::milliseconds(1);
    auto opened = ImageService::open(wanted);
    ASSERT_TRUE(opened) << opened.error().message;
    const auto refused = opened.value()->search(picture(1), options());
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kUnavailable);
    EXPECT_FALSE(opened.value()->status().value().ready);
    sql("ALTER TABLE elsewhere RENAME TO changes");
    EXPECT_TRUE(becomes_true([&] { return opened.value()->ready(); }));
    EXPECT_TRUE(opened.value()->search(picture(1), options()));
}

TEST_F(ImageServiceTest, ADamagedSignatureIsUndecodableAndTheRestIsFound) {
    collection_.open();
    const ImageId sound = collection_.add(1);
    const ImageId broken = collection_.add(2);
    sql("UPDATE images SET signature = x'4853' WHERE id = " +
        std::to_string(to_int(broken)));
    const auto refused = service().signature(broken);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kUndecodable);
    EXPECT_TRUE(
        becomes_true([&] { return found(picture(2)) == std::vector<ImageId>{sound}; }));
    EXPECT_TRUE(becomes_true([&] { return service().status().value().damaged == 1; }));
}

TEST_F(ImageServiceTest, CountsWhatThereIs) {
    collection_.open();
    const ImageId id = collection_.add(1);
    collection_.add(2);
    const auto other = beside(collection_);
    ASSERT_TRUE(other->images().mark_failed("file:///bad.jpg", {}, "broken"));
    const ImageId file = other->images().add(file_row(3, "file:///c.jpg")).value();
    ASSERT_TRUE(
        becomes_true([&] { return service().status().value().index.images == 3; }));
    ASSERT_TRUE(service().remove(id));
    ASSERT_TRUE(service().remove(file));
    const ServiceStatus status = service().status().value();
    EXPECT_EQ(status.rows.indexed, 1);
    EXPECT_EQ(status.rows.failed, 1);
    EXPECT_EQ(status.rows.deleted, 1);
    EXPECT_EQ(status.index.images, 1);
    EXPECT_EQ(status.index_m, 60);
    EXPECT_TRUE(status.ready);
    EXPECT_GT(status.sequence, 0);
}

TEST_F(ImageServiceTest, ADatabaseThatCannotBeHadIsAnError) {
    schema::write_bytes(collection_.folder.file("notes.txt"), std::string(5000, 'x'));
    ImageServiceOptions wanted;
    wanted.database_path = collection_.folder.file("notes.txt");
    const auto refused = ImageService::open(wanted);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kNotADatabase);
}

TEST_F(ImageServiceTest, ReadsFailWithAnErrorWhereTheDatabaseDoes) {
    collection_.open();
    sql("ALTER TABLE images RENAME TO elsewhere");
    const auto counts = service().status();
    ASSERT_FALSE(counts);
    EXPECT_EQ(counts.error().code, ErrorCode::kIo);
    EXPECT_FALSE(service().add(jpeg_scene(1), {}));
}

// Every answer must be right for some moment of the collection: the pictures that stay are
// always found, each once, in their order; one that comes and goes may be there or not.
TEST_F(ImageServiceTest, SearchesStayRightWhileOthersAddAndRemove) {
    collection_.open();
    std::vector<ImageId> staying;
    for (unsigned number = 1; number <= 5; ++number)
        staying.push_back(collection_.add(number));
    const std::vector<ImageId> order = found(picture(1));
    ASSERT_EQ(order.size(), staying.size());
    const QueryPicture query = picture(1);
    const std::vector<std::uint8_t> passing = jpeg_scene(9);

    std::atomic<bool> done = false;
    std::atomic<int> wrong = 0;
    std::atomic<int> searches = 0;
    std::vector<std::thread> threads;
    for (int reader = 0; reader < 3; ++reader)
        threads.emplace_back([&] {
            while (!done) {
                const auto answer = service().search(query, options());
                std::vector<ImageId> seen;
                if (answer)
                    for (const FoundImage& match : answer->found.images)
                        if (std::count(staying.begin(), staying.end(), match.image.id) !=
                            0)
                            seen.push_back(match.image.id);
                if (seen != order) ++wrong;
                ++searches;
            }
        });
    std::vector<std::thread> writers;
    for (int writer = 0; writer < 2; ++writer)
        writers.emplace_back([&] {
            for (int i = 0; i < 15; ++i) {
                const auto id = service().add(passing, {});
                if (!id || !service().remove(id.value())) ++wrong;
            }
        });
    for (std::thread& writer : writers) writer.join();
    EXPECT_TRUE(becomes_true([&] { return searches > 10; }));
    done = true;
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(found(query), order);
}

}  // namespace
}  // namespace haarmony::server
