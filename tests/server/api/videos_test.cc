// /videos and /video/frame: every picture of an uploaded clip against the definition, and
// what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
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

std::string bytes_of(const RawClip& clip) {
    std::string bytes;
    for (const video::Picture& frame : clip.frames) bytes += bytes_of(frame);
    return bytes;
}

std::string size_of(const RawClip& clip) {
    return "width=" + std::to_string(clip.format.width) +
           "&height=" + std::to_string(clip.format.height);
}

class VideosTest : public testing::Test {
  protected:
    // The id of the video that the job of this reply has made.
    std::int64_t made(const http::Response& queued) {
        EXPECT_EQ(queued.status, 202) << body_of(queued);
        if (queued.status != 202) return 0;
        const auto id = json_of(queued)["id"].get<std::int64_t>();
        EXPECT_EQ(header_of(queued, "Location"), "/jobs/" + std::to_string(id));
        const schema::Job ended = finished(*interface_.jobs, id);
        EXPECT_EQ(ended.state, schema::JobState::kDone)
            << (ended.errors.empty() ? "" : ended.errors.front());
        const json job = json_of(interface_.get("/jobs/" + std::to_string(id)));
        return job.value("video", std::int64_t{0});
    }
    std::int64_t upload(const RawClip& clip, const std::string& options = "") {
        return made(interface_.post(
            "/videos?" + size_of(clip) + options, kBytes, bytes_of(clip)));
    }
    http::Response frame(std::int64_t video, const std::string& place) {
        return interface_.get("/video/frame?video=" + std::to_string(video) + "&" +
                              place);
    }
    Refusal refused(std::int64_t video, const std::string& place) {
        return refusal_of(frame(video, place));
    }
    json video(std::int64_t id) {
        return json_of(interface_.get("/videos/" + std::to_string(id)));
    }

    Interface interface_;
};

TEST_F(VideosTest, EveryPictureOfAnUploadIsTheDefinitions) {
    const RawClip clip = random_clip(13, 9, 5, 1);
    const std::int64_t id = upload(clip);
    const video::ClipShape shape = shape_of(clip);
    for (int k = 0; k <= shape.time_levels(); ++k)
        for (std::int64_t i = 0; i < shape.nodes_at(k); ++i)
            for (int l = 0; l <= shape.space_levels(); ++l)
                for (const Edge edge : {Edge::kPad, Edge::kNormalize}) {
                    const std::string place =
                        "time_level=" + std::to_string(k) +
                        "&index=" + std::to_string(i) + "&level=" + std::to_string(l) +
                        (edge == Edge::kPad ? "&edge=pad" : "") + "&format=rgba";
                    const http::Response shown = frame(id, place);
                    ASSERT_EQ(shown.status, 200) << place << body_of(shown);
                    EXPECT_EQ(body_of(shown),
                              bytes_of(exact_picture(clip, {k, i}, l, edge)))
                        << place;
                    EXPECT_EQ(header_of(shown, "X-Width"),
                              std::to_string(shape.width_at(l)));
                    EXPECT_EQ(header_of(shown, "X-Height"),
                              std::to_string(shape.height_at(l)));
                    const video::FrameRange frames = shape.frames_of({k, i});
                    EXPECT_EQ(header_of(shown, "X-Frame-Interval"),
                              std::to_string(frames.first) + "-" +
                                  std::to_string(frames.end - 1));
                }
}

