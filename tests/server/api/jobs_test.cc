// /jobs: queued, listed, followed, cancelled, and what is refused before it is queued.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "ingest/file_uri.h"
#include "tests/server/api/interface.h"
#include "tests/server/app/job_watch.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

class JobsTest : public testing::Test {
  protected:
    JobsTest() : interface_({media_.path()}) {}

    // The job once it has finished.
    json finished_job(const http::Response& queued) {
        const auto id = json_of(queued)["id"].get<std::int64_t>();
        (void)finished(*interface_.jobs, id);
        return json_of(interface_.get("/jobs/" + std::to_string(id)));
    }
    json run(const json& request) {
        const http::Response response = interface_.post_json("/jobs", request);
        EXPECT_EQ(response.status, 202) << body_of(response);
        return finished_job(response);
    }

    schema::ScratchFolder media_;
    Interface interface_;
};

TEST_F(JobsTest, AJobIsQueuedUnderAnAddressThatTellsHowItEnded) {
    interface_.collection.add(1);
    const http::Response queued =
        interface_.post_json("/jobs", {{"type", "reindex"}, {"color_space", "lab"}});
    ASSERT_EQ(queued.status, 202);
    EXPECT_EQ(header_of(queued, "Location"), "/jobs/1");
    const json job = finished_job(queued);
    EXPECT_EQ(job["state"], "done");
    EXPECT_EQ(job["type"], "reindex");
    EXPECT_EQ(job["request"], (json{{"color_space", "lab"}}));
    EXPECT_EQ(job["counts"]["seen"], 1);
    EXPECT_EQ(job["counts"]["updated"], 1);
    EXPECT_EQ(job["total"], 1);
    EXPECT_GT(job["rate"], 0.0);
    EXPECT_EQ(job["eta_s"], nullptr);
    EXPECT_EQ(job["errors"], json::array());
    EXPECT_TRUE(job["finished_at"].is_string());
    EXPECT_EQ(header_of(interface_.get("/jobs/1"), "Cache-Control"), "no-store");
}

TEST_F(JobsTest, ThePagesOfTheListHaveEveryJobOnceTheNewestFirst) {
    for (int i = 0; i < 5; ++i) run({{"type", "reindex"}});
    std::vector<std::int64_t> ids;
    std::string cursor;
    do {
        const json page = json_of(interface_.get(
            "/jobs?limit=2" + (cursor.empty() ? "" : "&cursor=" + cursor)));
        for (const json& item : page["items"]) ids.push_back(item["id"]);
        cursor = page["next_cursor"].is_null() ? "" : page["next_cursor"];
    } while (!cursor.empty());
    EXPECT_EQ(ids, (std::vector<std::int64_t>{5, 4, 3, 2, 1}));
}

TEST_F(JobsTest, IngestTakesInAFolderAndNamesWhatFailedByItsAddress) {
    for (unsigned number = 1; number <= 3; ++number)
        schema::write_bytes(media_.file(std::to_string(number) + ".jpg"),
                            text_of(jpeg_scene(number)));
    schema::write_bytes(media_.file("bad.jpg"), text_of(jpeg_scene(4)).substr(0, 200));
    const json request{{"type", "ingest"}, {"paths", {media_.path()}}};
    const json job = run(request);
    EXPECT_EQ(job["state"], "done");
    EXPECT_EQ(
        job["counts"],
        (json{{"seen", 4}, {"added", 3}, {"updated", 0}, {"skipped", 0}, {"failed", 1}}));
    ASSERT_EQ(job["errors"].size(), 1);
    EXPECT_TRUE(job["errors"][0].get<std::string>().starts_with(
        ingest::file_uri(media_.file("bad.jpg")) + ": "));
    EXPECT_TRUE(becomes_true(
        [&] { return json_of(interface_.get("/status"))["searchable"] == 3; }));
    EXPECT_EQ(run(request)["counts"]["skipped"], 3);
}

