// Videos that must not be lost, and files that must not stay: kills in the middle of a build.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <string>
#include <thread>

#include "tests/e2e/collection.h"

namespace haarmony::e2e {
namespace {

using nlohmann::json;

constexpr int kSide = 128;
constexpr int kFrames = 16;

// Noise: nothing of it is shared, so that its build takes a while. No pixel is clear: those
// have no colour to come back.
std::string noise() {
    std::mt19937 random(1);
    std::string bytes(std::size_t{4} * kSide * kSide * kFrames, '\0');
    for (std::size_t i = 0; i < bytes.size(); ++i)
        bytes[i] = static_cast<char>(random() | (i % 4 == 3 ? 1U : 0U));
    return bytes;
}

std::string target() {
    return "/videos?width=" + std::to_string(kSide) + "&height=" + std::to_string(kSide);
}

json job_once(Daemon& daemon, const std::string& address, const std::string& state) {
    auto curl = daemon.client();
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes{2};
    for (;;) {
        json job = json::parse(curl.get(address).body);
        const bool ended = job["state"] == "done" || job["state"] == "failed";
        if (job["state"] == state || ended || std::chrono::steady_clock::now() > end)
            return job;
        std::this_thread::yield();
    }
}

std::set<std::string> files_beside(const std::string& database) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(database + ".videos"))
        names.insert(entry.path().filename());
    return names;
}

TEST(VideoSurvival, ABuildThatWasKilledIsDoneAfterTheNextStart) {
    const testing::TemporaryFolder folder;
    const std::string database = folder.file("haarmony.db");
    const std::vector<std::string> quiet{"--log-level", "warn"};
    std::string address;
    {
        Daemon daemon(database, quiet);
        auto curl = daemon.client();
        const auto queued = curl.post(target(), noise(), "application/octet-stream");
        ASSERT_EQ(queued.status, 202) << queued.body;
        address = queued.headers.at("location");
        EXPECT_EQ(job_once(daemon, address, "running")["state"], "running");
        daemon.kill_hard();
    }
    // Something of a build that nobody goes on with.
    write_file(database + ".videos/building-99", "half");
    write_file(database + ".videos/99-0123456789abcdef.mrv", "no row");
    Daemon daemon(database, quiet);
    const json job = job_once(daemon, address, "done");
    ASSERT_EQ(job["state"], "done") << job;
    auto curl = daemon.client();
    const json video = json::parse(curl.get("/videos/" + job["video"].dump()).body);
    EXPECT_EQ(video["frames"], kFrames);
    EXPECT_EQ(files_beside(database),
              std::set<std::string>{job["video"].dump() + "-" +
                                    video["revision"].get<std::string>() + ".mrv"});
    const std::string last =
        curl.get("/video/frame?format=rgba&frame=" + std::to_string(kFrames - 1) +
                 "&video=" + job["video"].dump())
            .body;
    EXPECT_TRUE(last == noise().substr(noise().size() - std::size_t{4} * kSide * kSide));
}

// Wherever the kill meets it, the video is the old one or the new one, and in the end the new.
TEST(VideoSurvival, AnAppendThatWasKilledIsDoneAfterTheNextStartAndOnce) {
    const testing::TemporaryFolder folder;
    const std::string database = folder.file("haarmony.db");
    const std::vector<std::string> quiet{"--log-level", "warn"};
    const std::size_t frame_bytes = std::size_t{4} * kSide * kSide;
    const std::string all = noise();
    std::string address;
    std::string old_revision;
    {
        Daemon daemon(database, quiet);
        auto curl = daemon.client();
        const auto first = curl.post(
            target(), all.substr(0, 3 * frame_bytes), "application/octet-stream");
        ASSERT_EQ(first.status, 202) << first.body;
        ASSERT_EQ(job_once(daemon, first.headers.at("location"), "done")["video"], 1);
        old_revision = json::parse(curl.get("/videos/1").body)["revision"];
        const auto queued = curl.post(
            "/videos/1/frames", all.substr(3 * frame_bytes), "application/octet-stream");
        ASSERT_EQ(queued.status, 202) << queued.body;
        address = queued.headers.at("location");
        EXPECT_EQ(job_once(daemon, address, "running")["state"], "running");
        daemon.kill_hard();
    }
    Daemon daemon(database, quiet);
    auto curl = daemon.client();
    const json job = job_once(daemon, address, "done");
    ASSERT_EQ(job["state"], "done") << job;
    EXPECT_EQ(job["video"], 1);
    const json video = json::parse(curl.get("/videos/1").body);
    EXPECT_EQ(video["frames"], kFrames);
    EXPECT_NE(video["revision"], old_revision);
    EXPECT_EQ(
        files_beside(database),
        std::set<std::string>{"1-" + video["revision"].get<std::string>() + ".mrv"});
    for (const int t : {0, 2, 3, kFrames - 1}) {
        const std::string shown =
            curl.get("/video/frame?format=rgba&video=1&frame=" + std::to_string(t)).body;
        EXPECT_TRUE(shown ==
                    all.substr(static_cast<std::size_t>(t) * frame_bytes, frame_bytes))
            << t;
    }
}

TEST(VideoSurvival, AVideoThatWasConfirmedOutlivesAKillAndADeletedOneDoesNot) {
    const testing::TemporaryFolder folder;
    const std::string database = folder.file("haarmony.db");
    const std::string pixel("\x01\x02\x03\xFF", 4);
    {
        Daemon daemon(database, {});
        auto curl = daemon.client();
        for (int i = 0; i < 2; ++i) {
            const auto queued =
                curl.post("/videos?width=1&height=1", pixel, "application/octet-stream");
            ASSERT_EQ(queued.status, 202) << queued.body;
            const json job = job_once(daemon, queued.headers.at("location"), "done");
            ASSERT_EQ(job["state"], "done") << job;
        }
        EXPECT_EQ(curl.request("DELETE", "/videos/1").status, 204);
        daemon.kill_hard();
    }
    Daemon daemon(database, {});
    auto curl = daemon.client();
    EXPECT_EQ(curl.get("/videos/1").status, 404);
    EXPECT_EQ(curl.get("/video/frame?video=2&frame=0&format=rgba").body, pixel);
    EXPECT_EQ(files_beside(database).size(), 1U);
    EXPECT_EQ(daemon.stop().exit_code, 0);
}

}  // namespace
}  // namespace haarmony::e2e
