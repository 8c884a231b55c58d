// The disk fails under the stores of profiles, jobs, feedback and duplicates, and under the
// newer parts of the pictures: after any failing step all of a function is there or nothing.
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <functional>

#include "schema/duplicate_store.h"
#include "schema/feedback_store.h"
#include "schema/image_store.h"
#include "schema/job_store.h"
#include "schema/profile_store.h"
#include "schema/snapshot_store.h"
#include "schema/video_store.h"
#include "tests/schema/failing_files.h"
#include "tests/schema/pictures.h"
#include "tests/schema/raw_sql.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::schema {
namespace {

// All stores on one connection, with something in each.
struct Stores {
    explicit Stores(const std::string& path) : database(open_database(path)) {}

    Database database;
    ImageStore images{database};
    ProfileStore profiles{database};
    JobStore jobs{database};
    FeedbackStore feedback{database};
    DuplicateStore duplicates{database};
    SnapshotStore snapshots{database};
    VideoStore videos{database};
};

StoredProfile some_profile() {
    StoredProfile profile;
    profile.name = "p";
    profile.color_space = "yiq";
    profile.decomposition = "standard";
    profile.m = 40;
    profile.bin_rule = "min";
    return profile;
}

NewFeedback some_feedback() {
    NewFeedback feedback;
    feedback.kind = "painted";
    feedback.target = ImageId{1};
    feedback.strokes = "{}";
    return feedback;
}

Video some_video() {
    Video video;
    video.revision = "0123456789abcdef";
    video.width = 2;
    video.height = 3;
    video.frames = 4;
    return video;
}

Result<Video> add_video(Stores& stores) {
    const std::vector<FrameSignature> frames{{0, 0, 2, 0, 0, {1}}, {0, 0, 2, 1, 0, {2}}};
    return stores.videos.add(
        some_video(), frames, [](const Video&) { return Result<void>(); });
}

// Video 1, pictures 1 and 2, profile p, job 1 running, feedback 1, generation 1 published and 2 open.
void fill(const std::string& path) {
    Stores stores(path);
    expect(add_video(stores));
    for (int number = 1; number <= 2; ++number) {
        NewImage image = upload_picture(number);
        image.variants = {{"lab", some_bytes(number, 50)}};
        expect(stores.images.add(image));
    }
    expect(stores.profiles.put(some_profile()));
    expect(stores.jobs.start(expect(stores.jobs.create("t", "{}")).id));
    expect(stores.feedback.add(some_feedback()));
    const auto generation = expect(stores.duplicates.begin_generation());
    expect(stores.duplicates.add(
        generation, std::vector<DuplicatePair>{{ImageId{1}, ImageId{2}, "near", 1}}));
    expect(stores.duplicates.publish(generation));
    expect(stores.duplicates.begin_generation());
}

// Every row of every table that a store writes, without the times.
std::string rows_of(const std::string& path) {
    const Database database = open_database(path);
    std::string all;
    for (const std::string columns :
         {"id, uri, metadata, revision FROM images",
          "image_id, tag FROM image_tags",
          "image_id, variant, hex(signature) FROM image_signatures",
          "rowid, uri, tags, metadata FROM image_text",
          "seq, image_id FROM changes",
          "revision, name, m FROM profiles",
          "id, state, cancel_requested, seen, position, result FROM jobs",
          "job_id, number, message FROM job_errors",
          "id, kind, target FROM feedback",
          "generation, published FROM duplicate_generations",
          "generation, a, b FROM duplicates",
          "a, b FROM ignored_duplicates",
          "number, seq FROM snapshots",
          "id, revision, name, frames FROM videos",
          "id, video_id, node, hex(signature) FROM frame_signatures"}) {
        const auto from = columns.find(" FROM");
        all += sql_text(database.handle(),
                        "SELECT coalesce(group_concat(json_array(" +
                            columns.substr(0, from) + ")), '') " + columns.substr(from)) +
               '\n';
    }
    EXPECT_EQ(sql_text(database.handle(), "PRAGMA integrity_check"), "ok");
    run_sql(database.handle(),
            "INSERT INTO image_text (image_text) VALUES ('integrity-check')");
    return all;
}

template <typename T>
Result<void> without_value(const Result<T>& result) {
    if (!result) return result.error();
    return {};
}

struct Operation {
    const char* name;
    Result<void> (*run)(Stores&);
};

class StoreFailure : public testing::TestWithParam<Operation> {};

TEST_P(StoreFailure, AtAnyStepAllOfItIsThereOrNothing) {
    FailingFiles files;
    const ScratchFolder folder;
    const std::string fresh = folder.file("fresh.db");
    fill(fresh);
    const std::string before = rows_of(fresh);
    const std::string bytes = read_bytes(fresh);
    std::string after;
    for (int step = 0;; ++step) {
        SCOPED_TRACE(step);
        const std::string path = folder.file(std::to_string(step) + ".db");
        write_bytes(path, bytes);
        bool succeeded = false;
        bool failed = false;
        {
            Stores stores(path);
            files.fail_from(step, SQLITE_IOERR_WRITE);
            const Result<void> result = GetParam().run(stores);
            failed = files.failed();
            files.never_fail();
            succeeded = result.has_value();
            if (!succeeded) {
                EXPECT_EQ(result.error().code, ErrorCode::kIo) << result.error().message;
                EXPECT_NE(result.error().message.find("cannot "), std::string::npos)
                    << result.error().message;
            }
        }
        const std::string now = rows_of(path);
        if (!failed) {
            ASSERT_TRUE(succeeded);
            EXPECT_NE(now, before);
            // A failure after the last write of the log may leave all of it.
            EXPECT_TRUE(after.empty() || after == now) << after << now;
            EXPECT_GE(step, 2);
            return;
        }
        EXPECT_FALSE(succeeded);
        if (now != before) after = now;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Each,
    StoreFailure,
    testing::Values(
        Operation{"SetVariant",
                  [](Stores& s) {
                      return s.images.set_variant(ImageId{1}, {"rgb", some_bytes(9, 50)});
                  }},
        Operation{"Update",
                  [](Stores& s) {
                      NewImage image = upload_picture(3);
                      image.variants = {{"rgb", some_bytes(9, 50)}};
                      return s.images.update(ImageId{1}, image);
                  }},
        Operation{"Describe",
                  [](Stores& s) {
                      return s.images.describe(
                          ImageId{1},
                          {.uri = "other",
                           .tags = std::vector<std::string>{"x", "y"},
                           .metadata = R"({"k":"v"})"});
                  }},
        Operation{"PutProfile", [](Stores& s) { return s.profiles.put(some_profile()); }},
        Operation{"RemoveProfile", [](Stores& s) { return s.profiles.remove("p"); }},
        Operation{"CreateJob",
                  [](Stores& s) { return without_value(s.jobs.create("t", "{}")); }},
        Operation{"Progress",
                  [](Stores& s) {
                      return s.jobs.progress(
                          1, {.seen = 3}, 9, "p", std::vector<std::string>{"e", "f"});
                  }},
        Operation{"FinishJob",
                  [](Stores& s) {
                      return s.jobs.finish(
                          1, JobState::kDone, "{}", std::vector<std::string>{"e"});
                  }},
        Operation{"CancelJob", [](Stores& s) { return without_value(s.jobs.cancel(1)); }},
        Operation{"RequeueJobs",
                  [](Stores& s) { return without_value(s.jobs.requeue_running()); }},
        Operation{
            "AddFeedback",
            [](Stores& s) { return without_value(s.feedback.add(some_feedback())); }},
        Operation{"AddSnapshot",
                  [](Stores& s) { return without_value(s.snapshots.add(1)); }},
        Operation{"AddVideo", [](Stores& s) { return without_value(add_video(s)); }},
        Operation{"RemoveVideo",
                  [](Stores& s) { return without_value(s.videos.remove(1)); }},
        Operation{"RemoveFeedback", [](Stores& s) { return s.feedback.remove(1); }},
        Operation{
            "BeginGeneration",
            [](Stores& s) { return without_value(s.duplicates.begin_generation()); }},
        Operation{"AddDuplicates",
                  [](Stores& s) {
                      return s.duplicates.add(2,
                                              std::vector<DuplicatePair>{
                                                  {ImageId{1}, ImageId{2}, "near", 1}});
                  }},
        Operation{"Publish", [](Stores& s) { return s.duplicates.publish(2); }},
        Operation{"Discard", [](Stores& s) { return s.duplicates.discard(2); }},
        Operation{"Ignore",
                  [](Stores& s) { return s.duplicates.ignore(ImageId{1}, ImageId{2}); }}),
    [](const auto& operation) { return std::string(operation.param.name); });

TEST(BrokenPage, IsAnErrorOfEveryFunctionOfTheStoresThatMeetsIt) {
    using Call = std::function<Result<void>(Stores&)>;
    const std::vector<std::string> none;
    const std::vector<DuplicatePair> pair = {{ImageId{1}, ImageId{2}, "near", 1}};
    const std::pair<std::string, std::vector<Call>> cases[] = {
        {"image_signatures",
         {[](Stores& s) {
              return without_value(
                  s.images.for_each_searchable([](const SearchableImage&) {}));
          },
          [](Stores& s) { return without_value(s.images.changes_after(0, 9)); },
          [](Stores& s) { return without_value(s.images.signature(ImageId{1}, "lab")); },
          [](Stores& s) {
              return s.images.set_variant(ImageId{1}, {"lab", {1}});
          },
          [](Stores& s) { return s.images.update(ImageId{1}, upload_picture(1)); }}},
        {"image_signatures_variant",
         {[](Stores& s) {
              return without_value(s.images.without_variant("lab", std::nullopt, 9));
          },
          [](Stores& s) { return without_value(s.images.variant_counts()); }}},
        {"image_text_data",
         {[](Stores& s) {
              return without_value(s.images.matching({.text = "all", .tags = {}}));
          },
          [](Stores& s) {
              return without_value(s.images.list(
                  {.limit = 1, .after = std::nullopt, .tags = {}, .text = "all"}));
          },
          [](Stores& s) { return without_value(s.images.add(upload_picture(5))); }}},
        {"image_tags", {[](Stores& s) {
             return s.images.describe(
                 ImageId{1},
                 {.uri = {}, .tags = std::vector<std::string>{"x"}, .metadata = {}});
         }}},
        {"profiles",
         {[](Stores& s) { return s.profiles.put(some_profile()); },
          [](Stores& s) { return without_value(s.profiles.list()); }}},
        {"sqlite_autoindex_profiles_1",
         {[](Stores& s) { return without_value(s.profiles.get("p")); },
          [](Stores& s) { return s.profiles.remove("p"); }}},
        {"jobs",
         {[](Stores& s) { return without_value(s.jobs.create("t", "{}")); },
          [](Stores& s) { return without_value(s.jobs.get(1)); },
          [](Stores& s) { return without_value(s.jobs.list(9, std::nullopt)); },
          [](Stores& s) { return s.jobs.start(1); },
          [&](Stores& s) { return s.jobs.progress(1, {}, 0, "", none); },
          [&](Stores& s) { return s.jobs.finish(1, JobState::kDone, "{}", none); },
          [](Stores& s) { return without_value(s.jobs.cancel(1)); },
          [](Stores& s) { return without_value(s.jobs.cancel_requested(1)); }}},
        {"jobs_state",
         {[](Stores& s) { return without_value(s.jobs.next_queued()); },
          [](Stores& s) { return without_value(s.jobs.requeue_running()); }}},
        {"job_errors",
         {[](Stores& s) { return without_value(s.jobs.get(1)); },
          [&](Stores& s) { return s.jobs.progress(1, {}, 0, "", none); }}},
        {"feedback",
         {[](Stores& s) { return without_value(s.feedback.add(some_feedback())); },
          [](Stores& s) {
              return without_value(s.feedback.list(std::nullopt, std::nullopt, 9));
          },
          [](Stores& s) { return s.feedback.remove(1); }}},
        {"feedback_kind",
         {[](Stores& s) { return without_value(s.feedback.count("painted")); }}},
        {"duplicate_generations",
         {[](Stores& s) { return without_value(s.duplicates.begin_generation()); },
          [&](Stores& s) { return s.duplicates.add(2, pair); },
          [](Stores& s) { return s.duplicates.publish(2); },
          [](Stores& s) { return s.duplicates.discard(2); }}},
        {"duplicate_generations_published",
         {[](Stores& s) { return without_value(s.duplicates.published_generation()); },
          [](Stores& s) { return without_value(s.duplicates.pairs(0)); }}},
        {"duplicates",
         {[](Stores& s) { return without_value(s.duplicates.pairs(0)); },
          [&](Stores& s) { return s.duplicates.add(2, pair); }}},
        {"ignored_duplicates",
         {[](Stores& s) { return s.duplicates.ignore(ImageId{1}, ImageId{2}); },
          [](Stores& s) { return without_value(s.duplicates.ignored()); }}},
        {"videos",
         {[](Stores& s) { return without_value(s.videos.get(1)); },
          [](Stores& s) { return without_value(s.videos.list(9, 0)); },
          [](Stores& s) { return without_value(s.videos.remove(1)); },
          [](Stores& s) { return without_value(add_video(s)); },
          [](Stores& s) {
              return s.videos.while_nobody_writes(
                  [](const std::vector<Video>&) { return Result<void>(); });
          }}},
        {"videos_job", {[](Stores& s) { return without_value(s.videos.made_by(1)); }}},
        {"sqlite_autoindex_frame_signatures_1",
         {[](Stores& s) { return without_value(s.videos.frames_version()); }}},
        {"frame_signatures",
         {[](Stores& s) { return without_value(s.videos.frames_after(0, 9)); }}},
        {"images_content",
         {[](Stores& s) { return without_value(s.duplicates.same_content()); }}},
    };
    const ScratchFolder folder;
    const std::string fresh = folder.file("fresh.db");
    fill(fresh);
    const std::string bytes = read_bytes(fresh);
    for (const auto& [object, calls] : cases) {
        const std::string path = folder.file(object + ".db");
        write_bytes(path, bytes);
        break_page(path, object);
        for (std::size_t call = 0; call < calls.size(); ++call) {
            SCOPED_TRACE(object + " " + std::to_string(call));
            Stores stores(path);
            const Result<void> result = calls[call](stores);
            ASSERT_FALSE(result);
            EXPECT_EQ(result.error().code, ErrorCode::kIo) << result.error().message;
            // SQLite's number for a damaged file; its words depend on who meets it first.
            EXPECT_NE(result.error().message.find("SQLite 11"), std::string::npos)
                << result.error().message;
            EXPECT_NE(result.error().message.find("cannot "), std::string::npos)
                << result.error().message;
        }
    }
}

}  // namespace
}  // namespace haarmony::schema
