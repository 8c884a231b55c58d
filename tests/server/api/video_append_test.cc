// POST /videos/{id}/frames: the video is what all its frames at once make, at every address.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "tests/engine/video/plain_clip.h"
#include "tests/server/api/interface.h"
#include "tests/server/app/job_watch.h"

namespace haarmony::server {
namespace {

using nlohmann::json;
using video::Edge;
using video::testing::random_clip;
using video::testing::RawClip;

const std::string kBytes = "application/octet-stream";

std::string bytes_of(const video::Picture& picture) {
    return {reinterpret_cast<const char*>(picture.pixels.data()),
            4 * picture.pixels.size()};
}

// Frames [first, end) of a clip.
std::string bytes_of(const RawClip& clip, std::size_t first, std::size_t end) {
    std::string bytes;
    for (std::size_t t = first; t < end; ++t) bytes += bytes_of(clip.frames[t]);
    return bytes;
}

class VideoAppendTest : public testing::Test {
  protected:
    schema::Job ended(const http::Response& queued) {
        EXPECT_EQ(queued.status, 202) << body_of(queued);
        if (queued.status != 202) return {};
        return finished(*interface_.jobs, json_of(queued)["id"].get<std::int64_t>());
    }
    std::int64_t made(const http::Response& queued) {
        const schema::Job job = ended(queued);
        EXPECT_EQ(job.state, schema::JobState::kDone)
            << (job.errors.empty() ? "" : job.errors.front());
        return json_of(interface_.get("/jobs/" + std::to_string(job.id)))
            .value("video", std::int64_t{0});
    }
    std::int64_t upload(const RawClip& clip,
                        std::size_t frames,
                        const std::string& options = "") {
        return made(interface_.post("/videos?width=" + std::to_string(clip.format.width) +
                                        "&height=" + std::to_string(clip.format.height) +
                                        options,
                                    kBytes,
                                    bytes_of(clip, 0, frames)));
    }
    http::Response append(std::int64_t id,
                          const std::string& bytes,
                          const std::string& options = "") {
        return interface_.post(
            "/videos/" + std::to_string(id) + "/frames" + options, kBytes, bytes);
    }
    http::Response frame(std::int64_t id, const std::string& place) {
        return interface_.get("/video/frame?format=rgba&video=" + std::to_string(id) +
                              "&" + place);
    }
    json video(std::int64_t id) {
        return json_of(interface_.get("/videos/" + std::to_string(id)));
    }
    void expect_exact(const RawClip& clip, std::int64_t id) {
        const video::ClipShape shape = shape_of(clip);
        ASSERT_EQ(video(id)["frames"], shape.frames());
        for (int k = 0; k <= shape.time_levels(); ++k)
            for (std::int64_t i = 0; i < shape.nodes_at(k); ++i)
                for (int l = 0; l <= shape.space_levels(); ++l) {
                    const std::string place = "time_level=" + std::to_string(k) +
                                              "&index=" + std::to_string(i) +
                                              "&level=" + std::to_string(l);
                    ASSERT_EQ(body_of(frame(id, place)),
                              bytes_of(exact_picture(clip, {k, i}, l, Edge::kNormalize)))
                        << place;
                }
    }
    std::set<std::string> files() {
        std::set<std::string> names;
        for (const auto& entry :
             std::filesystem::directory_iterator(interface_.videos->files().folder()))
            names.insert(entry.path().filename());
        return names;
    }

