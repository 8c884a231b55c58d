#include "ingest/film_pixels.h"

#include <gtest/gtest.h>

#include "ingest/display_matrix.h"
#include "ingest/video_format.h"
#include "tests/ingest/video/clips.h"

namespace haarmony::ingest {
namespace {

using namespace testing;

TEST(FilmPixels, LieOverTheBackgroundRoundedOnce) {
    const video::Rgba background = {10, 200, 77, 255};
    for (int alpha = 0; alpha < 256; ++alpha) {
        video::Picture picture(16, 16);
        for (int i = 0; i < 256; ++i) {
            const auto value = static_cast<std::uint8_t>(i);
            picture.at(i % 16, i / 16) = {
                value, value, value, static_cast<std::uint8_t>(alpha)};
        }
        const video::Picture expected = over(picture, background);
        lay_over(picture, background);
        ASSERT_EQ(picture, expected) << alpha;
    }
}

TEST(FilmPixels, BleedTwoStepsIntoWhatIsClearAndStayClear) {
    video::Picture picture(9, 9);
    picture.at(4, 4) = {100, 50, 25, 255};
    const video::Picture before = picture;
    bleed_into_clear(picture);
    for (int y = 0; y < 9; ++y) {
        for (int x = 0; x < 9; ++x) {
            EXPECT_EQ(picture.at(x, y).a, before.at(x, y).a);
            const bool near = std::max(std::abs(x - 4), std::abs(y - 4)) <= 2;
            EXPECT_EQ(picture.at(x, y).r, near ? 100 : 0) << x << ", " << y;
        }
    }
}

TEST(FilmPixels, BetweenTwoColoursTheirMeanBleeds) {
    video::Picture picture(3, 1);
    picture.at(0, 0) = {100, 0, 0, 255};
    picture.at(2, 0) = {0, 51, 0, 1};
    bleed_into_clear(picture);
    EXPECT_EQ(picture.at(1, 0), (video::Rgba{50, 26, 0, 0}));
    EXPECT_EQ(picture.at(0, 0), (video::Rgba{100, 0, 0, 255}));
}

TEST(FilmPixels, OpaqueAndClearPicturesStayAsTheyAre) {
    for (const video::Rgba color : {video::kClear, video::Rgba{1, 2, 3, 255}}) {
        const Clip clip = flat_clip({5, 4, {1, 1}}, 1, color);
        video::Picture picture = clip.pictures[0];
        bleed_into_clear(picture);
        EXPECT_EQ(picture, clip.pictures[0]);
    }
}

TEST(DisplayMatrix, OtherTurnsThanQuartersAreNone) {
    constexpr std::int32_t kHalf = 1 << 15;
    EXPECT_EQ(turn_of({kHalf, kHalf, 0, -kHalf, kHalf, 0, 0, 0, 1 << 30}), Turn{});
    EXPECT_EQ(turn_of({0, 0, 0, 0, 0, 0, 0, 0, 0}), Turn{});
    EXPECT_EQ(turn_of({0, kHalf, 0, 0, kHalf, 0, 0, 0, 0}), Turn{});
    EXPECT_EQ(turn_of({0, INT32_MIN, 0, INT32_MAX, 0, 0, 0, 0, 0}), (Turn{0, -1, 1, 0}));
}

TEST(VideoFormat, IsSniffedFromTheFirstBytes) {
    const auto sniffed = [](std::string_view bytes) {
        return sniff_video(
            {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    };
    using namespace std::string_view_literals;
    EXPECT_EQ(sniffed("\0\0\0\x18"
                      "ftypisom\0\0\0\0isommp41"sv),
              VideoFormat::kMp4);
    EXPECT_EQ(sniffed("\0\0\0\x14"
                      "ftypqt  \0\0\0\0qt  "sv),
              VideoFormat::kMp4);
    EXPECT_EQ(sniffed("\0\0\0\x08"
                      "wide"sv),
              VideoFormat::kMp4);
    EXPECT_EQ(sniffed("\0\0\0\x18"
                      "ftypavif\0\0\0\0avifmif1"sv),
              std::nullopt);
    EXPECT_EQ(sniffed("\0\0\0\x18"
                      "ftypcrx \0\0\0\0crx isom"sv),
              std::nullopt);
    EXPECT_EQ(sniffed("RIFF\1\2\3\4AVI LIST"sv), VideoFormat::kAvi);
    EXPECT_EQ(sniffed("RIFF\1\2\3\4WEBPVP8X"sv), VideoFormat::kWebp);
    EXPECT_EQ(sniffed("RIFF\1\2\3\4WAVEfmt "sv), std::nullopt);
    EXPECT_EQ(sniffed("\0\0\1\xba\x44"sv), VideoFormat::kMpegProgram);
    EXPECT_EQ(sniffed("\0\0\1\xb3\x14"sv), VideoFormat::kMpegVideo);
    EXPECT_EQ(sniffed("FLV\1\5"sv), VideoFormat::kFlash);
    EXPECT_EQ(sniffed("OggS\0"sv), VideoFormat::kOgg);
    std::string packets(400, 'x');
    packets[0] = packets[188] = 'G';
    EXPECT_EQ(sniffed(packets), std::nullopt);
    packets[376] = 'G';
    EXPECT_EQ(sniffed(packets), VideoFormat::kMpegTransport);
    EXPECT_EQ(sniffed(""sv), std::nullopt);
}

TEST(VideoFormat, EachHasAName) {
    for (std::uint32_t i = 0; i < kVideoFormats; ++i) {
        EXPECT_FALSE(name_of(static_cast<VideoFormat>(i)).empty());
    }
}

}  // namespace
}  // namespace haarmony::ingest