TEST_F(VideosTest, TellsItsShapeAndStorage) {
    const RawClip clip = random_clip(13, 9, 5, 2);
    const std::int64_t id = upload(clip, "&name=a%20clip&rate=29.97");
    const json shown = video(id);
    EXPECT_EQ(shown["id"], id);
    EXPECT_EQ(shown["name"], "a clip");
    EXPECT_EQ(shown["width"], 13);
    EXPECT_EQ(shown["height"], 9);
    EXPECT_EQ(shown["frames"], 5);
    EXPECT_DOUBLE_EQ(shown["rate"].get<double>(), 29.97);
    EXPECT_EQ(shown["time_levels"], 3);
    EXPECT_EQ(shown["space_levels"], 4);
    EXPECT_EQ(shown["delta"], 0.0);
    EXPECT_EQ(shown["indexed"], false);
    const json& storage = shown["storage"];
    // 1 + 2 + 3 + 5 time nodes of 1 + 4 + 16 + 64 subtrees.
    EXPECT_EQ(storage["time_nodes"], 11);
    EXPECT_EQ(storage["complete_subtrees"], 11 * 85);
    EXPECT_LE(storage["own_subtrees"], storage["pruned_subtrees"]);
    EXPECT_EQ(storage["paper_bytes"].get<std::int64_t>(),
              24 * storage["own_subtrees"].get<std::int64_t>() + 12 * 11);
    EXPECT_EQ(storage["raw_bytes"], 4 * 13 * 9 * 5);
    EXPECT_GT(storage["memory_bytes"], 0);
    const http::Response file =
        interface_.get("/videos/" + std::to_string(id) + "/export");
    ASSERT_TRUE(std::holds_alternative<http::FileRange>(file.body));
    EXPECT_EQ(storage["disk_bytes"], std::get<http::FileRange>(file.body).length);
}

TEST_F(VideosTest, AreListedAndRemoved) {
    std::vector<std::int64_t> ids;
    for (unsigned seed = 1; seed <= 3; ++seed)
        ids.push_back(upload(random_clip(4, 4, 2, seed)));
    json page = json_of(interface_.get("/videos?limit=2"));
    ASSERT_EQ(page["items"].size(), 2u);
    EXPECT_EQ(page["items"][0]["id"], ids[0]);
    page = json_of(
        interface_.get("/videos?cursor=" + page["next_cursor"].get<std::string>()));
    ASSERT_EQ(page["items"].size(), 1u);
    EXPECT_EQ(page["items"][0]["id"], ids[2]);
    EXPECT_EQ(page["next_cursor"], nullptr);
    const std::string address = "/videos/" + std::to_string(ids[1]);
    EXPECT_EQ(frame(ids[1], "frame=0").status, 200);
    EXPECT_EQ(interface_.send("DELETE", address).status, 204);
    EXPECT_EQ(interface_.send("DELETE", address).status, 404);
    EXPECT_EQ(interface_.get(address).status, 404);
    // Also what was kept, encoded.
    EXPECT_EQ(refused(ids[1], "frame=0"), (Refusal{404, "not_found", "video"}));
}

TEST_F(VideosTest, AnUploadThatIsNoVideoIsRefusedBeforeThereIsAJob) {
    const auto refusal =
        [&](const std::string& target, const std::string& type, const std::string& body) {
            return refusal_of(interface_.post("/videos" + target, type, body));
        };
    const std::string frame(4 * 4 * 4, 'x');
    EXPECT_EQ(refusal("?width=4&height=4", kBytes, frame + "x"),
              (Refusal{422, "not_whole_frames", "width"}));
    EXPECT_EQ(refusal("?width=4&height=4", kBytes, ""),
              (Refusal{422, "not_whole_frames", "width"}));
    EXPECT_EQ(refusal("?width=0&height=4", kBytes, frame).status, 422);
    EXPECT_EQ(refusal("?width=70000&height=4", kBytes, frame).status, 422);
    EXPECT_EQ(refusal("?width=4", kBytes, frame),
              (Refusal{400, "invalid_argument", "height"}));
    EXPECT_EQ(refusal("?width=x&height=4", kBytes, frame),
              (Refusal{400, "invalid_argument", "width"}));
    EXPECT_EQ(refusal("?width=4&height=4&rate=0", kBytes, frame),
              (Refusal{400, "invalid_argument", "rate"}));
    EXPECT_EQ(refusal("?width=4&height=4&delta=-1", kBytes, frame),
              (Refusal{400, "invalid_argument", "delta"}));
    EXPECT_EQ(refusal("?width=4&height=4&max_frames=0", kBytes, frame),
              (Refusal{400, "invalid_argument", "max_frames"}));
    EXPECT_EQ(refusal("?width=4&height=4&speed=1", kBytes, frame),
              (Refusal{400, "unknown_parameter", "speed"}));
    EXPECT_EQ(refusal("?width=4&height=4&name=" + std::string(257, 'n'), kBytes, frame),
              (Refusal{400, "invalid_argument", "name"}));
    EXPECT_EQ(refusal("", "text/plain", "hello").status, 415);
    EXPECT_EQ(json_of(interface_.get("/jobs"))["items"], json::array());
    EXPECT_EQ(json_of(interface_.get("/videos"))["items"], json::array());
}

