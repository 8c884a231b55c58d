// What must not be lost: kills, restarts, deletions, changes beside a running daemon.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "tests/e2e/collection.h"

namespace haarmony::e2e {
namespace {

using nlohmann::json;

int images(Daemon& daemon) {
    auto curl = daemon.client();
    return json::parse(curl.get("/status").body)["images"];
}

// For daemons that are asked again and again: nobody reads their log meanwhile, and a pipe holds
// 64 KB.
const std::vector<std::string> kQuiet{"--log-level", "warn"};

// Polls until `holds`, for half a minute at most.
bool eventually(const std::function<bool()>& holds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds{30};
    while (!holds()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::yield();
    }
    return true;
}

int first_id(Daemon& daemon, int number) {
    auto curl = daemon.client();
    const auto reply =
        curl.post("/query?limit=1", to_jpeg(picture(number)), "image/jpeg");
    return json::parse(reply.body)["matches"][0]["id"];
}

TEST(Survival, RunningDaemonSeesWhatTheWorkerWritesBesideIt) {
    const testing::TemporaryFolder folder;
    const std::string database = folder.file("haarmony.db");
    Daemon daemon(database, kQuiet);
    EXPECT_EQ(images(daemon), 0);
    write_pictures(folder.file("pictures"), 12);
    ASSERT_EQ(ingest(database, {folder.file("pictures")}).exit_code, 0);
    EXPECT_TRUE(eventually([&] { return images(daemon) == 12; }));
    std::filesystem::remove(folder.file("pictures") + "/" + picture_name(3));
    ASSERT_EQ(ingest(database, {"--prune", folder.file("pictures")}).exit_code, 0);
    EXPECT_TRUE(eventually([&] { return images(daemon) == 11; }));
}

TEST(Survival, KilledDaemonComesBackWithEverythingItConfirmed) {
    const testing::TemporaryFolder folder;
    const std::string database = folder.file("haarmony.db");
    json before;
    {
        Daemon daemon(database, {});
        auto curl = daemon.client();
        for (int number = 0; number < 10; ++number) {
            const auto reply =
                curl.post("/images", to_jpeg(picture(number)), "image/jpeg");
            ASSERT_EQ(reply.status, 201) << reply.body;
        }
        before = json::parse(curl.get("/query?id=1&limit=10").body)["matches"];
        daemon.kill_hard();
    }
    Daemon daemon(database, {});
    auto curl = daemon.client();
    EXPECT_EQ(images(daemon), 10);
    EXPECT_EQ(json::parse(curl.get("/query?id=1&limit=10").body)["matches"], before);
    EXPECT_EQ(daemon.stop().exit_code, 0);
}

TEST(Survival, RestartBeginsWithTheSnapshotThatTheLastDaemonLeft) {
    const testing::TemporaryFolder folder;
    const std::string database = folder.file("haarmony.db");
    write_pictures(folder.file("pictures"), 12);
    ASSERT_EQ(ingest(database, {folder.file("pictures")}).exit_code, 0);
    using Found = std::pair<int, double>;
    const auto found = [](Daemon& daemon) {
        auto curl = daemon.client();
        std::vector<Found> matches;
        const json answer = json::parse(curl.get("/query?id=1&limit=20").body);
        for (const json& match : answer["matches"])
            matches.emplace_back(match["id"], match["distance"]);
        return matches;
    };
    std::vector<Found> before;
    {
        Daemon daemon(database, {});
        auto curl = daemon.client();
        EXPECT_EQ(json::parse(curl.get("/status").body)["began_with_snapshot"], 0);
        EXPECT_EQ(curl.request("DELETE", "/images/3").status, 204);
        before = found(daemon);
        EXPECT_EQ(before.size(), 11U);
        EXPECT_EQ(daemon.stop().exit_code, 0);
    }
    EXPECT_TRUE(std::filesystem::exists(database + ".snapshot"));
    EXPECT_FALSE(std::filesystem::exists(database + ".snapshot.partial"));
    // Beside what a file knows there is what came since.
    write_file(folder.file("pictures") + "/new.jpg", to_jpeg(picture(90)));
    ASSERT_EQ(ingest(database, {folder.file("pictures")}).exit_code, 0);
    Daemon daemon(database, {});
    auto curl = daemon.client();
    const json status = json::parse(curl.get("/status").body);
    EXPECT_EQ(status["began_with_snapshot"], 1);
    EXPECT_EQ(status["searchable"], 12);
    EXPECT_GT(status["sequence"], status["snapshot_sequence"]);
    std::vector<Found> after = found(daemon);
    EXPECT_EQ(std::erase_if(after, [](const Found& match) { return match.first == 13; }),
              1U);
    EXPECT_EQ(after, before);
    const auto finished = daemon.stop();
    EXPECT_NE(finished.err.find("event=snapshot_loaded images=11"), std::string::npos)
        << finished.err;
}

TEST(Survival, DaemonThatIsKilledWhileItWritesASnapshotStartsAgain) {
    const testing::TemporaryFolder folder;
    const std::string database = folder.file("haarmony.db");
    const std::string snapshot = database + ".snapshot";
    write_pictures(folder.file("pictures"), 12);
    ASSERT_EQ(ingest(database, {folder.file("pictures")}).exit_code, 0);
    const auto serves_all = [](Daemon& daemon) {
        auto curl = daemon.client();
        return json::parse(curl.get("/query?id=1&limit=20").body)["matches"].size() == 12;
    };
    // Once or twice it may be faster than the test.
    constexpr int kMostRounds = 50;
    int killed_while_writing = 0;
    for (int round = 0; killed_while_writing < 3; ++round) {
        ASSERT_LT(round, kMostRounds);
        // What is under the final name is whole, or is ignored; so with the other one.
        if (killed_while_writing == 1) write_file(snapshot + ".partial", "half a file");
        if (killed_while_writing == 2) write_file(snapshot, "half a file");
        Daemon daemon(database, kQuiet);
        ASSERT_TRUE(serves_all(daemon)) << round;
        std::filesystem::remove(snapshot + ".partial");
        auto curl = daemon.client();
        ASSERT_EQ(curl.post("/jobs", R"({"type":"snapshot"})", "application/json").status,
                  202);
        ASSERT_TRUE(eventually([&] {
            return std::filesystem::exists(snapshot + ".partial") ||
                   json::parse(curl.get("/jobs").body)["items"][0]["state"] == "done";
        }));
        daemon.kill_hard();
        killed_while_writing += std::filesystem::exists(snapshot + ".partial") ? 1 : 0;
    }
    Daemon daemon(database, kQuiet);
    auto curl = daemon.client();
    EXPECT_TRUE(serves_all(daemon));
    ASSERT_EQ(curl.post("/jobs", R"({"type":"snapshot"})", "application/json").status,
              202);
    EXPECT_TRUE(eventually([&] {
        return json::parse(curl.get("/jobs").body)["items"][0]["state"] == "done";
    }));
    EXPECT_EQ(daemon.stop().exit_code, 0);
    EXPECT_FALSE(std::filesystem::exists(snapshot + ".partial"));
    Daemon last(database, {});
    EXPECT_EQ(json::parse(last.client().get("/status").body)["began_with_snapshot"], 1);
}

TEST(Survival, KilledIngestResumesBesideAKilledDaemon) {
    const testing::TemporaryFolder folder;
    const std::string database = folder.file("haarmony.db");
    const std::string pictures = folder.file("pictures");
    constexpr int kPictures = 80;
    write_pictures(pictures, kPictures);
    {
        Daemon daemon(database, kQuiet);
        testing::Process worker({program("haarmony-ingest"),
                                 "--db",
                                 database,
                                 "--jobs",
                                 "1",
                                 "--progress",
                                 "none",
                                 pictures});
        ASSERT_TRUE(eventually([&] { return images(daemon) > 0; }));
        worker.signal(SIGKILL);
        daemon.kill_hard();
        (void)worker.wait(std::chrono::seconds{30});
    }
    Daemon daemon(database, kQuiet);
    const int survived = images(daemon);
    EXPECT_GT(survived, 0);
    const auto second = ingest(database, {pictures});
    EXPECT_EQ(second.exit_code, 0) << second.err;
    EXPECT_TRUE(eventually([&] { return images(daemon) == kPictures; }));
    EXPECT_NE(second.out.find("skipped=" + std::to_string(survived)), std::string::npos)
        << second.out;
}

TEST(Survival, DeletedPictureStaysDeletedUntilItsFileChanges) {
    const testing::TemporaryFolder folder;
    const std::string database = folder.file("haarmony.db");
    const std::string pictures = folder.file("pictures");
    write_pictures(pictures, 8);
    ASSERT_EQ(ingest(database, {pictures}).exit_code, 0);
    Daemon daemon(database, kQuiet);
    auto curl = daemon.client();
    const int id = first_id(daemon, 4);
    const std::string address = "/images/" + std::to_string(id);
    EXPECT_EQ(curl.request("DELETE", address).status, 204);
    EXPECT_EQ(curl.get(address).status, 404);
    EXPECT_EQ(curl.request("DELETE", address).status, 404);
    EXPECT_NE(first_id(daemon, 4), id);
    EXPECT_EQ(images(daemon), 7);

    ASSERT_EQ(ingest(database, {pictures}).exit_code, 0);
    EXPECT_EQ(curl.get(address).status, 404);

    write_file(pictures + "/" + picture_name(4), to_jpeg(picture(100)));
    ASSERT_EQ(ingest(database, {pictures}).exit_code, 0);
    EXPECT_TRUE(eventually([&] { return curl.get(address).status == 200; }));
    EXPECT_TRUE(eventually([&] { return first_id(daemon, 100) == id; }));
}

TEST(Survival, DamagedFileIsReportedAndTheRestIsServed) {
    const testing::TemporaryFolder folder;
    const std::string database = folder.file("haarmony.db");
    const std::string pictures = folder.file("pictures");
    write_pictures(pictures, 3);
    const std::string whole = to_jpeg(picture(0));
    write_file(pictures + "/broken.jpg", whole.substr(0, whole.size() / 2));
    const auto finished = ingest(database, {pictures});
    EXPECT_EQ(finished.exit_code, 1);
    EXPECT_NE(finished.err.find("failed: " + pictures + "/broken.jpg: "),
              std::string::npos)
        << finished.err;
    EXPECT_NE(
        finished.out.find("done: seen=4 added=3 updated=0 skipped=0 failed=1 pruned=0"),
        std::string::npos)
        << finished.out;
    Daemon daemon(database, {});
    EXPECT_EQ(images(daemon), 3);
}

TEST(Survival, ForeignFileIsRefusedAndLeftAlone) {
    const testing::TemporaryFolder folder;
    const std::string foreign = folder.file("notes.txt");
    write_file(foreign, "not a database\n");
    write_pictures(folder.file("pictures"), 1);
    EXPECT_EQ(ingest(foreign, {folder.file("pictures")}).exit_code, 3);
    const auto daemon =
        testing::run({program("haarmonyd"), "--db", foreign, "--listen", "127.0.0.1:0"});
    EXPECT_EQ(daemon.exit_code, 3);
    EXPECT_NE(daemon.err.find("notes.txt"), std::string::npos) << daemon.err;
    EXPECT_EQ(std::filesystem::file_size(foreign), 15U);
    EXPECT_FALSE(std::filesystem::exists(foreign + "-wal"));
}

}  // namespace
}  // namespace haarmony::e2e