    Interface interface_;
};

TEST_F(VideoAppendTest, EveryPictureIsThatOfAllFramesAtOnce) {
    const RawClip clip = random_clip(13, 9, 8, 1);
    const std::int64_t id = upload(clip, 3, "&name=a&rate=10");
    const json before = video(id);
    EXPECT_EQ(made(append(id, bytes_of(clip, 3, 5))), id);
    EXPECT_EQ(made(append(id, bytes_of(clip, 5, 8), "?width=13&height=9&rate=10")), id);
    expect_exact(clip, id);
    const json after = video(id);
    EXPECT_EQ(after["name"], "a");
    EXPECT_EQ(after["rate"], 10.0);
    EXPECT_EQ(after["created_at"], before["created_at"]);
    EXPECT_NE(after["revision"], before["revision"]);
    // The dissertation's counts are those of the frames, however they came.
    const json at_once = video(upload(clip, 8))["storage"];
    for (const char* count : {"time_nodes",
                              "complete_subtrees",
                              "pruned_subtrees",
                              "own_subtrees",
                              "uplinks",
                              "paper_bytes",
                              "raw_bytes"})
        EXPECT_EQ(after["storage"][count], at_once[count]) << count;
    const http::Response file =
        interface_.get("/videos/" + std::to_string(id) + "/export");
    EXPECT_EQ(after["storage"]["disk_bytes"],
              std::get<http::FileRange>(file.body).length);
}

TEST_F(VideoAppendTest, AnOldRevisionsAddressesShowNothingElse) {
    const RawClip clip = random_clip(6, 6, 3, 2);
    const std::int64_t id = upload(clip, 2);
    const std::string old_rev = "&rev=" + video(id)["revision"].get<std::string>();
    const http::Response before = frame(id, "time_level=0&index=0" + old_rev);
    EXPECT_EQ(before.status, 200);
    const std::string tag = header_of(frame(id, "frame=1"), "ETag");
    made(append(id, bytes_of(clip, 2, 3)));
    EXPECT_EQ(refusal_of(frame(id, "time_level=0&index=0" + old_rev)),
              (Refusal{404, "not_found", "rev"}));
    EXPECT_EQ(refusal_of(frame(id, "frame=1" + old_rev)),
              (Refusal{404, "not_found", "rev"}));
    EXPECT_NE(header_of(frame(id, "frame=1"), "ETag"), tag);
    EXPECT_NE(body_of(frame(id, "time_level=0&index=0")), body_of(before));
    EXPECT_EQ(
        frame(id, "time_level=0&index=0&rev=" + video(id)["revision"].get<std::string>())
            .status,
        200);
}

TEST_F(VideoAppendTest, OneFileIsLeftAndWhoLooksAtTheOldClipKeepsIt) {
    const RawClip clip = random_clip(6, 6, 4, 3);
    const std::int64_t id = upload(clip, 2);
    const auto held = interface_.videos->clip(id);
    ASSERT_TRUE(held);
    made(append(id, bytes_of(clip, 2, 4)));
    EXPECT_EQ(files(),
              std::set<std::string>{std::to_string(id) + "-" +
                                    video(id)["revision"].get<std::string>() + ".mrv"});
    EXPECT_EQ((*held)->clip().shape().frames(), 2);
    EXPECT_TRUE((*held)->clip().frame({1, 1}, 3).has_value());
}

TEST_F(VideoAppendTest, AFileALeafListAndAGeneratorCanFollow) {
    const RawClip clip = random_clip(16, 16, 4, 4);
    const std::int64_t id = upload(clip, 2);
    const std::int64_t other =
        made(interface_.post("/videos?width=16&height=16", kBytes, bytes_of(clip, 2, 4)));
    const http::Response file =
        interface_.get("/videos/" + std::to_string(other) + "/export");
    const std::string mrv = schema::read_bytes(std::get<http::FileRange>(file.body).path);
    EXPECT_EQ(made(append(id, mrv, "?max_frames=1")), id);
    const json leaves{
        {"frames", {{{"leaves", {{1, 0, 0, 10, 20, 30, 255}}}, {"repeats", 2}}}}};
    const std::string address = "/videos/" + std::to_string(id) + "/frames";
    EXPECT_EQ(made(interface_.post_json(address, leaves)), id);
    RawClip want = clip;
    want.frames.resize(5, video::Picture(16, 16));
    want.frames[3] = video::Picture(16, 16);
    for (std::size_t t : {3, 4})
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x) want.frames[t].at(x, y) = {10, 20, 30, 255};
    expect_exact(want, id);
    EXPECT_EQ(made(interface_.post_json(address, {{"generate", "julia"}, {"frames", 2}})),
              id);
    EXPECT_EQ(video(id)["frames"], 7);
}

TEST_F(VideoAppendTest, WhatCannotFollowIsRefusedBeforeThereIsAJob) {
    const RawClip clip = random_clip(8, 6, 2, 5);
    const std::int64_t id = upload(clip, 2, "&rate=10");
    const std::string frame_bytes = bytes_of(clip, 0, 1);
    const std::size_t jobs = json_of(interface_.get("/jobs"))["items"].size();
    const auto refused = [&](const std::string& options) {
        return refusal_of(append(id, frame_bytes, options));
    };
    EXPECT_EQ(refused("?width=6&height=8"), (Refusal{422, "other_format", "width"}));
    EXPECT_EQ(refused("?width=8&height=3"), (Refusal{422, "other_format", "height"}));
    EXPECT_EQ(refused("?rate=25"), (Refusal{422, "other_format", "rate"}));
    EXPECT_NE(body_of(append(id, frame_bytes, "?rate=25")).find("25/1, of the clip 10/1"),
              std::string::npos);
    EXPECT_EQ(refused("?name=b"), (Refusal{400, "invalid_argument", "name"}));
    EXPECT_EQ(refused("?delta=1"), (Refusal{400, "invalid_argument", "delta"}));
    EXPECT_EQ(refused("?index=true"), (Refusal{400, "invalid_argument", "index"}));
    EXPECT_EQ(refusal_of(append(id, frame_bytes + "x")),
              (Refusal{422, "not_whole_frames", "width"}));
    EXPECT_EQ(refusal_of(append(99, frame_bytes)), (Refusal{404, "not_found", "video"}));
    EXPECT_EQ(refusal_of(interface_.post("/videos/x/frames", kBytes, frame_bytes)).status,
              400);
    EXPECT_EQ(
        refusal_of(interface_.post("/videos/1/frames", "text/plain", "hello")).status,
        415);
    const std::string address = "/videos/" + std::to_string(id) + "/frames";
    EXPECT_EQ(refusal_of(interface_.post_json(address, json::object())),
              (Refusal{400, "no_source", "frames"}));
    EXPECT_EQ(refusal_of(interface_.post_json(
                  address, {{"generate", "julia"}, {"frames", 1}, {"width", 16}})),
              (Refusal{422, "other_format", "width"}));
    EXPECT_EQ(json_of(interface_.get("/jobs"))["items"].size(), jobs);
    // A clip of another size, and one with loss.
    const RawClip square = random_clip(4, 4, 1, 6);
    const std::int64_t other = upload(square, 1, "&delta=3");
    const http::Response file =
        interface_.get("/videos/" + std::to_string(other) + "/export");
    EXPECT_EQ(refusal_of(append(
                  id, schema::read_bytes(std::get<http::FileRange>(file.body).path))),
              (Refusal{422, "other_format", "width"}));
    EXPECT_EQ(refusal_of(append(other, bytes_of(square, 0, 1))),
              (Refusal{409, "conflict", "delta"}));
    EXPECT_EQ(video(id)["frames"], 2);
}

TEST_F(VideoAppendTest, AVideoThatIsGoneWhenItsJobRunsFailsTheJob) {
    const RawClip clip = random_clip(4, 4, 2, 7);
    const std::int64_t id = upload(clip, 1);
    const schema::Job job = done(*interface_.jobs,
                                 "video",
                                 R"({"origin":"generated","name":"","delta":0,)"
                                 R"("max_frames":0,"index":false,"append_to":99,)"
                                 R"("generate":"julia","parameters":{"width":16,)"
                                 R"("height":16,"frames":1,"rate":[25,1],"seed":1}})");
    EXPECT_EQ(job.state, schema::JobState::kFailed);
    ASSERT_FALSE(job.errors.empty());
    EXPECT_NE(job.errors.front().find("no video 99"), std::string::npos);
    EXPECT_EQ(files().size(), 1U);
    EXPECT_EQ(video(id)["frames"], 1);
}

TEST_F(VideoAppendTest, ADamagedFileFailsTheJobAndLeavesTheVideo) {
    const RawClip clip = random_clip(8, 8, 3, 8);
    const std::int64_t id = upload(clip, 2);
    const json before = video(id);
    const http::Response file =
        interface_.get("/videos/" + std::to_string(id) + "/export");
    std::string damaged = schema::read_bytes(std::get<http::FileRange>(file.body).path);
    damaged.back() = static_cast<char>(~damaged.back());
    const schema::Job job = ended(append(id, damaged));
    EXPECT_EQ(job.state, schema::JobState::kFailed);
    EXPECT_EQ(video(id), before);
    EXPECT_EQ(files().size(), 1U);
}

TEST_F(VideoAppendTest, ASearchFindsOldAndNewFramesWhereTheyAreNow) {
    RawClip clip = random_clip(32, 32, 5, 9);
    const std::int64_t id = upload(clip, 2, "&index=true");
    const auto found = [&](std::size_t frame) {
        const http::Response response = interface_.post(
            "/query?kind=frame&limit=1",
            "image/png",
            body_of(interface_.get("/video/frame?format=png&video=" + std::to_string(id) +
                                   "&frame=" + std::to_string(frame))));
        const json match = json_of(response)["matches"][0];
        EXPECT_EQ(match["distance"], 0.0);
        return match["frame"];
    };
    EXPECT_EQ(found(1)["time_level"], 1);
    made(append(id, bytes_of(clip, 2, 5)));
    for (std::size_t t = 0; t < 4; ++t) {
        EXPECT_EQ(found(t)["time_level"], 3);
        EXPECT_EQ(found(t)["index"], t);
    }
    // The only frame of its half of the clip is that half.
    EXPECT_EQ(found(4)["time_level"], 1);
    EXPECT_DOUBLE_EQ(found(4)["time"].get<double>(), 4 / 25.0);
    const std::int64_t at_once = upload(clip, 5, "&index=true");
    const auto frames = beside(interface_.collection)->videos().frames_after(0, 1'000);
    ASSERT_TRUE(frames.has_value());
    const auto rows = [&](std::int64_t video_id) {
        return std::count_if(frames->begin(), frames->end(), [&](const auto& row) {
            return row.video == video_id;
        });
    };
    EXPECT_EQ(rows(id), rows(at_once));
}

}  // namespace
}  // namespace haarmony::server