TEST_F(VideosTest, LeavesBecomeTheSameVideoAsThePixelsThatTheyStandFor) {
    // A quarter of one colour, a pixel in another one, the rest clear; it stays for two.
    const json leaves = {{1, 0, 0, 10, 20, 30, 255}, {3, 7, 7, 200, 100, 50, 128}};
    RawClip clip;
    clip.format = {8, 8, {25, 1}};
    clip.frames.assign(2, video::Picture(8, 8));
    for (video::Picture& frame : clip.frames) {
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 4; ++x) frame.at(x, y) = {10, 20, 30, 255};
        frame.at(7, 7) = {200, 100, 50, 128};
    }
    const json request{{"frames", {{{"leaves", leaves}, {"repeats", 2}}}}};
    const std::int64_t id = made(interface_.post_json("/videos", request));
    EXPECT_EQ(video(id)["revision"], video(upload(clip))["revision"]);
    EXPECT_EQ(body_of(frame(id, "frame=1&format=rgba")), bytes_of(clip.frames[1]));
}

TEST_F(VideosTest, LeavesThatNoFrameCanHaveAreRefusedNamingThem) {
    const auto refusal = [&](const json& frames, const json& more = json::object()) {
        json request{{"frames", frames}};
        request.update(more);
        return refusal_of(interface_.post_json("/videos", request));
    };
    const json leaf{1, 0, 0, 1, 2, 3, 4};
    EXPECT_EQ(refusal(json::array()), (Refusal{422, "no_frames", "frames"}));
    EXPECT_EQ(refusal(7).status, 400);
    EXPECT_EQ(refusal({{{"leaf", {leaf}}}}).status, 400);
    EXPECT_EQ(refusal({{{"leaves", {leaf}}, {"color", 1}}}),
              (Refusal{400, "unknown_parameter", "frames[0].color"}));
    EXPECT_EQ(refusal({{{"leaves", {{1, 0, 0}}}}}),
              (Refusal{400, "invalid_argument", "frames[0].leaves[0]"}));
    EXPECT_EQ(refusal({{{"leaves", {leaf}}}, {{"leaves", {{1, 0, 0, 1, 2, 3, 256}}}}}),
              (Refusal{422, "out_of_range", "frames[1].leaves[0][6]"}));
    EXPECT_EQ(refusal({{{"leaves", {{1, 0, 0, 1, 2, 3, 0.5}}}}}),
              (Refusal{400, "invalid_argument", "frames[0].leaves[0][6]"}));
    // Outside the root square, and on top of each other.
    EXPECT_EQ(refusal({{{"leaves", {{1, 2, 0, 1, 2, 3, 4}}}}}).status, 422);
    EXPECT_EQ(refusal({{{"leaves", {leaf, leaf}}}}).status, 422);
    EXPECT_EQ(refusal({{{"leaves", {leaf}}}}, {{"width", 0}}).status, 422);
    EXPECT_EQ(refusal_of(interface_.post_json("/videos", json::object())),
              (Refusal{400, "no_source", "frames"}));
    EXPECT_EQ(json_of(interface_.get("/jobs"))["items"], json::array());
}

TEST_F(VideosTest, AClipFileComesBackAsTheSameVideo) {
    const RawClip clip = random_clip(10, 6, 3, 4);
    const std::int64_t first = upload(clip);
    const http::Response file =
        interface_.get("/videos/" + std::to_string(first) + "/export?format=mrv");
    ASSERT_EQ(file.status, 200);
    const auto& range = std::get<http::FileRange>(file.body);
    const std::string bytes = schema::read_bytes(range.path);
    EXPECT_EQ(range.length, bytes.size());
    const std::int64_t again = made(interface_.post("/videos?name=b", kBytes, bytes));
    EXPECT_NE(again, first);
    EXPECT_EQ(video(again)["revision"], video(first)["revision"]);
    EXPECT_EQ(video(again)["storage"], video(first)["storage"]);
    EXPECT_EQ(refusal_of(interface_.post("/videos?delta=1", kBytes, bytes)),
              (Refusal{400, "invalid_argument", "delta"}));
    std::string damaged = bytes;
    damaged[damaged.size() / 2] = static_cast<char>(~damaged[damaged.size() / 2]);
    const http::Response queued = interface_.post("/videos", kBytes, damaged);
    if (queued.status == 202) {
        const auto job = json_of(queued)["id"].get<std::int64_t>();
        const schema::Job ended = finished(*interface_.jobs, job);
        EXPECT_EQ(ended.state, schema::JobState::kFailed);
        EXPECT_FALSE(ended.errors.empty());
    } else {
        EXPECT_EQ(queued.status, 422) << body_of(queued);
    }
    EXPECT_EQ(json_of(interface_.get("/videos"))["items"].size(), 2u);
}

