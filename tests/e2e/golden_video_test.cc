// The golden clips of the environment variable HAARMONY_GOLDEN_VIDEO, a folder, through the
// real daemon: every picture's hash, the storage counts, composites, translations, scalings
// and fractional zooms. Prints what passed of how many, for each of its files.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "ingest/describe.h"
#include "tests/e2e/collection.h"

namespace haarmony::e2e {
namespace {

using nlohmann::json;

std::string read_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string hash_of(const std::string& bytes) {
    return ingest::content_hash(
        {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

std::vector<std::string> split(const std::string& text, char at) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, at);) parts.push_back(part);
    return parts;
}

// The number of "dx=5".
int number_of(const std::string& text) {
    return std::stoi(text.substr(text.find('=') + 1));
}

// "A_over_B" -> "a_over_b"; "A_xor_B" is "xor".
std::string operator_of(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(c));
    return text == "a_xor_b" ? "xor" : text;
}

struct Tally {
    int passed = 0;
    int total = 0;
    std::string first_failure;

    void count(bool good, const std::string& name) {
        ++total;
        passed += good ? 1 : 0;
        if (!good && first_failure.empty()) first_failure = name;
    }
};

class GoldenVideo : public ::testing::Test {
  protected:
    void SetUp() override {
        const char* folder = std::getenv("HAARMONY_GOLDEN_VIDEO");
        if (folder == nullptr)
            GTEST_SKIP() << "HAARMONY_GOLDEN_VIDEO does not name a folder";
        golden_ = folder;
        daemon_ =
            std::make_unique<Daemon>(database_.file("haarmony.db"),
                                     std::vector<std::string>{"--log-level", "warn"});
        curl_ = std::make_unique<testing::CurlClient>(daemon_->url());
        summary_ = expected("summary");
        for (const auto& [name, shape] : summary_.items())
            clips_[name] = made(
                "/videos?width=" + shape["W"].dump() + "&height=" + shape["H"].dump(),
                read_file(golden_ + "/clips/" + name + ".rgba"),
                "application/octet-stream");
    }
    void TearDown() override {
        if (golden_.empty()) return;
        for (const auto& [file, tally] : tallies_) {
            std::cout << file << ": " << tally.passed << " of " << tally.total << '\n';
            EXPECT_EQ(tally.passed, tally.total) << file << ": " << tally.first_failure;
            EXPECT_GT(tally.total, 0) << file;
        }
    }

    [[nodiscard]] json expected(const std::string& name) const {
        return json::parse(read_file(golden_ + "/expected/" + name + ".json"));
    }
    // The video that the job of this request makes; 0 where it fails.
    int made(const std::string& target,
             const std::string& body,
             const std::string& type) {
        const testing::Reply queued = curl_->post(target, body, type);
        EXPECT_EQ(queued.status, 202) << queued.body;
        if (queued.status != 202) return 0;
        const std::string address = queued.headers.at("location");
        for (;;) {
            const json job = json::parse(curl_->get(address).body);
            if (job["state"] == "done") return job["video"];
            if (job["state"] != "queued" && job["state"] != "running") {
                ADD_FAILURE() << job;
                return 0;
            }
            std::this_thread::yield();
        }
    }
    int composed(const json& request) {
        return made("/videos/compose", request.dump(), "application/json");
    }
    void check_frames(Tally& tally,
                      const std::string& name,
                      int video,
                      const json& frames) {
        for (const auto& [place, hashes] : frames.items()) {
            const auto at = split(place, '/');
            for (const int edge : {0, 1}) {
                const testing::Reply shown = curl_->get(
                    "/video/frame?format=rgba&video=" + std::to_string(video) +
                    "&time_level=" + at[0] + "&index=" + at[1] + "&level=" + at[2] +
                    (edge == 0 ? "&edge=pad" : "&edge=normalize"));
                tally.count(shown.status == 200 && hash_of(shown.body) == hashes[edge],
                            name + " " + place);
            }
        }
    }

