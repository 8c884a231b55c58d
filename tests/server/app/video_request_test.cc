#include "server/app/video_request.h"

#include <gtest/gtest.h>

#include <string>

namespace haarmony::server {
namespace {

TEST(VideoRequest, ComesBackFromItsText) {
    VideoRequest request;
    request.origin = VideoOrigin::kComposed;
    request.wishes = {"a \"name\"", 0.1, 12, true};
    request.input = "input-7";
    request.append_to = 12;
    request.format = {100, 60, {30'000, 1'001}};
    LayerRequest layer;
    layer.video = 3;
    layer.dx = -4;
    layer.dy = 5;
    layer.at_level = 2;
    layer.scale_x = 1.5;
    layer.start = 9;
    layer.op = "xor";
    LayerRequest still;
    still.still = {1'000, 20, 30};
    request.composition = {{layer, still}, 7, 8, video::FrameRate{24, 1}};
    const auto back = video_request_of(to_text(request));
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->origin, request.origin);
    EXPECT_EQ(back->wishes.name, request.wishes.name);
    EXPECT_EQ(back->wishes.delta, request.wishes.delta);
    EXPECT_EQ(back->wishes.max_frames, 12);
    EXPECT_TRUE(back->wishes.index);
    EXPECT_EQ(back->input, request.input);
    EXPECT_EQ(back->append_to, 12);
    EXPECT_EQ(back->format, request.format);
    ASSERT_EQ(back->composition.layers.size(), 2u);
    const LayerRequest& first = back->composition.layers[0];
    EXPECT_EQ(first.video, 3);
    EXPECT_EQ(first.dx, -4);
    EXPECT_EQ(first.dy, 5);
    EXPECT_EQ(first.at_level, 2);
    EXPECT_EQ(first.scale_x, 1.5);
    EXPECT_EQ(first.start, 9);
    EXPECT_EQ(first.op, "xor");
    const StillPicture& picture = back->composition.layers[1].still;
    EXPECT_EQ(picture.offset, 1'000u);
    EXPECT_EQ(picture.width, 20);
    EXPECT_EQ(picture.height, 30);
    EXPECT_EQ(back->composition.rate, (video::FrameRate{24, 1}));
    EXPECT_EQ(input_of_request(to_text(request)), "input-7");
}

TEST(VideoRequest, KeepsWhatAGeneratorIsTold) {
    VideoRequest request;
    request.origin = VideoOrigin::kGenerated;
    request.generator = "julia";
    request.parameters.width = 64;
    request.parameters.frames = 3;
    request.parameters.depth = 5;
    request.parameters.seed = 4'294'967'295;
    const auto back = video_request_of(to_text(request));
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->generator, "julia");
    EXPECT_EQ(back->parameters.width, 64);
    EXPECT_EQ(back->parameters.height, 0);
    EXPECT_EQ(back->parameters.frames, 3);
    EXPECT_EQ(back->parameters.depth, 5);
    EXPECT_EQ(back->parameters.seed, 4'294'967'295);
    EXPECT_EQ(input_of_request(to_text(request)), std::nullopt);
}

// A row that others wrote must not lead to other files than inputs.
TEST(VideoRequest, OfAnotherHandIsNotUnderstood) {
    const std::string good =
        R"({"origin":"raw","name":"","delta":0,"max_frames":0,"index":false)";
    EXPECT_TRUE(video_request_of(good + "}"));
    for (const std::string& text :
         {std::string("{}"),
          std::string("[]"),
          std::string("not json"),
          good + R"(,"input":"../../x"})",
          good + R"(,"input":7})",
          good + R"(,"width":1})",
          good + R"(,"composition":{}})",
          std::string(
              R"({"origin":"film","name":"","delta":0,"max_frames":0,"index":false})"),
          std::string(
              R"({"origin":"raw","name":"","delta":-1,"max_frames":0,"index":false})"),
          std::string(
              R"({"origin":"raw","name":"","delta":0,"max_frames":-1,"index":false})")}) {
        const auto request = video_request_of(text);
        ASSERT_FALSE(request) << text;
        EXPECT_EQ(request.error().code, ErrorCode::kInvalidArgument);
    }
}

TEST(Rate, IsTheSmallestFractionThatIsTheNumber) {
    EXPECT_EQ(rate_of(25), (video::FrameRate{25, 1}));
    EXPECT_EQ(rate_of(29.97), (video::FrameRate{2'997, 100}));
    EXPECT_EQ(rate_of(30'000.0 / 1'001), (video::FrameRate{30'000, 1'001}));
    EXPECT_EQ(rate_of(12.5), (video::FrameRate{25, 2}));
    EXPECT_EQ(rate_of(0.001), (video::FrameRate{1, 1'000}));
    EXPECT_EQ(rate_of(1'000), (video::FrameRate{1'000, 1}));
}

}  // namespace
}  // namespace haarmony::server
