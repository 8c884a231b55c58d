// Both sides of libav: what is encoded without loss comes back, and any frame alone is the
// frame that comes when all are decoded.
#include "tests/eval/video_encoder.h"

#include <gtest/gtest.h>

#include "tests/eval/test/video_frames.h"
#include "tests/eval/video_decoder.h"

namespace haarmony::eval {
namespace {

using video::Picture;

std::vector<Picture> decoded(const EncodedFilm& film,
                             std::int64_t first,
                             std::int64_t count,
                             std::int32_t width,
                             std::int32_t height) {
    auto decoder = FilmDecoder::open(film, width, height);
    EXPECT_TRUE(decoder.has_value());
    std::vector<Picture> frames;
    const auto read = (*decoder)->frames(
        first, count, [&](const Picture& frame) { frames.push_back(frame); });
    EXPECT_TRUE(read.has_value()) << (read ? "" : read.error().message);
    return frames;
}

TEST(VideoEncoder, LosslessFilmsComeBack) {
    const VideoClip clip = noisy_clip(48, 34, 5);
    for (const VideoEncoding encoding :
         {VideoEncoding::kFfv1, VideoEncoding::kLossless}) {
        const auto film = encode_film(clip.frames, encoding);
        ASSERT_TRUE(film.has_value()) << film.error().message;
        EXPECT_EQ(film->packets.size(), clip.frames.size());
        const std::vector<Picture> frames = decoded(*film, 0, 5, 48, 34);
        ASSERT_EQ(frames.size(), 5U);
        for (std::size_t i = 0; i < frames.size(); ++i) {
            EXPECT_EQ(largest_step(frames[i], clip.frames[i]), 0) << i;
        }
    }
}

TEST(VideoEncoder, Ffv1KeepsAlpha) {
    const VideoClip clip = noisy_clip(17, 9, 2, false);
    const auto film = encode_film(clip.frames, VideoEncoding::kFfv1);
    ASSERT_TRUE(film.has_value()) << film.error().message;
    EXPECT_EQ(decoded(*film, 0, 2, 17, 9), clip.frames);
}

TEST(VideoEncoder, OnlyIntraFilmsAreAllKeyFrames) {
    const VideoClip clip = noisy_clip(64, 48, 12);
    const auto keys_of = [&](VideoEncoding encoding) {
        const auto film = encode_film(clip.frames, encoding);
        EXPECT_TRUE(film.has_value());
        std::size_t keys = 0;
        for (const FilmPacket& packet : film->packets) keys += packet.key ? 1 : 0;
        EXPECT_EQ(film->packets.size(), clip.frames.size());
        EXPECT_TRUE(film->packets.front().key);
        return keys;
    };
    EXPECT_EQ(keys_of(VideoEncoding::kIntra), 12U);
    EXPECT_EQ(keys_of(VideoEncoding::kInter), 1U);
}

TEST(VideoEncoder, BytesAreThoseOfTheHeaderAndAllPackets) {
    EncodedFilm film;
    film.header = {1, 2, 3};
    film.packets = {{{1, 2}, 0, true}, {{}, 1, false}, {{1, 2, 3, 4}, 2, false}};
    EXPECT_EQ(film.bytes(), 9U);
}

TEST(VideoEncoder, OddSidesAreEncodedWithAllTheirColours) {
    const VideoClip clip = noisy_clip(33, 21, 2);
    const auto film = encode_film(clip.frames, VideoEncoding::kIntra);
    ASSERT_TRUE(film.has_value()) << film.error().message;
    EXPECT_EQ(decoded(*film, 1, 1, 33, 21).size(), 1U);
}

TEST(VideoEncoder, WhatTheEncoderRefusesIsNamed) {
    const std::vector<Picture> wide(1, Picture(20'000, 2));
    const auto film = encode_film(wide, VideoEncoding::kIntra);
    ASSERT_FALSE(film.has_value());
    EXPECT_EQ(film.error().code, ErrorCode::kInvalidArgument);
    EXPECT_NE(film.error().message.find("libx264 of 20000 x 2"), std::string::npos)
        << film.error().message;
}

TEST(VideoDecoder, AnyFrameAloneIsTheOneOfTheWholeFilm) {
    const VideoClip clip = noisy_clip(64, 48, 14);
    for (const VideoEncoding encoding :
         {VideoEncoding::kFfv1, VideoEncoding::kIntra, VideoEncoding::kInter}) {
        const auto film = encode_film(clip.frames, encoding);
        ASSERT_TRUE(film.has_value());
        const std::vector<Picture> all = decoded(*film, 0, 14, 16, 12);
        ASSERT_EQ(all.size(), 14U);
        auto decoder = FilmDecoder::open(*film, 16, 12);
        ASSERT_TRUE(decoder.has_value());
        for (const std::int64_t i : {13, 0, 7, 7, 1, 12}) {
            int seen = 0;
            const auto read = (*decoder)->frames(i, 1, [&](const Picture& frame) {
                ++seen;
                EXPECT_EQ(frame, all[static_cast<std::size_t>(i)]) << i;
            });
            EXPECT_TRUE(read.has_value()) << i;
            EXPECT_EQ(seen, 1) << i;
        }
    }
}

TEST(VideoDecoder, ScaledFramesAreMeans) {
    VideoClip clip = noisy_clip(64, 32, 1);
    const auto film = encode_film(clip.frames, VideoEncoding::kFfv1);
    ASSERT_TRUE(film.has_value());
    const Picture half = decoded(*film, 0, 1, 32, 16).at(0);
    Picture expected(32, 16);
    for (std::int32_t y = 0; y < 16; ++y) {
        for (std::int32_t x = 0; x < 32; ++x) {
            video::PixelSum sum;
            for (int q = 0; q < 4; ++q) {
                sum += video::sum_of(clip.frames[0].at(2 * x + q % 2, 2 * y + q / 2), 1);
            }
            expected.at(x, y) = video::mean(sum, 4);
        }
    }
    // swscale rounds in its own way.
    EXPECT_LE(largest_step(half, expected), 1);
}

TEST(VideoDecoder, DamagedAndMissingFramesAreErrors) {
    const VideoClip clip = noisy_clip(32, 32, 4);
    const auto film = encode_film(clip.frames, VideoEncoding::kFfv1);
    ASSERT_TRUE(film.has_value());
    const auto fails = [](const EncodedFilm& wrong) {
        auto decoder = FilmDecoder::open(wrong, 32, 32);
        if (!decoder) return decoder.error().code;
        const auto read = (*decoder)->frames(3, 1, [](const Picture&) {});
        return read ? ErrorCode::kIo : read.error().code;
    };
    EncodedFilm without = *film;
    without.packets.pop_back();
    EXPECT_EQ(fails(without), ErrorCode::kUndecodable);
    EncodedFilm cut = *film;
    cut.packets.back().bytes.resize(3);
    EXPECT_EQ(fails(cut), ErrorCode::kUndecodable);
    EncodedFilm headless = *film;
    headless.header.assign(8, 0xFF);
    EXPECT_EQ(fails(headless), ErrorCode::kUndecodable);
}

}  // namespace
}  // namespace haarmony::eval