    std::string golden_;
    testing::TemporaryFolder database_;
    std::unique_ptr<Daemon> daemon_;
    std::unique_ptr<testing::CurlClient> curl_;
    json summary_;
    std::map<std::string, int> clips_;
    std::map<std::string, Tally> tallies_;
};

TEST_F(GoldenVideo, EveryPictureAndEveryStorageCountOfTheClips) {
    for (const auto& [name, shape] : summary_.items()) {
        Tally& tally = tallies_[name + ".json"];
        const json want = expected(name);
        check_frames(tally, name, clips_[name], want["frames"]);
        const json video =
            json::parse(curl_->get("/videos/" + std::to_string(clips_[name])).body);
        const json& storage = video["storage"];
        const std::pair<const char*, const char*> counts[] = {
            {"complete_subtrees", "complete_subtrees"},
            {"pruned_subtrees", "pruned_subtrees"},
            {"own_subtrees", "uplinked_own_subtrees"},
            {"uplinks", "uplinks"},
            {"paper_bytes", "own_bytes"},
            {"raw_bytes", "raw_rgba_bytes"}};
        for (const auto& [ours, theirs] : counts)
            tally.count(storage[ours] == want["storage"][theirs],
                        name + " storage " + ours + " " + storage[ours].dump());
        tally.count(
            video["time_levels"] == shape["T"] && video["space_levels"] == shape["L"],
            name + " levels");
    }
}

TEST_F(GoldenVideo, AdaptiveLeavesAreTheSameClip) {
    json frames = json::array();
    const json leaves = json::parse(read_file(golden_ + "/clips/julia_leaves.json"));
    for (const json& frame : leaves.is_object() ? leaves["frames"] : leaves)
        frames.push_back({{"leaves", frame.is_object() ? frame["leaves"] : frame}});
    const int video =
        made("/videos", json{{"frames", frames}}.dump(), "application/json");
    check_frames(tallies_["julia_leaves.json"],
                 "julia_leaves",
                 video,
                 expected("julia")["frames"]);
}

TEST_F(GoldenVideo, CompositesWithAllOperatorsAndTheirPreviews) {
    const json composite = expected("composite");
    for (const auto& [name, want] : composite.items()) {
        const auto words = split(name, ' ');
        const json layers{{{"video", clips_[words[2]]}},
                          {{"video", clips_[words[0]]}, {"op", operator_of(words[1])}}};
        check_frames(tallies_["composite.json"],
                     name,
                     composed({{"layers", layers}}),
                     want["frames"]);
        for (const auto& [place, hash] : want["preview_full_res"].items()) {
            const auto at = split(place, '/');
            const json request{{"layers", layers},
                               {"format", "rgba"},
                               {"preview",
                                {{"time_level", std::stoi(at[0])},
                                 {"index", std::stoi(at[1])},
                                 {"level", std::stoi(at[2])}}}};
            const testing::Reply shown =
                curl_->post("/videos/compose", request.dump(), "application/json");
            tallies_["composite.json, previews"].count(
                shown.status == 200 && hash_of(shown.body) == hash, name + " " + place);
        }
    }
}

TEST_F(GoldenVideo, TranslationsAndScalings) {
    const json translate = expected("translate");
    for (const auto& [name, want] : translate.items()) {
        const auto words = split(name, ' ');
        const json layer{{"video", clips_[words[0]]},
                         {"translate", {number_of(words[1]), number_of(words[2])}},
                         {"at_level", number_of(words[3])}};
        check_frames(tallies_["translate.json"],
                     name,
                     composed({{"layers", {layer}}}),
                     want.contains("frames") ? want["frames"] : want);
    }
    const json scale = expected("scale");
    for (const auto& [name, want] : scale.items()) {
        const auto words = split(name, ' ');
        const json layer{{"video", clips_[words[0]]},
                         {"scale", {number_of(words[1]), number_of(words[2])}}};
        check_frames(
            tallies_["scale.json"],
            name,
            composed({{"layers", {layer}}, {"width", want["W"]}, {"height", want["H"]}}),
            want["frames"]);
    }
}

// The golden pictures are of the whole root square, which a clip shows that is one.
TEST_F(GoldenVideo, FractionalZooms) {
    const json fzoom = expected("fzoom");
    for (const auto& [name, hash] : fzoom.items()) {
        const auto words = split(name, ' ');
        const json& shape = summary_[words[0]];
        const int side = number_of(words[3]);
        const int square = 1 << shape["L"].get<int>();
        std::ostringstream level;
        level.precision(17);
        level << std::log2(side);
        const std::string size =
            side <= square ? "&level=" + level.str() : "&width=" + std::to_string(side);
        // A clip that is smaller would show a part of it.
        ASSERT_TRUE(shape["W"] == square && shape["H"] == square) << name;
        const testing::Reply shown =
            curl_->get("/video/frame?format=rgba&edge=pad&video=" +
                       std::to_string(clips_[words[0]]) +
                       "&time_level=" + std::to_string(number_of(words[1])) +
                       "&index=" + std::to_string(number_of(words[2])) + size);
        tallies_["fzoom.json"].count(shown.status == 200 && hash_of(shown.body) == hash,
                                     name);
    }
}

}  // namespace
}  // namespace haarmony::e2e