TEST_F(VideosTest, ARateIsTheFractionThatIsMeant) {
    const RawClip clip = random_clip(2, 2, 1, 5);
    for (const double rate : {25.0, 29.97, 30'000.0 / 1'001, 0.5, 12.5, 59.94})
        EXPECT_DOUBLE_EQ(
            video(upload(clip, "&rate=" + json(rate).dump()))["rate"].get<double>(),
            rate);
}

TEST_F(VideosTest, MaxFramesAndDeltaAreObeyed) {
    const RawClip clip = random_clip(32, 32, 4, 6);
    EXPECT_EQ(video(upload(clip, "&max_frames=3"))["frames"], 3);
    const json exact = video(upload(clip));
    const json lossy = video(upload(clip, "&delta=255"));
    EXPECT_EQ(lossy["frames"], 4);
    EXPECT_EQ(lossy["delta"], 255.0);
    EXPECT_LT(lossy["storage"]["own_subtrees"], exact["storage"]["own_subtrees"]);
    EXPECT_LT(lossy["storage"]["disk_bytes"], exact["storage"]["disk_bytes"]);
}

TEST_F(VideosTest, TimeIsTheSameHoweverItIsSaid) {
    const RawClip clip = random_clip(8, 8, 6, 7);
    const std::int64_t id = upload(clip, "&rate=10");
    const std::string third = body_of(frame(id, "time_level=3&index=3&format=rgba"));
    EXPECT_EQ(body_of(frame(id, "frame=3&format=rgba")), third);
    EXPECT_EQ(body_of(frame(id, "time=0.35&format=rgba")), third);
    const http::Response posted = interface_.post_json(
        "/video/frame", {{"video", id}, {"frame", 3}, {"format", "rgba"}});
    EXPECT_EQ(body_of(posted), third);
    // Two frames that are a node, and three that are none.
    const http::Response two = frame(id, "time=0.2&shutter=0.2&format=rgba");
    EXPECT_EQ(header_of(two, "X-Frame-Interval"), "2-3");
    EXPECT_EQ(body_of(two), body_of(frame(id, "time_level=2&index=1&format=rgba")));
    const http::Response three = frame(id, "time=0.1&shutter=0.3&format=rgba");
    EXPECT_EQ(header_of(three, "X-Frame-Interval"), "1-3");
    EXPECT_EQ(header_of(frame(id, "time=0.5&shutter=9"), "X-Frame-Interval"), "5-5");
    const http::Response half =
        frame(id, "time_level=1&index=0&half_blur=true&format=rgba");
    EXPECT_EQ(header_of(half, "X-Frame-Interval"), "0-1");
    EXPECT_EQ(body_of(half), body_of(frame(id, "time_level=2&index=0&format=rgba")));
}