TEST_F(JobsTest, IngestTakesInTheKeyFramesOfFilmsWhenAskedTo) {
    // Every frame of these is a key frame.
    std::string film = "YUV4MPEG2 W16 H16 F5:1 C444\n";
    for (int frame = 0; frame < 6; ++frame)
        film += "FRAME\n" + std::string(3 * 16 * 16, static_cast<char>(40 * frame));
    schema::write_bytes(media_.file("film.y4m"), film);
    json request{{"type", "ingest"}, {"paths", {media_.path()}}};
    EXPECT_EQ(run(request)["counts"]["seen"], 0);
    request["videos"] = true;
    const json job = run(request);
    EXPECT_EQ(
        job["counts"],
        (json{{"seen", 1}, {"added", 6}, {"updated", 0}, {"skipped", 0}, {"failed", 0}}));
    EXPECT_TRUE(becomes_true(
        [&] { return json_of(interface_.get("/status"))["searchable"] == 6; }));
    const json frame = json_of(interface_.get("/images/4"));
    const std::string uri = ingest::file_uri(media_.file("film.y4m"));
    EXPECT_EQ(frame["uri"], uri + "#t=0.600");
    EXPECT_EQ(frame["metadata"], (json{{"video", uri}, {"time", 0.6}, {"frame", 3}}));
    const json matches = json_of(interface_.get("/query?id=4"))["matches"];
    EXPECT_EQ(matches[0]["id"], 4);
    EXPECT_EQ(matches[0]["metadata"]["time"], 0.6);
    schema::write_bytes(media_.file("again.y4m"), film);
    request["max_key_frames"] = 3;
    EXPECT_EQ(run(request)["counts"]["added"], 3);
}

TEST_F(JobsTest, IngestReadsNothingOutsideTheMediaRoots) {
    const schema::ScratchFolder elsewhere;
    const auto refusal = [&](const json& paths) {
        return refusal_of(
            interface_.post_json("/jobs", {{"type", "ingest"}, {"paths", paths}}));
    };
    EXPECT_EQ(refusal({elsewhere.path()}), (Refusal{403, "forbidden", "paths"}));
    EXPECT_EQ(refusal({media_.path() + "/../x"}), (Refusal{403, "forbidden", "paths"}));
    EXPECT_EQ(refusal({media_.file("gone")}), (Refusal{404, "not_found", "paths"}));
    EXPECT_EQ(refusal({"relative"}), (Refusal{400, "invalid_argument", "paths"}));
    EXPECT_EQ(refusal(json::array()), (Refusal{400, "invalid_argument", "paths"}));
    EXPECT_EQ(json_of(interface_.get("/jobs"))["items"], json::array());
}

TEST_F(JobsTest, AFolderThatIsGoneWhenItsTurnComesFailsTheJob) {
    const auto job =
        interface_.jobs->create("ingest", json{{"paths", {media_.file("gone")}}}.dump());
    ASSERT_TRUE(job);
    const schema::Job ended = finished(*interface_.jobs, job->id);
    EXPECT_EQ(ended.state, schema::JobState::kFailed);
    EXPECT_EQ(ended.errors.size(), 1);
    const std::string here = R"({"paths":[")" + media_.path() + R"("],)";
    for (const std::string& request : {std::string("{}"),
                                       std::string(R"({"paths":"x"})"),
                                       std::string(R"({"paths":[1]})"),
                                       here + R"("videos":1})",
                                       here + R"("max_key_frames":0})",
                                       here + R"("max_key_frames":"many"})"})
        EXPECT_EQ(done(*interface_.jobs, "ingest", request).state,
                  schema::JobState::kFailed)
            << request;
}

