// Frames that come back poor, on clips whose shots are known.
#include "tests/eval/frame_retrieval.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/eval/test/video_frames.h"
#include "tests/support/temporary_folder.h"

namespace haarmony::eval {
namespace {

using haarmony::testing::TemporaryFolder;

constexpr int kShotFrames = 5;

// Shots of large blocks that move a little; another number, other colours.
VideoClip clip_of(const std::string& name, const std::vector<unsigned>& scenes) {
    VideoClip clip{name, VideoKind::kNatural, {64, 48, {25, 1}}, {}};
    for (const unsigned scene : scenes) {
        for (int t = 0; t < kShotFrames; ++t) {
            std::mt19937 random(scene);
            std::vector<video::Rgba> colors(12);
            for (video::Rgba& color : colors)
                color = {static_cast<std::uint8_t>(random()),
                         static_cast<std::uint8_t>(random()),
                         static_cast<std::uint8_t>(random()),
                         255};
            video::Picture& frame = clip.frames.emplace_back(64, 48);
            for (int y = 0; y < 48; ++y)
                for (int x = 0; x < 64; ++x)
                    frame.at(x, y) = colors[static_cast<std::size_t>(4 * (y / 16) +
                                                                     (x + t) % 64 / 16)];
        }
    }
    return clip;
}

const std::vector<VideoClip>& three_clips() {
    static const std::vector<VideoClip> clips = {
        clip_of("a", {1, 2}), clip_of("b", {3}), clip_of("c", {4, 5})};
    return clips;
}

FrameRetrieval measured(const FrameRetrievalOptions& options,
                        std::vector<std::string>* heard = nullptr) {
    const auto result =
        measure_frames(three_clips(), options, [&](const std::string& line) {
            if (heard != nullptr) heard->push_back(line);
        });
    EXPECT_TRUE(result) << result.error().message;
    return *result;
}

TEST(FrameRetrieval, EveryPoorFrameOfClearShotsFindsItsOwn) {
    std::vector<std::string> heard;
    const FrameRetrieval found = measured({.queries = 12}, &heard);
    EXPECT_EQ(found.clips, 3);
    EXPECT_EQ(found.frames, 25);
    EXPECT_EQ(found.clip_shots, 5);
    EXPECT_EQ(found.film_shots, 5);
    EXPECT_EQ(found.film_cuts, 2);
    EXPECT_GE(found.signatures, found.frames);
    EXPECT_EQ(found.rows.size(), 8 * heard.size());
    for (const FrameRetrievalRow& row : found.rows) {
        EXPECT_EQ(row.queries, 12);
        EXPECT_EQ(row.own_shot, 12)
            << row.collection << ' ' << row.distortion << ' ' << row.profile;
        EXPECT_EQ(row.own_clip, 12) << row.distortion;
    }
}

// Twins cannot be told apart: only one of the two is found.
TEST(FrameRetrieval, AnotherClipThatLooksTheSameIsAMiss) {
    const std::vector<VideoClip> twins = {clip_of("a", {7}), clip_of("b", {7})};
    const auto result = measure_frames(
        twins, {.queries = 10, .profiles = {"painted"}}, [](const std::string&) {});
    ASSERT_TRUE(result);
    const FrameRetrievalRow& row = result->row("clips", "identity", "painted");
    EXPECT_EQ(row.queries, 10);
    EXPECT_EQ(row.own_clip, kShotFrames);
    EXPECT_EQ(row.own_shot, kShotFrames);
}

TEST(FrameRetrieval, TheSameSeedGivesTheSameTable) {
    const FrameRetrievalOptions options{.queries = 4, .seed = 3, .profiles = {"scanned"}};
    const FrameRetrieval once = measured(options);
    EXPECT_EQ(once.rows, measured(options).rows);
    const std::string csv = frame_retrieval_files(once).front().text;
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'),
              1 + static_cast<std::ptrdiff_t>(once.rows.size()));
    EXPECT_NE(to_text(once).find("2 of 2 cuts"), std::string::npos) << to_text(once);
}

TEST(FrameRetrieval, ReadsAFolderAndNamesWhatIsWrong) {
    const TemporaryFolder folder;
    FrameRetrievalOptions options{.clips = folder.path(), .queries = 3, .frames = 4};
    const auto quiet = [](const std::string&) {};
    EXPECT_EQ(measure_frames(options, quiet).error().code, ErrorCode::kNotFound);
    write_file(folder.file("a.png"), apng_of(noisy_clip(32, 24, 6)));
    options.profiles = {"no such"};
    EXPECT_EQ(measure_frames(options, quiet).error().param, "profile");
    options.profiles = {"painted"};
    const auto found = measure_frames(options, quiet);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(found->frames, 4);
    EXPECT_EQ(found->row("one film", "identity", "painted").own_shot, 3);
}

}  // namespace
}  // namespace haarmony::eval
