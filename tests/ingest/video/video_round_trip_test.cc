// Films that are written and read again, here or through the child.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string>

#include "ingest/byte_reader.h"
#include "ingest/png.h"
#include "tests/ingest/video/clips.h"

namespace haarmony::ingest {
namespace {

using namespace testing;

const video::FrameFormat kSmall = {64, 48, {30'000, 1001}};

// From the end: the directory, then every entry that it lists.
std::map<std::string, Bytes> unzip(const Bytes& archive) {
    const ByteReader reader(archive, ByteOrder::kLittle);
    std::map<std::string, Bytes> entries;
    const std::uint64_t end = archive.size() - 22;
    EXPECT_TRUE(reader.has(end, "PK\x05\x06"));
    const auto count = reader.u16(end + 10).value_or(0);
    std::uint64_t at = reader.u32(end + 16).value_or(0);
    EXPECT_EQ(at + reader.u32(end + 12).value_or(0), end);
    for (std::uint64_t i = 0; i < count; ++i) {
        EXPECT_TRUE(reader.has(at, "PK\x01\x02"));
        const auto size = reader.u32(at + 24).value_or(0);
        const auto name_length = reader.u16(at + 28).value_or(0);
        const auto name = reader.slice(at + 46, name_length);
        const auto local = reader.u32(at + 42).value_or(0);
        EXPECT_TRUE(reader.has(local, "PK\x03\x04"));
        EXPECT_EQ(reader.u32(local + 14), reader.u32(at + 16)) << "checksums";
        const auto content = reader.slice(local + 30 + name_length, size);
        entries[{name.begin(), name.end()}] = {content.begin(), content.end()};
        at += 46 + name_length;
    }
    EXPECT_EQ(at, end);
    return entries;
}

TEST(Apng, ComesBackAsItWasWithAlpha) {
    const Clip clip = moving_clip(kSmall, 8, Alpha::kRandom);
    const auto shown = decode_in_child(write_film(clip, Container::kApng));
    ASSERT_TRUE(shown) << shown.error().message;
    EXPECT_EQ(shown->format, clip.format);
    EXPECT_EQ(shown->pictures, clip.pictures);
    ASSERT_EQ(shown->times_us.size(), 8U);
    EXPECT_EQ(shown->times_us[0], 0);
    EXPECT_NEAR(static_cast<double>(shown->times_us[6]), 6e6 * 1001 / 30'000, 100);
}

TEST(Apng, WritesOnlyWhatChanges) {
    Clip clip = flat_clip(kSmall, 3, {9, 99, 199, 255});
    clip.pictures[1].at(13, 40) = {1, 2, 3, 4};
    clip.pictures[2] = clip.pictures[1];
    const Bytes film = write_film(clip, Container::kApng);
    const auto shown = decode_here(film);
    ASSERT_TRUE(shown) << shown.error().message;
    EXPECT_EQ(shown->pictures, clip.pictures);
    const Bytes still = write_film({clip.format, {clip.pictures[0]}}, Container::kApng);
    EXPECT_LT(film.size(), still.size() + 300) << "two parts of one pixel each";
}

TEST(Apng, OfOnePixelAndOneFrameIsRead) {
    const Clip clip = flat_clip({1, 1, {7, 3}}, 1, {1, 2, 3, 128});
    const auto shown = decode_here(write_film(clip, Container::kApng));
    ASSERT_TRUE(shown) << shown.error().message;
    EXPECT_EQ(shown->pictures, clip.pictures);
    EXPECT_EQ(shown->format, clip.format);
}

TEST(PngZip, HoldsEveryPictureExactly) {
    const Clip clip = moving_clip(kSmall, 3, Alpha::kRandom);
    const auto entries = unzip(write_film(clip, Container::kPngZip));
    ASSERT_EQ(entries.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::string name = "00000" + std::to_string(i) + ".png";
        ASSERT_TRUE(entries.contains(name));
        const auto raster = decode_png(entries.at(name));
        ASSERT_TRUE(raster) << raster.error().message;
        ASSERT_EQ(raster->channels, 4);
        const auto* pixels = reinterpret_cast<const video::Rgba*>(raster->pixels.data());
        EXPECT_TRUE(std::equal(
            clip.pictures[i].pixels.begin(), clip.pictures[i].pixels.end(), pixels));
    }
}

TEST(Mp4, ComesBackCloseToWhatItWas) {
    const Clip clip = moving_clip(kSmall, 8, Alpha::kOpaque);
    const auto shown = decode_in_child(write_film(clip, Container::kMp4));
    ASSERT_TRUE(shown) << shown.error().message;
    EXPECT_EQ(shown->format, clip.format);
    EXPECT_GT(psnr(shown->pictures, clip.pictures), 34);
    EXPECT_NEAR(static_cast<double>(shown->times_us[7]), 7e6 * 1001 / 30'000, 100);
}

TEST(Mp4, ShowsTheBackgroundBelowAlpha) {
    const Clip clip = moving_clip(kSmall, 3, Alpha::kDisc);
    VideoSinkOptions options;
    options.container = Container::kMp4;
    options.format = clip.format;
    options.frames = 3;
    options.background = {200, 180, 160, 255};
    const auto shown = decode_here(write_film(clip, options));
    ASSERT_TRUE(shown) << shown.error().message;
    std::vector<video::Picture> expected;
    for (const video::Picture& picture : clip.pictures) {
        expected.push_back(over(picture, options.background));
    }
    EXPECT_GT(psnr(shown->pictures, expected), 32);
}

TEST(Mp4, OddSidesGrowByARepetitionOfTheLast) {
    const Clip clip = moving_clip({33, 21, {25, 1}}, 2, Alpha::kOpaque);
    const auto shown = decode_here(write_film(clip, Container::kMp4));
    ASSERT_TRUE(shown) << shown.error().message;
    EXPECT_EQ(shown->format, (video::FrameFormat{34, 22, {25, 1}}));
    std::vector<video::Picture> expected;
    for (const video::Picture& picture : clip.pictures) {
        video::Picture padded(34, 22);
        for (int y = 0; y < 22; ++y) {
            for (int x = 0; x < 34; ++x) {
                padded.at(x, y) = picture.at(std::min(x, 32), std::min(y, 20));
            }
        }
        expected.push_back(padded);
    }
    EXPECT_GT(psnr(shown->pictures, expected), 32);
}

TEST(Mp4, KeepsFlatColoursToWithinTwoLevels) {
    Clip clip = flat_clip({32, 32, {25, 1}}, 1, {220, 30, 40, 255});
    for (const video::Rgba color :
         {video::Rgba{20, 200, 60, 255}, video::Rgba{30, 60, 230, 255}}) {
        clip.pictures.push_back(flat_clip(clip.format, 1, color).pictures[0]);
    }
    const auto shown = decode_here(write_film(clip, Container::kMp4));
    ASSERT_TRUE(shown) << shown.error().message;
    ASSERT_EQ(shown->pictures.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_LE(largest_difference(shown->pictures[i], clip.pictures[i]), 2) << i;
    }
}

TEST(Webm, KeepsAlpha) {
    const Clip clip = moving_clip(kSmall, 8, Alpha::kDisc);
    const auto shown = decode_in_child(write_film(clip, Container::kWebm));
    ASSERT_TRUE(shown) << shown.error().message;
    ASSERT_EQ(shown->pictures.size(), 8U);
    EXPECT_EQ(shown->format.width, 64);
    EXPECT_EQ(shown->format.height, 48);
    EXPECT_NEAR(shown->format.rate.per_second(), 30'000 / 1001.0, 0.01);
    std::vector<video::Picture> ours;
    std::vector<video::Picture> theirs;
    double alpha_error = 0;
    for (std::size_t i = 0; i < 8; ++i) {
        for (std::size_t p = 0; p < clip.pictures[i].pixels.size(); ++p) {
            alpha_error +=
                std::abs(shown->pictures[i].pixels[p].a - clip.pictures[i].pixels[p].a);
        }
        ours.push_back(over(clip.pictures[i], {0, 0, 0, 255}));
        theirs.push_back(over(shown->pictures[i], {0, 0, 0, 255}));
    }
    EXPECT_LT(alpha_error / (8 * 64 * 48), 3) << "levels, in the mean";
    EXPECT_GT(psnr(ours, theirs), 30);
}

TEST(Webm, OddSidesStay) {
    const Clip clip = moving_clip({33, 21, {25, 1}}, 2, Alpha::kOpaque);
    const auto shown = decode_here(write_film(clip, Container::kWebm));
    ASSERT_TRUE(shown) << shown.error().message;
    EXPECT_EQ(shown->format, clip.format);
    EXPECT_GT(psnr(shown->pictures, clip.pictures), 30);
}

TEST(Films, AreTheSameBytesEachTimeAndSoAreTheirPictures) {
    const Clip clip = moving_clip(kSmall, 4, Alpha::kDisc);
    for (const ContainerDescription& entry : containers()) {
        const Bytes film = write_film(clip, entry.container);
        EXPECT_EQ(film, write_film(clip, entry.container)) << entry.name;
        if (entry.container == Container::kPngZip) continue;
        const auto first = decode_here(film);
        const auto second = decode_here(film);
        ASSERT_TRUE(first && second) << entry.name;
        EXPECT_EQ(first->pictures, second->pictures) << entry.name;
    }
}

}  // namespace
}  // namespace haarmony::ingest
