#include "ingest/media_fragment.h"

#include <gtest/gtest.h>

#include "ingest/file_uri.h"

namespace haarmony::ingest {
namespace {

TEST(MediaFragment, TellsTheSecondsWithThreeDecimals) {
    EXPECT_EQ(key_frame_uri("file:///a.mp4", 0), "file:///a.mp4#t=0.000");
    EXPECT_EQ(key_frame_uri("file:///a.mp4", 12'480'000), "file:///a.mp4#t=12.480");
    EXPECT_EQ(key_frame_uri("file:///a.mp4", 4'170'833), "file:///a.mp4#t=4.171");
    EXPECT_EQ(key_frame_uri("file:///a.mp4", 999'499), "file:///a.mp4#t=0.999");
    EXPECT_EQ(key_frame_uri("file:///a.mp4", 999'500), "file:///a.mp4#t=1.000");
    EXPECT_EQ(key_frame_uri("file:///a.mp4", 7'200'005'000), "file:///a.mp4#t=7200.005");
}

TEST(MediaFragment, ANameWithTheSignsOfAFragmentIsNone) {
    const std::string film = file_uri("/films/#t=1.mp4");
    EXPECT_FALSE(is_key_frame_uri(film));
    EXPECT_TRUE(is_key_frame_uri(key_frame_uri(film, 0)));
    EXPECT_EQ(without_fragment(key_frame_uri(film, 5'000)), film);
    EXPECT_EQ(without_fragment(film), film);
}

TEST(MediaFragment, OnlyTheFramesOfAFilmBeginLikeIts) {
    const std::string prefix = key_frame_prefix("file:///a.mp4");
    EXPECT_TRUE(key_frame_uri("file:///a.mp4", 1'000).starts_with(prefix));
    EXPECT_FALSE(key_frame_uri("file:///a.mp4.mp4", 1'000).starts_with(prefix));
    EXPECT_FALSE(std::string("file:///a.mp4").starts_with(prefix));
}

TEST(MediaFragment, AFramesPathIsItsFilms) {
    const auto path = path_from_file_uri(key_frame_uri(file_uri("/a #1.mp4"), 2'000));
    ASSERT_TRUE(path);
    EXPECT_EQ(*path, "/a #1.mp4");
}

}  // namespace
}  // namespace haarmony::ingest