TEST_F(JobsTest, ASnapshotIsWrittenAndToldAbout) {
    for (unsigned number = 1; number <= 3; ++number) interface_.collection.add(number);
    const json job = run({{"type", "snapshot"}});
    EXPECT_EQ(job["state"], "done");
    const auto bytes =
        std::filesystem::file_size(snapshot_path_of(interface_.collection.path()));
    EXPECT_EQ(job["counts"]["seen"], bytes);
    EXPECT_EQ(job["total"], bytes);
    EXPECT_EQ(job["result"]["bytes"], bytes);
    EXPECT_EQ(job["result"]["images"], 3);
    const json status = json_of(interface_.get("/status"));
    EXPECT_EQ(job["result"]["sequence"], status["sequence"]);
    EXPECT_EQ(status["snapshot_sequence"], status["sequence"]);
    EXPECT_EQ(status["began_with_snapshot"], 0);
}

TEST_F(JobsTest, WhatCanNeverSucceedIsRefusedAtOnce) {
    const std::vector<std::pair<json, Refusal>> refusals{
        {json::object(), {400, "invalid_argument", "type"}},
        {{{"type", "paint"}}, {400, "invalid_argument", "type"}},
        {{{"type", 1}}, {400, "invalid_argument", "type"}},
        {{{"type", "snapshot"}, {"paths", {"/"}}}, {400, "unknown_parameter", "paths"}},
        {{{"type", "ingest"}}, {400, "invalid_argument", "paths"}},
        {{{"type", "ingest"}, {"paths", {media_.path()}}, {"videos", 1}},
         {400, "invalid_argument", "videos"}},
        {{{"type", "ingest"}, {"paths", {media_.path()}}, {"max_key_frames", 0}},
         {400, "invalid_argument", "max_key_frames"}},
        {{{"type", "reindex"}, {"paths", {"/"}}}, {400, "unknown_parameter", "paths"}},
        {{{"type", "reindex"}, {"profile", "x"}}, {400, "unknown_profile", "profile"}},
        {{{"type", "reindex"}, {"color_space", "x"}},
         {400, "invalid_argument", "color_space"}},
        {{{"type", "reindex"}, {"decomposition", "x"}},
         {400, "invalid_argument", "decomposition"}},
        {{{"type", "reindex"}, {"all", 1}}, {400, "invalid_argument", "all"}},
        {{{"type", "reindex"}, {"profile", "painted"}, {"color_space", "lab"}},
         {400, "invalid_argument", "profile"}},
        {{{"type", "find_duplicates"}, {"min_similarity", 2}},
         {400, "invalid_argument", "min_similarity"}},
        {{{"type", "find_duplicates"}, {"all", true}}, {400, "unknown_parameter", "all"}},
    };
    for (const auto& [request, refusal] : refusals)
        EXPECT_EQ(refusal_of(interface_.post_json("/jobs", request)), refusal) << request;
    EXPECT_EQ(refusal_of(interface_.get("/jobs?limit=0")),
              (Refusal{400, "invalid_argument", "limit"}));
    for (const char* path : {"/jobs/77", "/jobs/77/events"})
        EXPECT_EQ(refusal_of(interface_.get(path)), (Refusal{404, "not_found", "id"}));
    EXPECT_EQ(refusal_of(interface_.get("/jobs/x")),
              (Refusal{400, "invalid_argument", "id"}));
    EXPECT_EQ(refusal_of(interface_.get("/jobs/1?verbose=1")),
              (Refusal{400, "unknown_parameter", "verbose"}));
}

TEST_F(JobsTest, AFinishedJobCannotBeCancelled) {
    run({{"type", "reindex"}});
    EXPECT_EQ(interface_.send("DELETE", "/jobs/1").status, 409);
    EXPECT_EQ(interface_.send("DELETE", "/jobs/77").status, 404);
}

// Jobs that wait for the test, behind handlers of their own.
class HeldJobsTest : public testing::Test {
  protected:
    HeldJobsTest() {
        interface_.jobs->stop();
        JobRunnerOptions options;
        options.database_path = interface_.collection.path();
        options.progress_interval = std::chrono::milliseconds(0);
        JobTypes types;
        types["reindex"] = {[this](JobContext& job) -> Result<void> {
            job.set_total(8);
            job.counts().seen = 2;
            job.progress();
            gate_.pass(job);
            return {};
        }};
        interface_.replace_jobs(JobRunner::start(options, std::move(types)).value());
    }
    ~HeldJobsTest() override { gate_.open(); }

