#include "server/app/reindex_job.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ingest/describe.h"
#include "ingest/file_uri.h"
#include "ingest/media_fragment.h"
#include "ingest/stored_profile.h"
#include "ingest/thumbnail.h"
#include "tests/server/app/collection.h"
#include "tests/server/app/job_watch.h"

namespace haarmony::server {
namespace {

using Bytes = std::vector<std::uint8_t>;
using image::ColorSpace;
using image::Decomposition;
using image::SignatureKind;
using schema::JobCounts;
using schema::JobState;

constexpr SignatureKind kLab{ColorSpace::kLab, Decomposition::kStandard};
constexpr SignatureKind kRgb{ColorSpace::kRgb, Decomposition::kStandard};

class ReindexTest : public testing::Test {
  protected:
    ReindexTest() : other_(beside(collection_)) {}

    static std::string name_of(unsigned number) {
        return std::to_string(number) + ".jpg";
    }
    [[nodiscard]] std::string path(unsigned number) const {
        return media_.file(name_of(number));
    }
    // A picture as haarmony-ingest takes it in, before anybody wanted another kind.
    ImageId add_file(unsigned number) {
        schema::write_bytes(path(number), text_of(jpeg_scene(number)));
        return other_->images()
            .add(file_row(number, ingest::file_uri(path(number))))
            .value();
    }
    ImageId add_upload(unsigned number) {
        schema::NewImage row = file_row(number, "");
        row.origin = schema::ImageOrigin::kUpload;
        return other_->images().add(row).value();
    }
    void use_kind(const std::string& name, const SignatureKind& kind) {
        image::Profile profile = *image::built_in_profile("painted");
        profile.name = name;
        profile.kind = kind;
        ASSERT_TRUE(other_->profiles().put(ingest::to_stored(profile)));
    }
    std::unique_ptr<JobRunner> runner() {
        JobRunnerOptions options;
        options.database_path = collection_.path();
        options.progress_interval = std::chrono::milliseconds(0);
        auto started =
            JobRunner::start(options, {{"reindex", reindex_job(ingest::DecodeLimits{})}});
        EXPECT_TRUE(started);
        return std::move(started).value();
    }
    schema::Job reindex(const std::string& request) {
        return done(*runner(), "reindex", request);
    }
    [[nodiscard]] std::optional<Bytes> variant(ImageId id, const std::string& name) {
        const auto bytes = other_->images().signature(id, name);
        if (!bytes) return {};
        return bytes.value();
    }
    // What ingest gives a new picture of these bytes.
    static Bytes fresh(const Bytes& file, const SignatureKind& kind) {
        ingest::Decoder decoder{ingest::DecodeLimits{}};
        const auto row =
            ingest::describe(decoder, file, std::vector{SignatureKind{}, kind});
        return row.value().variants.front().signature;
    }

