// Searches inside videos: /query with kind=frame and kind=all.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "engine/video/picture.h"
#include "tests/server/api/interface.h"
#include "tests/server/app/job_watch.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

constexpr int kSide = 32;
constexpr int kShotFrames = 4;

// A scene of large blocks that moves a little from frame to frame.
video::Picture frame_of(unsigned scene, int moved) {
    std::mt19937 random(scene);
    video::Picture picture(kSide, kSide);
    std::vector<video::Rgba> colors(16);
    for (video::Rgba& color : colors)
        color = {static_cast<std::uint8_t>(random()),
                 static_cast<std::uint8_t>(random()),
                 static_cast<std::uint8_t>(random()),
                 255};
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            picture.at(x, y) =
                colors[static_cast<std::size_t>(4 * (y / 8) + (x + moved) % kSide / 8)];
    return picture;
}

std::string png_text(const video::Picture& picture) {
    return text_of(png_of(picture.view()));
}

class VideoSearchTest : public testing::Test {
  protected:
    // A video of one shot after the other.
    std::int64_t upload(const std::vector<unsigned>& scenes, const std::string& options) {
        std::string bytes;
        for (const unsigned scene : scenes)
            for (int i = 0; i < kShotFrames; ++i) {
                const video::Picture frame = frame_of(scene, i);
                bytes.append(reinterpret_cast<const char*>(frame.pixels.data()),
                             4 * frame.pixels.size());
            }
        const json queued =
            json_of(interface_.post("/videos?width=32&height=32&rate=2" + options,
                                    "application/octet-stream",
                                    bytes));
        const auto id = queued["id"].get<std::int64_t>();
        EXPECT_EQ(finished(*interface_.jobs, id).state, schema::JobState::kDone);
        return json_of(interface_.get("/jobs/" + std::to_string(id)))["video"];
    }
    json matches(const std::string& options, const video::Picture& picture) {
        const http::Response response =
            interface_.post("/query?" + options, "image/png", png_text(picture));
        EXPECT_EQ(response.status, 200) << body_of(response);
        return json_of(response)["matches"];
    }

    Interface interface_;
};

TEST_F(VideoSearchTest, AFrameFindsItselfAndEveryShotIsToldOnce) {
    const std::int64_t first = upload({1, 2, 3}, "&index=true");
    const std::int64_t second = upload({4, 5}, "&index=true");
    upload({1}, "");  // cannot be found
    for (int moved = 0; moved < kShotFrames; ++moved) {
        const json found = matches("kind=frame", frame_of(2, moved));
        ASSERT_EQ(found.size(), 5u);
        EXPECT_EQ(found[0]["distance"], 0.0);
        EXPECT_EQ(found[0]["rank"], 1);
        const json& frame = found[0]["frame"];
        EXPECT_EQ(frame["video"], first);
        EXPECT_EQ(frame["index"], kShotFrames + moved);
        EXPECT_EQ(frame["time"], (kShotFrames + moved) / 2.0);
        EXPECT_EQ(interface_.get(found[0]["thumbnail"]).status, 200);
    }
    std::set<std::int64_t> videos;
    for (const json& match : matches("kind=frame&limit=2", frame_of(5, 0)))
        videos.insert(match["frame"]["video"].get<std::int64_t>());
    EXPECT_TRUE(videos.contains(second));
    EXPECT_EQ(matches("kind=frame&limit=2", frame_of(5, 0)).size(), 2u);
    EXPECT_EQ(json_of(interface_.get("/videos/1"))["indexed"], true);
    EXPECT_EQ(json_of(interface_.get("/videos/3"))["indexed"], false);
}

// Half as fine, darker and noisy.
video::Picture poor(const video::Picture& picture, unsigned seed) {
    std::mt19937 random(seed);
    video::Picture result(picture.width / 2, picture.height / 2);
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x) {
            const auto channel = [&](std::uint8_t video::Rgba::*of) {
                int sum = 0;
                for (int i = 0; i < 4; ++i)
                    sum += picture.at(2 * x + i % 2, 2 * y + i / 2).*of;
                const int noise = static_cast<int>(random() % 21) - 10;
                return static_cast<std::uint8_t>(std::clamp(sum / 5 + noise, 0, 255));
            };
            result.at(x, y) = {channel(&video::Rgba::r),
                               channel(&video::Rgba::g),
                               channel(&video::Rgba::b),
                               255};
        }
    return result;
}