    Gate gate_;
    Interface interface_;
};

// What stands after "data: " in one event.
json job_of(const std::string& event) {
    const auto start = event.find("data: ");
    return json::parse(event.substr(start + 6), nullptr, false);
}

TEST_F(HeldJobsTest, EventsTellEachChangeAndTheEnd) {
    ASSERT_EQ(interface_.post_json("/jobs", {{"type", "reindex"}}).status, 202);
    ASSERT_TRUE(gate_.entered());
    const http::Response response = interface_.get("/jobs/1/events");
    EXPECT_EQ(response.status, 200);
    EXPECT_EQ(header_of(response, "Content-Type"), "text/event-stream");
    const auto& next = std::get<http::ChunkSource>(response.body);
    const std::string first = next().value();
    EXPECT_TRUE(first.starts_with("event: progress\ndata: {"));
    EXPECT_TRUE(first.ends_with("}\n\n"));
    EXPECT_EQ(job_of(first)["state"], "running");
    EXPECT_EQ(job_of(first)["counts"]["seen"], 2);
    EXPECT_GT(job_of(first)["rate"], 0.0);
    EXPECT_GT(job_of(first)["eta_s"], 0.0);
    EXPECT_EQ(next().value(), "");  // nothing has changed
    gate_.open();
    (void)finished(*interface_.jobs, 1);
    const std::string last = next().value();
    EXPECT_TRUE(last.starts_with("event: end\ndata: {"));
    EXPECT_EQ(job_of(last), json_of(interface_.get("/jobs/1")));
    EXPECT_EQ(next(), std::nullopt);
}

TEST_F(HeldJobsTest, ARunningJobAndAQueuedOneAreCancelled) {
    for (int i = 0; i < 2; ++i) interface_.post_json("/jobs", {{"type", "reindex"}});
    ASSERT_TRUE(gate_.entered());
    const http::Response queued = interface_.send("DELETE", "/jobs/2");
    EXPECT_EQ(queued.status, 200);
    EXPECT_EQ(json_of(queued)["state"], "cancelled");
    EXPECT_EQ(json_of(queued)["rate"], nullptr);
    EXPECT_EQ(json_of(interface_.send("DELETE", "/jobs/1"))["cancel_requested"], true);
    EXPECT_EQ(finished(*interface_.jobs, 1).state, schema::JobState::kCancelled);
}

TEST_F(HeldJobsTest, AStreamEndsWhenItsJobIsNoMoreThere) {
    interface_.post_json("/jobs", {{"type", "reindex"}});
    ASSERT_TRUE(gate_.entered());
    const http::Response response = interface_.get("/jobs/1/events");
    interface_.sql("DELETE FROM jobs");
    EXPECT_EQ(std::get<http::ChunkSource>(response.body)(), std::nullopt);
    EXPECT_EQ(refusal_of(interface_.get("/jobs/1")), (Refusal{404, "not_found", "id"}));
}

TEST_F(HeldJobsTest, ADatabaseThatFailsIsA500) {
    interface_.sql("ALTER TABLE jobs RENAME TO elsewhere");
    for (const http::Response& response :
         {interface_.get("/jobs"),
          interface_.get("/jobs/1"),
          interface_.get("/jobs/1/events"),
          interface_.get("/duplicates"),
          interface_.send("DELETE", "/jobs/1"),
          interface_.post_json("/jobs", {{"type", "reindex"}})})
        EXPECT_EQ(refusal_of(response), (Refusal{500, "internal", ""}));
    interface_.sql("ALTER TABLE elsewhere RENAME TO jobs");
}

}  // namespace
}  // namespace haarmony::server
