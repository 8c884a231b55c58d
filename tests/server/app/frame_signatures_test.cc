#include "server/app/frame_signatures.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "engine/image/signature_codec.h"
#include "engine/video/display.h"
#include "tests/engine/video/plain_clip.h"

namespace haarmony::server {
namespace {

using video::testing::RawClip;

bool always() { return true; }

// A scene of large blocks: another number, another scene; `shift` moves it a little.
video::Picture scene(unsigned number, int shift) {
    std::mt19937 random(number);
    video::Picture picture(32, 32);
    std::vector<video::Rgba> colors(64);
    for (video::Rgba& color : colors)
        color = {static_cast<std::uint8_t>(random()),
                 static_cast<std::uint8_t>(random()),
                 static_cast<std::uint8_t>(random()),
                 255};
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            const int column = ((x + shift) % 32) / 8;
            picture.at(x, y) = colors[static_cast<std::size_t>(8 * (y / 8) + column)];
        }
    return picture;
}

TEST(Shots, ANewOneBeginsWhereADifferenceIsLargeAndUnlikeTheLastOnes) {
    EXPECT_EQ(shots_of({}), (std::vector<std::int64_t>{0}));
    EXPECT_EQ(shots_of({1, 2, 60, 1}), (std::vector<std::int64_t>{0, 0, 0, 1, 1}));
    // All of a wild shot differs.
    EXPECT_EQ(shots_of({1, 14, 15, 40, 15, 40}),
              (std::vector<std::int64_t>{0, 0, 0, 0, 1, 1, 1}));
    // A flash in the dark is large by its like and small by itself.
    EXPECT_EQ(shots_of({0, 15, 0}), (std::vector<std::int64_t>{0, 0, 0, 0}));
}

TEST(Shots, OnlyTheLastDifferencesCount) {
    std::vector<double> differences(20, 12.0);
    differences.insert(differences.end(), static_cast<std::size_t>(kShotMemory), 1.0);
    differences.push_back(20);
    EXPECT_EQ(shots_of(differences).back(), 1);
}

TEST(MeanDifference, IsOfLuminanceAndOfWhatIsSeen) {
    video::Picture a(2, 1);
    video::Picture b(2, 1);
    EXPECT_EQ(mean_difference(a, b), 0);
    a.at(0, 0) = {255, 255, 255, 255};
    EXPECT_NEAR(mean_difference(a, b), 127.5, 1e-9);
    // Clear is as dark as black.
    b.at(1, 0) = {0, 0, 0, 255};
    EXPECT_NEAR(mean_difference(a, b), 127.5, 1e-9);
}

TEST(FrameSignatures, AreThoseOfThePicturesAndOfNoStretchAcrossACut) {
    RawClip clip;
    clip.format = {32, 32, {25, 1}};
    // Two shots of three frames: the time nodes over frames 2 and 3 are in both.
    for (int i = 0; i < 3; ++i) clip.frames.push_back(scene(1, i));
    for (int i = 0; i < 3; ++i) clip.frames.push_back(scene(2, i));
    const auto tree = plain_clip(clip);
    const auto rows = frame_signatures(*tree, 0, always);
    ASSERT_TRUE(rows) << rows.error().message;
    std::set<std::pair<int, std::int64_t>> places;
    for (const schema::FrameSignature& row : *rows) {
        places.emplace(row.time_level, row.node);
        const auto frame = tree->frame({row.time_level, row.node}, 5);
        ASSERT_TRUE(frame);
        const video::Picture picture = video::draw(*frame, 5, video::Edge::kNormalize);
        EXPECT_EQ(row.signature,
                  image::encode_signature(image::make_signature(picture.view())));
        const auto frames = tree->shape().frames_of({row.time_level, row.node});
        EXPECT_EQ(row.shot, frames.first < 3 ? 0 : 1);
        EXPECT_EQ(row.shot, frames.end <= 3 ? 0 : 1);
    }
    for (std::int64_t leaf = 0; leaf < 6; ++leaf) EXPECT_TRUE(places.contains({3, leaf}));
    EXPECT_TRUE(places.contains({2, 0}));
    EXPECT_FALSE(places.contains({2, 1}));
    EXPECT_FALSE(places.contains({0, 0}));
}

// Those that a clip of fewer frames had, and those that are left out for it, are all.
TEST(FrameSignatures, OfAppendedFramesAreWhatTheOldOnesHaveNotSaid) {
    RawClip clip;
    clip.format = {32, 32, {25, 1}};
    for (int i = 0; i < 11; ++i) clip.frames.push_back(scene(i < 6 ? 1 : 2, i));
    const auto tree = plain_clip(clip);
    const auto all = frame_signatures(*tree, 0, always);
    ASSERT_TRUE(all);
    const auto place = [](const schema::FrameSignature& row) {
        return std::tuple(row.time_level, row.node, row.shot, row.signature);
    };
    std::set<decltype(place((*all)[0]))> want;
    for (const schema::FrameSignature& row : *all) want.insert(place(row));
    for (std::size_t kept = 1; kept < 11; ++kept) {
        RawClip shorter = clip;
        shorter.frames.resize(kept);
        const auto old_tree = plain_clip(shorter);
        const auto old_rows = frame_signatures(*old_tree, 0, always);
        const auto new_rows =
            frame_signatures(*tree, static_cast<std::int64_t>(kept), always);
        ASSERT_TRUE(old_rows && new_rows);
        EXPECT_LT(new_rows->size(), all->size() + (kept < 2 ? 1 : 0)) << kept;
        std::set<decltype(place((*all)[0]))> got;
        for (const schema::FrameSignature& row : *new_rows) got.insert(place(row));
        const int old_levels = old_tree->shape().time_levels();
        for (schema::FrameSignature row : *old_rows) {
            // As VideoStore::grow() keeps them.
            if (row.time_level == 0) continue;
            const std::int64_t end = (row.node / 2 + 1)
                                     << (old_levels - row.time_level + 1);
            if (end > static_cast<std::int64_t>(kept)) continue;
            row.time_level += tree->shape().time_levels() - old_levels;
            EXPECT_TRUE(got.insert(place(row)).second) << kept;
        }
        EXPECT_EQ(got, want) << kept;
    }
}

TEST(FrameSignatures, StopWhenTheyAreToldTo) {
    const auto tree = plain_clip(video::testing::random_clip(8, 8, 3, 1));
    for (int steps = 0; steps < 4; ++steps) {
        int left = steps;
        const auto rows = frame_signatures(*tree, 0, [&left] { return left-- > 0; });
        ASSERT_FALSE(rows) << steps;
        EXPECT_EQ(rows.error().code, ErrorCode::kUnavailable);
    }
}

}  // namespace
}  // namespace haarmony::server