TEST_F(VideosTest, WhatIsOutsideTheClipIsImpossible) {
    const std::int64_t id = upload(random_clip(8, 8, 6, 8));
    const std::vector<std::pair<std::string, Refusal>> refusals{
        {"", {422, "no_time", "time"}},
        {"time_level=3", {422, "no_time", "index"}},
        {"index=3", {422, "no_time", "time_level"}},
        {"frame=6", {422, "out_of_range", "frame"}},
        {"frame=-1", {422, "out_of_range", "frame"}},
        {"time=0.24", {422, "out_of_range", "time"}},
        {"time=-0.01", {422, "out_of_range", "time"}},
        {"time=0&shutter=-1", {422, "out_of_range", "shutter"}},
        {"time_level=4&index=0", {422, "out_of_range", "time_level"}},
        {"time_level=2&index=3", {422, "out_of_range", "index"}},
        {"frame=0&level=3.5", {422, "out_of_range", "level"}},
        {"frame=0&level=-1", {422, "out_of_range", "level"}},
        {"frame=0&x=1", {422, "out_of_range", "x"}},
        {"frame=0&x=0.5&w=0.6", {422, "out_of_range", "w"}},
        {"frame=0&h=0", {422, "out_of_range", "h"}},
        {"frame=0&time=0", {400, "invalid_argument", "time"}},
        {"frame=0&shutter=1", {400, "invalid_argument", "shutter"}},
        {"time=0&shutter=1&half_blur=true", {400, "invalid_argument", "half_blur"}},
        {"frame=0&level=1&width=9", {400, "invalid_argument", "width"}},
        {"frame=x", {400, "invalid_argument", "frame"}},
        {"frame=0&edge=soft", {400, "invalid_argument", "edge"}},
        {"frame=0&format=gif", {400, "invalid_argument", "format"}},
        {"frame=0&background=red", {400, "invalid_argument", "background"}},
        {"frame=0&colour=1", {400, "unknown_parameter", "colour"}},
        {"frame=0&rev=0", {404, "not_found", "rev"}}};
    for (const auto& [place, refusal] : refusals)
        EXPECT_EQ(refused(id, place), refusal) << place;
    EXPECT_EQ(refused(77, "frame=0"), (Refusal{404, "not_found", "video"}));
    EXPECT_EQ(refusal_of(interface_.get("/video/frame?frame=0")),
              (Refusal{400, "invalid_argument", "video"}));
    EXPECT_EQ(frame(id, "frame=0&width=0").status, 422);
    EXPECT_EQ(frame(id, "frame=0&width=100000").status, 413);
}

TEST_F(VideosTest, ARegionIsThatPartOfThePictureOutwardToWholePixels) {
    const RawClip clip = random_clip(10, 7, 1, 9);
    const std::int64_t id = upload(clip);
    const video::Picture whole = clip.frames.front();
    const auto part = [&](int x, int y, int width, int height) {
        video::Picture cut(width, height);
        for (int v = 0; v < height; ++v)
            for (int u = 0; u < width; ++u) cut.at(u, v) = whole.at(x + u, y + v);
        return bytes_of(cut);
    };
    EXPECT_EQ(body_of(frame(id, "frame=0&x=0.25&y=0.5&w=0.5&h=0.25&format=rgba")),
              part(2, 3, 6, 3));
    // Fractions that no double is: 3 pixels, not 4.
    EXPECT_EQ(body_of(frame(id, "frame=0&x=0.1&w=0.2&format=rgba")), part(1, 0, 2, 7));
    EXPECT_EQ(body_of(frame(id, "frame=0&x=0.99&y=0.99&format=rgba")), part(9, 6, 1, 1));
}

TEST_F(VideosTest, AWidthMakesTheWholePictureThatWide) {
    const std::int64_t id = upload(random_clip(100, 60, 1, 10));
    for (const int width : {1, 7, 50, 99, 100, 333}) {
        const http::Response shown =
            frame(id, "frame=0&width=" + std::to_string(width) + "&format=rgba");
        EXPECT_EQ(header_of(shown, "X-Width"), std::to_string(width));
        EXPECT_EQ(body_of(shown).size(),
                  4u * std::stoul(header_of(shown, "X-Width")) *
                      std::stoul(header_of(shown, "X-Height")));
    }
    EXPECT_EQ(body_of(frame(id, "frame=0&width=50&format=rgba")),
              body_of(frame(id, "frame=0&level=6&format=rgba")));
    // 2^5.5 is 45.25: the root square is 45 pixels wide, and 100 / 128 of that is shown.
    EXPECT_EQ(header_of(frame(id, "frame=0&level=5.5"), "X-Width"),
              std::to_string(static_cast<int>(std::ceil(100 * 45 / 128.0))));
}

