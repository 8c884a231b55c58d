// Files that are damaged, empty, too large, or no clips at all.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "ingest/libav.h"
#include "ingest/png_chunks.h"
#include "tests/ingest/video/clips.h"
#include "tests/ingest/video/gif_file.h"

namespace haarmony::ingest {
namespace {

using namespace testing;
using ::testing::HasSubstr;

const video::FrameFormat kSmall = {32, 24, {10, 1}};

Bytes bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

Error error_of(const Result<Shown>& shown) {
    EXPECT_FALSE(shown);
    return shown ? Error{ErrorCode::kIo, "it was read"} : shown.error();
}

void expect_error(const Result<Shown>& shown, ErrorCode code, const std::string& words) {
    const Error error = error_of(shown);
    EXPECT_EQ(error.code, code) << error.message;
    EXPECT_THAT(error.message, HasSubstr(words));
}

Bytes first_bytes(const Bytes& file, std::size_t count) {
    return {file.begin(), file.begin() + static_cast<std::ptrdiff_t>(count)};
}

TEST(VideoSource, WhatIsNoClipIsNamed) {
    const auto refused = [](const Bytes& file, const std::string& words) {
        expect_error(decode_in_child(file), ErrorCode::kUnsupportedFormat, words);
    };
    refused({}, "the video is empty (0 bytes)");
    refused(bytes_of("ffconcat version 1.0\nfile /etc/passwd\n"), "text (text/plain)");
    refused(bytes_of("#EXTM3U\n#EXT-X-TARGETDURATION:1\n"), "text (text/plain)");
    refused(bytes_of("%PDF-1.4 ..."), "PDF document");
    refused(bytes_of(std::string_view("\0\0\0\x18"
                                      "ftypheic\0\0\0\0mif1heic",
                                      24)),
            "HEIF");
    refused({1, 2, 3, 250}, "01 02 03 fa");
}

TEST(VideoSource, SoundAloneIsNoVideo) {
    const Bytes file = matroska_of({.codec = AV_CODEC_ID_PCM_S16LE,
                                    .audio = true,
                                    .packets = {Bytes(1600), Bytes(1600)}});
    expect_error(decode_in_child(file),
                 ErrorCode::kUnsupportedFormat,
                 "the Matroska video holds no video stream");
}

TEST(VideoSource, ACodecThatIsNotOnTheListIsNamed) {
    const Bytes file =
        matroska_of({.codec = AV_CODEC_ID_CINEPAK, .packets = {Bytes(100)}});
    expect_error(decode_here(file), ErrorCode::kUnsupportedFormat, "coded as cinepak");
}

TEST(VideoSource, AFilmWithoutFramesIsDamaged) {
    const Bytes file = matroska_of({.codec = AV_CODEC_ID_PNG, .packets = {}});
    expect_error(decode_here(file), ErrorCode::kUndecodable, "it ends too early");
    const Bytes gif = write_gif({.width = 8, .height = 8, .frames = {}});
    expect_error(decode_here(gif), ErrorCode::kUndecodable, "no picture");
}

TEST(VideoSource, ASizeThatChangesIsDamage) {
    const auto png = [](int width, int height) {
        return png_file(video::Picture(width, height).view()).value();
    };
    const Packets packets = {.codec = AV_CODEC_ID_PNG,
                             .packets = {png(16, 16), png(16, 16), png(16, 8)}};
    expect_error(decode_here(matroska_of(packets)),
                 ErrorCode::kUndecodable,
                 "frame 2 is 16 x 8 pixels, the others are 16 x 16");
}

TEST(VideoSource, APacketThatCannotBeDecodedIsDamage) {
    const Bytes png = png_file(video::Picture(16, 16).view()).value();
    const Packets packets = {.codec = AV_CODEC_ID_PNG, .packets = {png, Bytes(50, 7)}};
    expect_error(decode_here(matroska_of(packets)),
                 ErrorCode::kUndecodable,
                 "damaged Matroska video: Invalid data found");
}

TEST(VideoSource, MorePixelsThanTheLimitAreTooMany) {
    const Clip clip = moving_clip(kSmall, 2, Alpha::kOpaque);
    VideoSourceOptions options;
    options.max_pixels = 32 * 24 - 1;
    for (const Bytes& file : {write_film(clip, Container::kApng),
                              write_film(clip, Container::kMp4),
                              animated_webp(clip, {100, 100})}) {
        expect_error(decode_in_child(file, options),
                     ErrorCode::kTooLarge,
                     "32 x 24 pixels; the limit is 767");
    }
    options.max_pixels = 32 * 24;
    EXPECT_TRUE(decode_in_child(write_film(clip, Container::kMp4), options));
}

TEST(VideoSource, MoreFramesThanTheLimitAreTooMany) {
    const Bytes file =
        write_film(moving_clip(kSmall, 3, Alpha::kOpaque), Container::kApng);
    VideoSourceOptions options;
    options.max_frames = 2;
    expect_error(
        decode_in_child(file, options), ErrorCode::kTooLarge, "more than 2 frames");
    options.max_frames = 3;
    EXPECT_TRUE(decode_in_child(file, options));
}

TEST(VideoSource, ACutAnimationIsDamaged) {
    const Clip clip = moving_clip(kSmall, 4, Alpha::kRandom);
    const Bytes apng = write_film(clip, Container::kApng);
    const Bytes webp = animated_webp(clip, {100, 100, 100, 100});
    for (const Bytes& file : {apng, webp}) {
        for (const std::size_t part : {1, 2, 3, 4, 5, 6, 7}) {
            const auto shown = decode_here(first_bytes(file, file.size() * part / 8));
            EXPECT_EQ(error_of(shown).code, ErrorCode::kUndecodable)
                << part << "/8 of " << file.size() << " bytes";
        }
    }
}

// Where a container's parts stand for themselves, what came before the cut is shown.
TEST(VideoSource, ACutFilmEndsEarlyOrIsDamaged) {
    const Clip clip = moving_clip({32, 24, {1, 1}}, 8, Alpha::kOpaque);
    for (const Container container : {Container::kMp4, Container::kWebm}) {
        const Bytes film = write_film(clip, container);
        const auto whole = decode_here(film);
        ASSERT_TRUE(whole) << whole.error().message;
        for (const std::size_t part : {1, 2, 3, 4, 5, 6, 7}) {
            const auto shown = decode_here(first_bytes(film, film.size() * part / 8));
            if (!shown) {
                EXPECT_EQ(shown.error().code, ErrorCode::kUndecodable);
                continue;
            }
            ASSERT_LT(shown->pictures.size(), 8U) << part;
            EXPECT_TRUE(std::equal(
                shown->pictures.begin(), shown->pictures.end(), whole->pictures.begin()));
        }
    }
}

TEST(VideoSource, AnyDamageIsAnErrorOrAPictureButNeverOurs) {
    const Clip clip = moving_clip(kSmall, 3, Alpha::kRandom);
    std::mt19937 random(11);
    for (const Bytes& whole : {write_film(clip, Container::kApng),
                               write_film(clip, Container::kWebm),
                               write_film(clip, Container::kMp4),
                               animated_webp(clip, {9, 9, 9})}) {
        Bytes file = whole;
        for (int change = 0; change < 12; ++change) {
            file[16 + random() % (file.size() - 16)] =
                static_cast<std::uint8_t>(random());
        }
        VideoSourceOptions options;
        options.max_pixels = 1 << 20;
        options.max_frames = 100;
        const auto shown = decode_in_child(file, options);
        if (shown) {
            EXPECT_LE(shown->pictures.size(), 100U);
            continue;
        }
        const ErrorCode code = shown.error().code;
        EXPECT_TRUE(code == ErrorCode::kUndecodable || code == ErrorCode::kTooLarge ||
                    code == ErrorCode::kUnsupportedFormat)
            << shown.error().message;
    }
}

}  // namespace
}  // namespace haarmony::ingest
