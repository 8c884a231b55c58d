// What /video/frame says of the making of a picture.
#include <gtest/gtest.h>

#include <regex>
#include <string>

#include "tests/engine/video/plain_clip.h"
#include "tests/server/api/interface.h"
#include "tests/server/app/job_watch.h"

namespace haarmony::server {
namespace {

class VideoFrameTest : public testing::Test {
  protected:
    VideoFrameTest() {
        std::string bytes;
        for (const video::Picture& frame :
             video::testing::random_clip(12, 10, 5, 1).frames)
            bytes.append(reinterpret_cast<const char*>(frame.pixels.data()),
                         4 * frame.pixels.size());
        const auto queued = json_of(interface_.post(
            "/videos?width=12&height=10", "application/octet-stream", bytes));
        const auto job = queued["id"].get<std::int64_t>();
        EXPECT_EQ(finished(*interface_.jobs, job).state, schema::JobState::kDone);
    }
    http::Response frame(const std::string& place, const http::Headers& headers = {}) {
        return interface_.get("/video/frame?video=1&" + place, headers);
    }
    std::string timing(const std::string& place) {
        const http::Response shown = frame(place);
        EXPECT_EQ(shown.status, 200) << body_of(shown);
        return header_of(shown, "Server-Timing");
    }

    Interface interface_;
};

TEST_F(VideoFrameTest, ServerTimingSaysWhatTheMakingTookAndNothingOfWhatWasKept) {
    const std::regex parts(
        R"(decode;dur=\d+\.\d{3}, draw;dur=\d+\.\d{3}, encode;dur=\d+\.\d{3})");
    for (const std::string place : {"frame=1",
                                    "frame=1&format=rgba",
                                    "frame=1&width=9&smooth=true",
                                    "time=0.04&shutter=0.12",
                                    "time=0.04&shutter=0.12&level=2.5"}) {
        const std::string made = timing(place);
        EXPECT_TRUE(std::regex_match(made, parts)) << place << ": " << made;
        EXPECT_EQ(timing(place), "") << place;
    }
    // The same picture under another name.
    EXPECT_EQ(timing("time_level=3&index=1"), "");
    const std::string etag = header_of(frame("frame=2"), "ETag");
    const http::Response known = frame("frame=2", {{"If-None-Match", etag}});
    EXPECT_EQ(known.status, 304);
    EXPECT_EQ(header_of(known, "Server-Timing"), "");
    EXPECT_EQ(header_of(frame("frame=5"), "Server-Timing"), "");
}

TEST_F(VideoFrameTest, WhatWasKeptIsTheReplyThatWasMade) {
    for (const std::string place : {"frame=3", "time=0.04&shutter=0.12&format=webp"}) {
        http::Response made = frame(place);
        const http::Response kept = frame(place);
        EXPECT_EQ(made.headers.erase("Server-Timing"), 1U);
        EXPECT_EQ(made.headers, kept.headers);
        EXPECT_EQ(body_of(made), body_of(kept));
    }
}

}  // namespace
}  // namespace haarmony::server