    schema::ScratchFolder media_;
    Collection collection_;
    std::unique_ptr<Connection> other_;
};

TEST_F(ReindexTest, GivesEveryPictureTheKindsInUseAndASecondRunFindsNothingToDo) {
    const std::vector<ImageId> files{add_file(1), add_file(2), add_file(3)};
    const ImageId upload = add_upload(4);
    use_kind("lab", kLab);
    use_kind("rgb", kRgb);
    const schema::Job job = reindex("{}");
    EXPECT_EQ(job.state, JobState::kDone);
    EXPECT_EQ(job.counts, (JobCounts{4, 0, 4, 0, 0}));
    EXPECT_EQ(job.total, 4);
    for (unsigned number = 1; number <= 3; ++number) {
        EXPECT_EQ(variant(files[number - 1], "lab-standard"),
                  fresh(jpeg_scene(number), kLab));
        EXPECT_EQ(variant(files[number - 1], "rgb-standard"),
                  fresh(jpeg_scene(number), kRgb));
    }
    // An upload has nothing but its thumbnail.
    const Bytes thumbnail = other_->images().thumbnail(upload).value().bytes;
    EXPECT_EQ(variant(upload, "lab-standard"), fresh(thumbnail, kLab));
    EXPECT_EQ(reindex("{}").counts, (JobCounts{4, 0, 0, 4, 0}));
}

TEST_F(ReindexTest, AFrameOfAFilmHasNothingButItsThumbnail) {
    schema::write_bytes(path(1), text_of(jpeg_scene(1)));
    schema::NewImage row =
        file_row(2, ingest::key_frame_uri(ingest::file_uri(path(1)), 1'000'000));
    const ImageId id = other_->images().add(row).value();
    const auto main = other_->images().signature(id);
    use_kind("lab", kLab);
    EXPECT_EQ(reindex(R"({"all":true})").counts, (JobCounts{1, 0, 1, 0, 0}));
    const Bytes thumbnail = other_->images().thumbnail(id).value().bytes;
    EXPECT_EQ(variant(id, "lab-standard"), fresh(thumbnail, kLab));
    EXPECT_EQ(*other_->images().signature(id), *main);
}

TEST_F(ReindexTest, ARunningServiceFindsThePicturesUnderTheirNewKind) {
    collection_.open();
    add_file(1);
    collection_.add(2);
    use_kind("lab", kLab);
    ASSERT_EQ(reindex(R"({"profile":"lab"})").counts.updated, 2);
    EXPECT_TRUE(becomes_true([&] {
        const ServiceStatus status = collection_.service->status().value();
        for (const auto& [name, count] : status.variants)
            if (name == "lab-standard" && count == 2) return true;
        return false;
    }));
}

TEST_F(ReindexTest, MakesOnlyTheKindThatIsAskedFor) {
    const ImageId id = add_file(1);
    use_kind("lab", kLab);
    const schema::Job job =
        reindex(R"({"color_space":"luv","decomposition":"nonstandard"})");
    EXPECT_EQ(job.counts.updated, 1);
    EXPECT_TRUE(variant(id, "luv-nonstandard"));
    EXPECT_FALSE(variant(id, "lab-standard"));
    EXPECT_EQ(reindex(R"({"profile":"painted"})").counts.skipped, 1);
}

TEST_F(ReindexTest, FilesThatAreGoneChangedOrDamagedAreNamedAndStaySearchable) {
    const ImageId gone = add_file(1);
    const ImageId changed = add_file(2);
    const ImageId sound = add_file(3);
    std::remove(path(1).c_str());
    schema::write_bytes(path(2), text_of(jpeg_scene(9)));
    Bytes damaged_bytes = jpeg_scene(4);
    damaged_bytes.resize(damaged_bytes.size() / 8);
    schema::write_bytes(path(4), text_of(damaged_bytes));
    schema::NewImage row = file_row(4, ingest::file_uri(path(4)));
    row.stamp.content_hash = ingest::content_hash(damaged_bytes);
    const ImageId damaged = other_->images().add(row).value();
    schema::NewImage elsewhere = file_row(5, "http://example.org/a.jpg");
    ASSERT_TRUE(other_->images().add(elsewhere));

    const schema::Job job = reindex(R"({"color_space":"lab"})");
    EXPECT_EQ(job.state, JobState::kDone);
    EXPECT_EQ(job.counts, (JobCounts{5, 0, 1, 0, 4}));
    ASSERT_EQ(job.errors.size(), 4);
    EXPECT_EQ(job.errors[0], "image 1: the file is gone");
    EXPECT_EQ(job.errors[1], "image 2: changed since it was ingested; ingest it again");
    EXPECT_TRUE(job.errors[2].starts_with("image 4: ")) << job.errors[2];
    EXPECT_EQ(job.errors[3], "image 5: its address names no file");
    EXPECT_TRUE(variant(sound, "lab-standard"));
    for (const ImageId id : {gone, changed, damaged}) {
        EXPECT_FALSE(variant(id, "lab-standard"));
        EXPECT_EQ(other_->images().get(id)->state, schema::ImageState::kIndexed);
        EXPECT_TRUE(other_->images().signature(id));
    }
}

TEST_F(ReindexTest, AFileThatCannotBeReadIsNamedWithoutItsPath) {
    add_file(1);
    std::remove(path(1).c_str());
    ASSERT_EQ(std::fopen(path(1).c_str(), "r"), nullptr);
    // A name in the way of a folder: longer than any file system takes.
    schema::NewImage row = file_row(2, ingest::file_uri("/" + std::string(5000, 'a')));
    ASSERT_TRUE(other_->images().add(row));
    const schema::Job job = reindex(R"({"color_space":"lab"})");
    EXPECT_EQ(job.errors,
              (std::vector<std::string>{"image 1: the file is gone",
                                        "image 2: the file cannot be read"}));
}

TEST_F(ReindexTest, AllMakesAnewWhatFilesHaveAndKeepsWhatIsSaidOfThem) {
    const ImageId file = add_file(1);
    const ImageId upload = add_upload(2);
    use_kind("lab", kLab);
    const Bytes wrong = fresh(jpeg_scene(7), kLab);
    for (const ImageId id : {file, upload})
        ASSERT_TRUE(other_->images().set_variant(id, {"lab-standard", wrong}));
    schema::NewImage old = file_row(7, ingest::file_uri(path(1)));
    old.stamp = other_->images().get(file)->stamp;
    ASSERT_TRUE(other_->images().update(file, old));
    ASSERT_TRUE(other_->images().describe(
        file, {std::nullopt, std::vector<std::string>{"sea"}, std::nullopt}));
    const schema::Image before = other_->images().get(file).value();

    EXPECT_EQ(reindex(R"({"all":true})").counts, (JobCounts{2, 0, 1, 1, 0}));
    EXPECT_EQ(variant(file, "lab-standard"), fresh(jpeg_scene(1), kLab));
    EXPECT_EQ(other_->images().signature(file).value(), file_row(1, "x").signature);
    const schema::Image after = other_->images().get(file).value();
    EXPECT_EQ(after.uri, before.uri);
    EXPECT_EQ(after.tags, before.tags);
    EXPECT_EQ(after.stamp.mtime_ns, before.stamp.mtime_ns);
    // What was made of an upload's own pixels is better than what its thumbnail gives.
    EXPECT_EQ(variant(upload, "lab-standard"), wrong);
}

TEST_F(ReindexTest, AllOfTheFirstKindKeepsTheOthers) {
    const ImageId file = add_file(1);
    use_kind("lab", kLab);
    ASSERT_EQ(reindex(R"({"profile":"painted","all":true})").counts.updated, 1);
    EXPECT_EQ(variant(file, "lab-standard"), fresh(jpeg_scene(1), kLab));
}

TEST_F(ReindexTest, GoesOnAfterTheLastPictureThatAnEarlierRunSaw) {
    std::vector<ImageId> ids;
    for (unsigned number = 1; number <= 4; ++number) ids.push_back(add_file(number));
    schema::JobStore& jobs = other_->jobs();
    const std::int64_t id = jobs.create("reindex", R"({"color_space":"lab"})")->id;
    ASSERT_TRUE(jobs.start(id));
    ASSERT_TRUE(
        jobs.progress(id, {2, 0, 1, 0, 1}, 4, "2", std::vector<std::string>{"x"}));
    const schema::Job job = finished(*runner(), id);
    EXPECT_EQ(job.counts, (JobCounts{4, 0, 3, 0, 1}));
    EXPECT_EQ(job.errors, std::vector<std::string>{"x"});
    for (std::size_t i = 0; i < ids.size(); ++i)
        EXPECT_EQ(variant(ids[i], "lab-standard").has_value(), i >= 2) << i;
}

TEST_F(ReindexTest, StoppedInTheMiddleItSeesEveryPictureOnce) {
    constexpr int kPictures = 70;  // more than one page
    std::vector<ImageId> ids;
    schema::write_bytes(path(1), text_of(jpeg_scene(1)));
    for (int i = 0; i < kPictures; ++i) {
        schema::NewImage row = file_row(1, ingest::file_uri(path(1)));
        row.origin = schema::ImageOrigin::kUpload;
        ids.push_back(other_->images().add(row).value());
    }
    auto jobs = runner();
    const std::int64_t id = jobs->create("reindex", R"({"color_space":"lab"})")->id;
    ASSERT_TRUE(becomes_true([&] { return jobs->get(id)->counts.seen > 0; }));
    jobs->stop();
    jobs = runner();
    const schema::Job job = finished(*jobs, id);
    EXPECT_EQ(job.state, JobState::kDone);
    EXPECT_EQ(job.counts, (JobCounts{kPictures, 0, kPictures, 0, 0}));
    for (const ImageId picture : ids) EXPECT_TRUE(variant(picture, "lab-standard"));
}

TEST_F(ReindexTest, ARequestThatMakesNoSenseFailsTheJob) {
    for (const std::string request : {R"({"profile":"gone"})",
                                      R"({"profile":1})",
                                      R"({"color_space":"cmyk"})",
                                      R"({"decomposition":"x"})",
                                      R"({"all":1})"}) {
        const schema::Job job = reindex(request);
        EXPECT_EQ(job.state, JobState::kFailed) << request;
        EXPECT_EQ(job.errors.size(), 1) << request;
    }
}

}  // namespace
}  // namespace haarmony::server
