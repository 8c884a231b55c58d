// /videos/compose, and what else is made of stored videos: exports, thumbnails, timelines,
// panoramas, playback.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/video/ops/composite.h"
#include "tests/engine/video/plain_clip.h"
#include "tests/server/api/interface.h"
#include "tests/server/app/job_watch.h"

namespace haarmony::server {
namespace {

using nlohmann::json;
using video::testing::random_clip;
using video::testing::RawClip;

std::string bytes_of(const video::Picture& picture) {
    return {reinterpret_cast<const char*>(picture.pixels.data()),
            4 * picture.pixels.size()};
}

class VideoComposeTest : public testing::Test {
  protected:
    std::int64_t made(const http::Response& queued) {
        EXPECT_EQ(queued.status, 202) << body_of(queued);
        if (queued.status != 202) return 0;
        const auto id = json_of(queued)["id"].get<std::int64_t>();
        const schema::Job ended = finished(*interface_.jobs, id);
        EXPECT_EQ(ended.state, schema::JobState::kDone)
            << (ended.errors.empty() ? "" : ended.errors.front());
        return json_of(interface_.get("/jobs/" + std::to_string(id)))
            .value("video", std::int64_t{0});
    }
    std::int64_t upload(const RawClip& clip) {
        std::string bytes;
        for (const video::Picture& frame : clip.frames) bytes += bytes_of(frame);
        return made(interface_.post("/videos?width=" + std::to_string(clip.format.width) +
                                        "&height=" + std::to_string(clip.format.height),
                                    "application/octet-stream",
                                    bytes));
    }
    std::int64_t compose(const json& request) {
        return made(interface_.post_json("/videos/compose", request));
    }
    std::string pixels(std::int64_t video, const std::string& place) {
        return body_of(interface_.get(
            "/video/frame?format=rgba&video=" + std::to_string(video) + "&" + place));
    }
    Refusal refused(const json& request) {
        return refusal_of(interface_.post_json("/videos/compose", request));
    }