TEST_F(VideosTest, FinerDetailIsToldWhereItIs) {
    RawClip clip;
    clip.format = {16, 16, {25, 1}};
    clip.frames.assign(4, video::Picture(16, 16));
    for (video::Picture& still : clip.frames)
        for (video::Rgba& pixel : still.pixels) pixel = {9, 9, 9, 255};
    clip.frames[3].at(15, 15) = {1, 2, 3, 255};
    const std::int64_t id = upload(clip);
    const auto detail = [&](const std::string& place) {
        return header_of(frame(id, place), "X-Detail");
    };
    EXPECT_EQ(detail("time_level=0&index=0&level=1"), "yes, yes");
    EXPECT_EQ(detail("time_level=0&index=0&level=4"), "no, yes");
    EXPECT_EQ(detail("time_level=1&index=0&level=1"), "no, no");
    EXPECT_EQ(detail("frame=3&level=2"), "yes, no");
    EXPECT_EQ(detail("frame=3&level=2&w=0.5&h=0.5"), "no, no");
}

TEST_F(VideosTest, TheEncodingIsNamedOrTakenFromWhatTheClientAccepts) {
    const std::int64_t id = upload(random_clip(6, 5, 1, 11));
    const auto type = [&](const std::string& place, const std::string& accept) {
        const http::Response shown = interface_.get(
            "/video/frame?frame=0&video=" + std::to_string(id) + place,
            accept.empty() ? http::Headers{} : http::Headers{{"Accept", accept}});
        EXPECT_EQ(header_of(shown, "Vary"), "Accept");
        return header_of(shown, "Content-Type");
    };
    EXPECT_EQ(type("", ""), "image/png");
    EXPECT_EQ(type("", "*/*"), "image/png");
    EXPECT_EQ(type("", "image/webp"), "image/webp");
    EXPECT_EQ(type("", "image/png;q=0.5, image/jpeg"), "image/jpeg");
    EXPECT_EQ(type("", "image/*;q=0.8, application/octet-stream;q=0.9"),
              "application/octet-stream");
    EXPECT_EQ(type("", "text/html"), "image/png");
    EXPECT_EQ(type("&format=jpeg", "image/webp"), "image/jpeg");
    EXPECT_EQ(type("&format=rgba", ""), "application/octet-stream");
}

TEST_F(VideosTest, PicturesHaveStrongTagsAndAreKeptForEverUnderTheirRevision) {
    const std::int64_t id = upload(random_clip(6, 5, 2, 12));
    const http::Response shown = frame(id, "frame=0");
    const std::string etag = header_of(shown, "ETag");
    EXPECT_TRUE(etag.starts_with('"')) << etag;
    EXPECT_EQ(header_of(shown, "Cache-Control"), "no-cache");
    EXPECT_EQ(header_of(frame(id, "time_level=1&index=0"), "ETag"), etag);
    EXPECT_NE(header_of(frame(id, "frame=1"), "ETag"), etag);
    EXPECT_NE(header_of(frame(id, "frame=0&format=webp"), "ETag"), etag);
    EXPECT_NE(header_of(frame(id, "frame=0&background=000000"), "ETag"), etag);
    const std::string target = "/video/frame?frame=0&video=" + std::to_string(id);
    const http::Response again = interface_.get(target, {{"If-None-Match", etag}});
    EXPECT_EQ(again.status, 304);
    EXPECT_EQ(body_of(again), "");
    const http::Response range = interface_.get(target, {{"Range", "bytes=1-3"}});
    EXPECT_EQ(range.status, 206);
    EXPECT_EQ(body_of(range), "PNG");
    const http::Response kept =
        interface_.get(target + "&rev=" + video(id)["revision"].get<std::string>());
    EXPECT_NE(header_of(kept, "Cache-Control").find("immutable"), std::string::npos);
    EXPECT_EQ(body_of(kept), body_of(shown));
}

TEST_F(VideosTest, ABackgroundShinesThroughWhatIsTransparent) {
    RawClip clip;
    clip.format = {2, 1, {25, 1}};
    clip.frames.assign(1, video::Picture(2, 1));
    clip.frames[0].at(0, 0) = {200, 100, 0, 128};
    const std::int64_t id = upload(clip);
    const std::string shown =
        body_of(frame(id, "frame=0&background=%23ff0080&format=rgba"));
    // 128 / 255 of the pixel and 127 / 255 of the background.
    EXPECT_EQ(shown, std::string("\xE3\x32\x40\xFF\xFF\x00\x80\xFF", 8));
}

}  // namespace
}  // namespace haarmony::server