TEST_F(VideoSearchTest, EveryFrameOfAFilmFindsItsOwnShotThoughItIsPoor) {
    const std::vector<unsigned> scenes{11, 12, 13, 14, 15, 16, 17};
    upload(scenes, "&index=true");
    upload({18, 19, 20}, "&index=true");
    for (int shot = 0; shot < static_cast<int>(scenes.size()); ++shot) {
        for (int moved = 0; moved < kShotFrames; ++moved) {
            const int frame = kShotFrames * shot + moved;
            const json found =
                matches("kind=frame&limit=1",
                        poor(frame_of(scenes[static_cast<std::size_t>(shot)], moved),
                             99u + frame));
            ASSERT_EQ(found.size(), 1u);
            EXPECT_EQ(found[0]["frame"]["video"], 1) << frame;
            // Half a second a frame: the shot is known by the time, whatever the level.
            const double time = found[0]["frame"]["time"];
            EXPECT_EQ(static_cast<int>(2 * time) / kShotFrames, shot) << frame;
        }
    }
}

TEST_F(VideoSearchTest, FollowsWhatIsAddedAndRemoved) {
    EXPECT_TRUE(matches("kind=frame", frame_of(1, 0)).empty());
    EXPECT_EQ(json_of(interface_.get("/status"))["frames"], 0);
    const std::int64_t id = upload({1}, "&index=true");
    EXPECT_EQ(matches("kind=frame", frame_of(1, 0)).size(), 1u);
    EXPECT_GE(json_of(interface_.get("/status"))["frames"], kShotFrames);
    EXPECT_EQ(json_of(interface_.get("/status"))["videos"], 1);
    interface_.send("DELETE", "/videos/" + std::to_string(id));
    EXPECT_TRUE(matches("kind=frame", frame_of(1, 0)).empty());
    upload({2}, "&index=true");
    EXPECT_EQ(matches("kind=frame", frame_of(2, 0))[0]["distance"], 0.0);
}

TEST_F(VideoSearchTest, ImagesAndFramesAreOneListByDistance) {
    upload({1}, "&index=true");
    const http::Response image =
        interface_.post("/images", "image/png", png_text(frame_of(2, 0)));
    ASSERT_EQ(image.status, 201) << body_of(image);
    const json of_image = matches("kind=all", frame_of(2, 0));
    ASSERT_EQ(of_image.size(), 2u);
    EXPECT_FALSE(of_image[0].contains("frame"));
    EXPECT_TRUE(of_image[1].contains("frame"));
    EXPECT_LE(of_image[0]["distance"], of_image[1]["distance"]);
    const json of_frame = matches("kind=all", frame_of(1, 0));
    EXPECT_TRUE(of_frame[0].contains("frame"));
    EXPECT_EQ(of_frame[1]["rank"], 2);
    EXPECT_EQ(matches("kind=all&limit=1", frame_of(1, 0)).size(), 1u);
    EXPECT_FALSE(matches("kind=image", frame_of(1, 0))[0].contains("frame"));
}

TEST_F(VideoSearchTest, AProfileOfAnotherKindIsAConflict) {
    upload({1}, "&index=true");
    ASSERT_EQ(interface_
                  .send("PUT",
                        "/profiles/mine",
                        {{"Content-Type", "application/json"}},
                        R"({"color_space":"lab"})")
                  .status,
              201);
    const http::Response response = interface_.post(
        "/query?kind=frame&profile=mine", "image/png", png_text(frame_of(1, 0)));
    EXPECT_EQ(refusal_of(response), (Refusal{409, "conflict", "profile"}));
}

}  // namespace
}  // namespace haarmony::server