    Interface interface_;
};

TEST_F(VideoComposeTest, EveryOperatorIsThePixelsOfTheSingleFrames) {
    const RawClip a = random_clip(8, 8, 2, 1);
    const RawClip b = random_clip(8, 8, 2, 2);
    const std::int64_t top = upload(a);
    const std::int64_t below = upload(b);
    for (std::size_t op = 0; op < video::kOperatorNames.size(); ++op) {
        const std::string name(video::kOperatorNames[op]);
        const std::int64_t id =
            compose({{"layers", {{{"video", below}}, {{"video", top}, {"op", name}}}}});
        for (std::size_t frame = 0; frame < 2; ++frame) {
            video::Picture want(8, 8);
            for (std::size_t i = 0; i < want.pixels.size(); ++i)
                want.pixels[i] =
                    video::composite(video::canonical(a.frames[frame].pixels[i]),
                                     video::canonical(b.frames[frame].pixels[i]),
                                     static_cast<video::Operator>(op));
            EXPECT_EQ(pixels(id, "frame=" + std::to_string(frame)), bytes_of(want))
                << name;
        }
    }
}

TEST_F(VideoComposeTest, LayersAreMovedScaledAndDelayed) {
    RawClip dot;
    dot.format = {1, 1, {25, 1}};
    dot.frames.assign(2, video::Picture(1, 1));
    dot.frames[0].at(0, 0) = {1, 2, 3, 255};
    dot.frames[1].at(0, 0) = {4, 5, 6, 255};
    const std::int64_t id = compose({{"layers",
                                      {{{"video", upload(dot)},
                                        {"scale", {2, 1}},
                                        {"translate", {1, 3}},
                                        {"start", 1}}}},
                                     {"width", 4},
                                     {"height", 4},
                                     {"rate", 5},
                                     {"name", "moved"}});
    const json shown = json_of(interface_.get("/videos/" + std::to_string(id)));
    EXPECT_EQ(shown["frames"], 3);
    EXPECT_EQ(shown["rate"], 5.0);
    EXPECT_EQ(shown["name"], "moved");
    video::Picture want(4, 4);
    EXPECT_EQ(pixels(id, "frame=0"), bytes_of(want));
    want.at(1, 3) = want.at(2, 3) = {4, 5, 6, 255};
    EXPECT_EQ(pixels(id, "frame=2"), bytes_of(want));
}

TEST_F(VideoComposeTest, AStillPictureStaysToTheEnd) {
    const RawClip clip = random_clip(4, 4, 3, 3);
    video::Picture still(4, 4);
    for (video::Rgba& pixel : still.pixels) pixel = {9, 8, 7, 255};
    const std::string png = text_of(png_of(still.view()));
    const std::int64_t video = upload(clip);
    const auto image =
        json_of(interface_.post("/images", "image/png", png))["id"].get<std::int64_t>();
    const std::int64_t encoded =
        compose({{"layers", {{{"video", video}}, {{"image", base64(png)}}}}});
    const std::int64_t stored =
        compose({{"layers", {{{"video", video}}, {{"image", image}, {"start", 1}}}}});
    for (int frame = 0; frame < 3; ++frame)
        EXPECT_EQ(pixels(encoded, "frame=" + std::to_string(frame)), bytes_of(still));
    EXPECT_EQ(json_of(interface_.get("/videos/" + std::to_string(stored)))["frames"], 3);
    EXPECT_EQ(pixels(stored, "frame=0"), pixels(video, "frame=0"));
    EXPECT_EQ(pixels(stored, "frame=1"), pixels(stored, "frame=2"));
}

TEST_F(VideoComposeTest, APreviewIsAnsweredAtOnceAndMarked) {
    const RawClip clip = random_clip(8, 8, 4, 4);
    const std::int64_t video = upload(clip);
    const json layers = {{{"video", video}}};
    const http::Response shown = interface_.post_json(
        "/videos/compose",
        {{"layers", layers},
         {"format", "rgba"},
         {"preview", {{"time_level", 1}, {"index", 1}, {"level", 3}}}});
    ASSERT_EQ(shown.status, 200) << body_of(shown);
    EXPECT_EQ(header_of(shown, "X-Preview"), "yes");
    EXPECT_EQ(header_of(shown, "X-Frame-Interval"), "2-3");
    EXPECT_EQ(body_of(shown), pixels(video, "time_level=1&index=1"));
    for (const json& outside : {json{{"time_level", 3}},
                                json{{"time_level", 1}, {"index", 2}},
                                json{{"level", 4}},
                                json{{"level", -1}}})
        EXPECT_EQ(refused({{"layers", layers}, {"preview", outside}}).status, 422)
            << outside;
    EXPECT_EQ(refused({{"layers", layers}, {"preview", {{"frame", 1}}}}),
              (Refusal{400, "unknown_parameter", "preview.frame"}));
}

TEST_F(VideoComposeTest, WhatCannotBeComposedIsRefusedBeforeThereIsAJob) {
    const std::int64_t id = upload(random_clip(4, 4, 2, 5));
    const json layer{{"video", id}};
    const auto with = [&](const json& more) {
        json changed = layer;
        changed.update(more);
        return refused({{"layers", {changed}}});
    };
    EXPECT_EQ(refused(json::object()), (Refusal{400, "invalid_argument", "layers"}));
    EXPECT_EQ(refused({{"layers", json::array()}}).status, 422);
    EXPECT_EQ(refused({{"layers", 1}}).status, 400);
    EXPECT_EQ(refused({{"layers", {{{"video", 77}}}}}).status, 404);
    EXPECT_EQ(refused({{"layers", {{{"image", 77}}}}}).status, 404);
    EXPECT_EQ(refused({{"layers", {json::object()}}}).code, "no_source");
    EXPECT_EQ(with({{"image", 1}}).code, "several_sources");
    EXPECT_EQ(with({{"op", "over"}}), (Refusal{400, "invalid_argument", "layers[0].op"}));
    EXPECT_EQ(with({{"scale", {0, 1}}}).status, 422);
    EXPECT_EQ(with({{"scale", {0.3, 1}}}).status, 422);
    EXPECT_EQ(with({{"scale", 2}}).status, 400);
    EXPECT_EQ(with({{"translate", {0.5, 0}}}).status, 422);
    EXPECT_EQ(with({{"translate", {1, 1}}, {"at_level", 9}}).status, 422);
    EXPECT_EQ(with({{"start", -1}}).status, 422);
    EXPECT_EQ(with({{"alpha", 1}}),
              (Refusal{400, "unknown_parameter", "layers[0].alpha"}));
    EXPECT_EQ(refused({{"layers", {layer}}, {"width", 0}}).status, 422);
    EXPECT_EQ(refused({{"layers", {layer}}, {"width", 100'000}}).status, 422);
    EXPECT_EQ(refused({{"layers", {layer}}, {"format", "png"}}).status, 400);
    EXPECT_EQ(json_of(interface_.get("/jobs"))["items"].size(), 1u);
}

TEST_F(VideoComposeTest, AGeneratorMakesAVideoThatIsTheSameEveryTime) {
    const json request{
        {"generate", "julia"}, {"width", 32}, {"height", 32}, {"frames", 3}};
    const std::int64_t one = made(interface_.post_json("/videos", request));
    const std::int64_t other = made(interface_.post_json("/videos", request));
    const json shown = json_of(interface_.get("/videos/" + std::to_string(one)));
    EXPECT_EQ(shown["frames"], 3);
    EXPECT_EQ(shown["width"], 32);
    EXPECT_EQ(shown["revision"],
              json_of(interface_.get("/videos/" + std::to_string(other)))["revision"]);
    const auto refusal = [&](const json& more) {
        json changed = request;
        changed.update(more);
        return refusal_of(interface_.post_json("/videos", changed));
    };
    EXPECT_EQ(refusal({{"generate", "mandelbrot"}}),
              (Refusal{400, "invalid_argument", "generate"}));
    EXPECT_EQ(refusal({{"width", 1}}).status, 422);
    EXPECT_EQ(refusal({{"frames", 0}}).status, 422);
    EXPECT_EQ(refusal({{"depth", 99}}).status, 422);
    EXPECT_EQ(refusal({{"leaves", 1}}), (Refusal{400, "unknown_parameter", "leaves"}));
}

TEST_F(VideoComposeTest, TheTrackOfThumbnailsCoversTheVideoAndPointsIntoTheSprite) {
    const std::int64_t id = upload(random_clip(20, 10, 3, 6));
    const std::string folder = "/videos/" + std::to_string(id);
    const http::Response track = interface_.get(folder + "/thumbnails.vtt");
    EXPECT_EQ(header_of(track, "Content-Type"), "text/vtt");
    EXPECT_EQ(body_of(track),
              "WEBVTT\n"
              "\n00:00:00.000 --> 00:00:00.040\nthumbnails.jpg#xywh=0,0,20,10\n"
              "\n00:00:00.040 --> 00:00:00.080\nthumbnails.jpg#xywh=20,0,20,10\n"
              "\n00:00:00.080 --> 00:00:00.120\nthumbnails.jpg#xywh=40,0,20,10\n");
    const http::Response sprite = interface_.get(folder + "/thumbnails.jpg");
    EXPECT_EQ(header_of(sprite, "Content-Type"), "image/jpeg");
    EXPECT_TRUE(body_of(sprite).starts_with("\xFF\xD8\xFF"));
    EXPECT_FALSE(header_of(sprite, "ETag").empty());
    EXPECT_EQ(interface_.get("/videos/77/thumbnails.vtt").status, 404);
    EXPECT_EQ(interface_.get("/videos/77/thumbnails.jpg").status, 404);
}

TEST_F(VideoComposeTest, TheTimelineTellsWhereSomethingChanges) {
    RawClip clip;
    clip.format = {16, 16, {25, 1}};
    clip.frames.assign(8, video::Picture(16, 16));
    for (video::Picture& frame : clip.frames)
        for (video::Rgba& pixel : frame.pixels) pixel = {5, 5, 5, 255};
    clip.frames[7].at(0, 0) = {200, 0, 0, 255};
    const std::string id = std::to_string(upload(clip));
    const json timeline =
        json_of(interface_.get("/video/timeline?buckets=4&video=" + id));
    ASSERT_EQ(timeline["buckets"].size(), 4u);
    EXPECT_EQ(timeline["time_levels"], 3);
    EXPECT_EQ(timeline["buckets"][0]["first"], 0);
    EXPECT_EQ(timeline["buckets"][0]["last"], 1);
    EXPECT_GT(timeline["buckets"][3]["temporal"], timeline["buckets"][0]["temporal"]);
    EXPECT_GT(timeline["buckets"][3]["spatial"], timeline["buckets"][0]["spatial"]);
    EXPECT_EQ(interface_.get("/video/timeline?level=9&video=" + id).status, 422);
    EXPECT_EQ(interface_.get("/video/timeline?video=77").status, 404);
    EXPECT_EQ(interface_.get("/video/timeline").status, 400);
}

TEST_F(VideoComposeTest, APanoramaTurnsRoundInWholeTurns) {
    const std::string id = std::to_string(upload(random_clip(32, 8, 2, 7)));
    const auto view = [&](const std::string& options) {
        return interface_.get(
            "/video/panorama?width=12&height=9&format=rgba&video=" + id + options);
    };
    const http::Response shown = view("&yaw=10");
    ASSERT_EQ(shown.status, 200) << body_of(shown);
    EXPECT_EQ(body_of(shown).size(), 4u * 12 * 9);
    EXPECT_EQ(body_of(view("&yaw=370")), body_of(shown));
    EXPECT_NE(body_of(view("&yaw=190")), body_of(shown));
    EXPECT_NE(body_of(view("&yaw=10&time=0.04")), body_of(shown));
    EXPECT_EQ(view("&fov=170").status, 422);
    EXPECT_EQ(view("&time=9").status, 422);
    EXPECT_EQ(interface_.get("/video/panorama?video=77").status, 404);
}

TEST_F(VideoComposeTest, PlaybackIsPartsThatCoverTheVideoOnceAndEnd) {
    const std::string id = std::to_string(upload(random_clip(8, 8, 6, 8)));
    const auto play = [&](const std::string& options) {
        return interface_.get("/video/play?video=" + id + options);
    };
    for (const char* speed : {"1000", "-1000"}) {
        http::Response stream = play("&format=png&speed=" + std::string(speed));
        ASSERT_EQ(stream.status, 200);
        EXPECT_TRUE(header_of(stream, "Content-Type")
                        .starts_with("multipart/x-mixed-replace; boundary="));
        EXPECT_GT(stream.poll_interval.count(), 0);
        const auto& source = std::get<http::ChunkSource>(stream.body);
        std::string all;
        while (const auto chunk = source()) all += *chunk;
        EXPECT_TRUE(all.starts_with("--frame\r\nContent-Type: image/png\r\n")) << speed;
        EXPECT_TRUE(all.ends_with("--frame--\r\n")) << speed;
    }
    EXPECT_EQ(play("&speed=0").status, 422);
    EXPECT_EQ(play("&level=9").status, 422);
    EXPECT_EQ(play("&fps=0").status, 400);
    EXPECT_EQ(play("&format=rgba").status, 400);
    EXPECT_EQ(interface_.get("/video/play?video=77").status, 404);
}

}  // namespace
}  // namespace haarmony::server
