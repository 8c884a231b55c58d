// Where measured clips come from: folders, generators, and clip-art.
#include "tests/eval/video_clips.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "tests/engine/video/raw_source.h"
#include "tests/eval/test/video_frames.h"
#include "tests/eval/video_clip_art.h"
#include "tests/support/temporary_folder.h"

namespace haarmony::eval {
namespace {

using haarmony::testing::TemporaryFolder;

TEST(VideoClips, FolderClipsAreReadByNameAndOthersPassed) {
    const TemporaryFolder folder;
    const VideoClip clip = noisy_clip(20, 12, 4);
    write_file(folder.file("b.png"), apng_of(clip));
    write_file(folder.file("a.png"), apng_of(noisy_clip(9, 9, 1)));
    write_file(folder.file("notes.txt"), "no clip");
    write_file(folder.file("empty.mkv"), "");
    const auto clips = folder_clips(folder.path());
    ASSERT_TRUE(clips.has_value()) << clips.error().message;
    ASSERT_EQ(clips->size(), 2U);
    EXPECT_EQ((*clips)[0].name, "a.png");
    EXPECT_EQ((*clips)[1].name, "b.png");
    const auto all = (*clips)[1].load(64);
    ASSERT_TRUE(all.has_value()) << all.error().message;
    EXPECT_EQ(all->frames, clip.frames);
    EXPECT_EQ(all->kind, VideoKind::kNatural);
    EXPECT_EQ(all->raw_bytes(), 4U * 20 * 12 * 4);
    const auto first = (*clips)[1].load(3);
    ASSERT_TRUE(first.has_value());
    EXPECT_EQ(first->frames.size(), 3U);
}

TEST(VideoClips, WhatCannotBeReadIsNamed) {
    const TemporaryFolder folder;
    EXPECT_EQ(folder_clips(folder.file("nowhere")).error().code, ErrorCode::kNotFound);
    const std::string bytes = apng_of(noisy_clip(40, 40, 3));
    write_file(folder.file("cut.png"), bytes.substr(0, bytes.size() / 2));
    const auto clips = folder_clips(folder.path());
    ASSERT_TRUE(clips.has_value());
    ASSERT_EQ(clips->size(), 1U);
    const auto cut = (*clips)[0].load(64);
    ASSERT_FALSE(cut.has_value());
    EXPECT_EQ(cut.error().code, ErrorCode::kUndecodable);
    EXPECT_TRUE(cut.error().message.starts_with("cut.png: ")) << cut.error().message;
    std::filesystem::remove(folder.file("cut.png"));
    EXPECT_EQ((*clips)[0].load(64).error().code, ErrorCode::kIo);
}

TEST(VideoClips, EveryGeneratedExampleHasItsFrames) {
    std::set<std::string> names;
    for (const VideoClipSource& source : generated_clips(32)) {
        const auto clip = source.load(3);
        ASSERT_TRUE(clip.has_value()) << clip.error().message;
        names.insert(clip->name);
        EXPECT_EQ(clip->frames.size(), 3U) << clip->name;
        EXPECT_EQ(clip->kind, VideoKind::kGenerated);
        EXPECT_EQ(clip->format.height, 32) << clip->name;
        EXPECT_EQ(clip->format.width, clip->name == "panorama" ? 128 : 32);
        for (const video::Picture& frame : clip->frames) {
            EXPECT_EQ(frame.width, clip->format.width) << clip->name;
        }
    }
    EXPECT_EQ(names.size(), 6U);
    const auto refused = generated_clips(8).front().load(3);
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
}

TEST(VideoClips, FramesThatStayAreDrawnAsOftenAndErrorsPassedOn) {
    const VideoClip clip = noisy_clip(16, 16, 3);
    video::testing::RawClip raw;
    raw.format = clip.format;
    raw.frames = clip.frames;
    video::testing::RawSource source(raw);
    source.set_repeats({2, 1, 3});
    const auto drawn = drawn_frames(source);
    ASSERT_TRUE(drawn.has_value());
    ASSERT_EQ(drawn->size(), 6U);
    EXPECT_EQ((*drawn)[1], clip.frames[0]);
    EXPECT_EQ((*drawn)[2], clip.frames[1]);
    EXPECT_EQ((*drawn)[5], clip.frames[2]);
    video::testing::RawSource failing(raw);
    failing.fail_at(1);
    EXPECT_FALSE(drawn_frames(failing).has_value());
}

TEST(VideoClips, PicturesAreASourceOfThemselves) {
    const VideoClip clip = noisy_clip(37, 18, 3);
    PictureFrames source(clip.format, clip.frames);
    const auto drawn = drawn_frames(source);
    ASSERT_TRUE(drawn.has_value());
    EXPECT_EQ(*drawn, clip.frames);
}

TEST(ClipArtOnAPhoto, MovesOnlyWhereTheObjectIs) {
    const VideoClip clip = make_clip_art(128, 6);
    ASSERT_EQ(clip.frames.size(), 6U);
    for (std::size_t t = 1; t < clip.frames.size(); ++t) {
        int differ = 0;
        for (std::size_t p = 0; p < clip.frames[t].pixels.size(); ++p) {
            differ += clip.frames[t].pixels[p] != clip.frames[t - 1].pixels[p] ? 1 : 0;
        }
        // Two discs of radius 4, and their edges.
        EXPECT_GT(differ, 40) << t;
        EXPECT_LT(differ, 160) << t;
    }
}

TEST(ClipArtOnAPhoto, BackgroundIsNowhereFlat) {
    const VideoClip clip = make_clip_art(64, 1);
    for (std::int32_t y = 0; y + 4 <= 64; y += 4) {
        for (std::int32_t x = 0; x + 4 <= 24; x += 4) {
            std::set<int> greens;
            for (int p = 0; p < 16; ++p) {
                greens.insert(clip.frames[0].at(x + p % 4, y + p / 4).g);
            }
            EXPECT_GT(greens.size(), 1U) << x << " " << y;
        }
    }
}

}  // namespace
}  // namespace haarmony::eval
