// The whole chain from bytes to upright pixels, for every format and for what is none.
#include "ingest/decode.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string_view>

#include "tests/ingest/samples.h"

namespace haarmony::ingest {
namespace {

using std::string_view_literals::operator""sv;

Raster decoded(const Bytes& file) {
    const auto picture = shared_decoder().decode(file);
    EXPECT_TRUE(picture) << picture.error().message;
    return picture ? raster_of(*picture) : Raster();
}

Error failure(Decoder& decoder, const Bytes& file) {
    const auto picture = decoder.decode(file);
    EXPECT_FALSE(picture);
    return picture ? Error{ErrorCode::kIo, "decoded"} : picture.error();
}

std::uint8_t encode_srgb(double linear) {
    const double encoded =
        linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

TEST(Decode, EveryFormatGivesThePictureThatWasWritten) {
    const Raster expected = sample_picture(64, 48, 3);
    Decoder& decoder = shared_decoder();
    for (const SampleFile& file : sample_files()) {
        const std::string name(describe_format(file.format).name);
        const auto picture = decoder.decode(file.bytes);
        ASSERT_TRUE(picture) << name << ": " << picture.error().message;
        EXPECT_EQ(picture->media_type, describe_format(file.format).media_type);
        EXPECT_EQ(picture->width, 64) << name;
        EXPECT_EQ(picture->height, 48) << name;
        const Raster got = raster_of(*picture);
        switch (file.format) {
            case Format::kPng:
            case Format::kWebp:
            case Format::kTiff:
            case Format::kBmp:
                EXPECT_EQ(largest_difference(got, expected), 0) << name;
                break;
            case Format::kOpenExr: {
                // The writer took the bytes as light: what comes back is brighter.
                Raster brighter = expected;
                for (std::uint8_t& sample : brighter.pixels) {
                    sample = encode_srgb(sample / 255.0);
                }
                EXPECT_LE(largest_difference(got, brighter), 1) << name;
                break;
            }
            case Format::kGif: {
                // 256 colours, and always four channels.
                ASSERT_EQ(got.channels, 4);
                Raster opaque(64, 48, 3);
                for (std::size_t i = 0; i < 64 * 48; ++i) {
                    EXPECT_EQ(got.pixels[4 * i + 3], 255);
                    std::copy_n(&got.pixels[4 * i], 3, &opaque.pixels[3 * i]);
                }
                EXPECT_LE(mean_difference(opaque, expected), 8) << name;
                break;
            }
            case Format::kJpeg:
            case Format::kHeif:
            case Format::kAvif:
            case Format::kJpeg2000:
                EXPECT_LE(mean_difference(got, expected), 5) << name;
                break;
        }
    }
}

TEST(Decode, GreyStaysOneChannel) {
    const Raster grey = sample_picture(40, 30, 1);
    EXPECT_EQ(
        largest_difference(decoded(write_with_oiio(grey, {.extension = "png"})), grey),
        0);
    EXPECT_EQ(
        largest_difference(decoded(write_with_oiio(grey, {.extension = "tif"})), grey),
        0);
    EXPECT_LE(mean_difference(decoded(write_jpeg(grey, {.quality = 100})), grey), 1);
}

TEST(Decode, SixteenBitsAreRoundedToEight) {
    const Raster picture = sample_picture(40, 30, 3);
    for (const char* extension : {"png", "tif"}) {
        const Bytes file =
            write_with_oiio(picture, {.extension = extension, .type = "uint16"});
        EXPECT_EQ(largest_difference(decoded(file), picture), 0) << extension;
    }
}

TEST(Decode, AlphaIsStraightWhateverTheFileHolds) {
    const Raster picture = sample_picture(40, 30, 4);
    for (const char* extension : {"png", "tif", "bmp"}) {
        const Bytes file = write_with_oiio(picture, {.extension = extension});
        EXPECT_EQ(largest_difference(decoded(file), picture), 0) << extension;
    }
    EXPECT_EQ(largest_difference(decoded(write_webp(picture)), picture), 0);

    Raster premultiplied = picture;
    for (std::size_t i = 0; i < premultiplied.pixels.size(); i += 4) {
        for (std::size_t c = 0; c < 3; ++c) {
            premultiplied.pixels[i + c] = static_cast<std::uint8_t>(
                (picture.pixels[i + c] * picture.pixels[i + 3] + 127) / 255);
        }
    }
    const Bytes associated =
        write_with_oiio(premultiplied, {.extension = "tif", .straight_alpha = false});
    // Rounding at alpha 64 costs up to half of 255 / 64 steps.
    EXPECT_LE(largest_difference(decoded(associated), picture), 3);
}

TEST(Decode, HeifAndAvifAlphaIsStraight) {
    const Raster picture = sample_picture(64, 48, 4);
    for (const auto& [extension, compression] :
         {std::pair("heic", "heic:100"), std::pair("avif", "avif:100")}) {
        OiioFile file{.extension = extension};
        file.compression = compression;
        const Raster got = decoded(write_with_oiio(picture, file));
        ASSERT_EQ(got.channels, 4) << extension;
        EXPECT_LE(mean_difference(got, picture), 5) << extension;
    }
}

TEST(Decode, Jpeg2000AlphaIsStraight) {
    const Raster picture = sample_picture(64, 48, 4);
    const Raster got = decoded(write_with_oiio(picture, {.extension = "jp2"}));
    ASSERT_EQ(got.channels, 4);
    EXPECT_LE(mean_difference(got, picture), 5);
}

TEST(Decode, GreyWithAlphaBecomesColourWithAlpha) {
    Raster pair(5, 4, 2);
    for (std::size_t i = 0; i < pair.pixels.size(); ++i) {
        pair.pixels[i] = static_cast<std::uint8_t>(40 + 5 * i);
    }
    Raster expected(5, 4, 4);
    for (std::size_t i = 0; i < 20; ++i) {
        for (std::size_t c = 0; c < 3; ++c)
            expected.pixels[4 * i + c] = pair.pixels[2 * i];
        expected.pixels[4 * i + 3] = pair.pixels[2 * i + 1];
    }
    EXPECT_EQ(largest_difference(decoded(write_with_oiio(pair, {.extension = "png"})),
                                 expected),
              0);
}

TEST(Decode, FullyTransparentKeepsItsAlphaAndBmpWithoutAnyIsOpaque) {
    const Raster clear = flat_picture(6, 5, {80, 90, 100, 0});
    const Raster png = decoded(write_with_oiio(clear, {.extension = "png"}));
    ASSERT_EQ(png.channels, 4);
    for (std::size_t i = 3; i < png.pixels.size(); i += 4) EXPECT_EQ(png.pixels[i], 0);
    const Raster bmp = decoded(write_with_oiio(clear, {.extension = "bmp"}));
    EXPECT_EQ(largest_difference(bmp, flat_picture(6, 5, {80, 90, 100})), 0);
}

TEST(Decode, LinearLightGetsTheCurve) {
    std::vector<float> light;
    Raster expected(32, 2, 3);
    for (int i = 0; i < 64 * 3; ++i) {
        // Beyond 1 is clamped.
        light.push_back(static_cast<float>(i) / 160.0f);
        expected.pixels[static_cast<std::size_t>(i)] =
            encode_srgb(std::min(1.0, i / 160.0));
    }
    for (const char* extension : {"exr", "tif"}) {
        const Bytes file = write_floats_with_oiio(
            light, 32, 2, 3, {.extension = extension, .type = "float"});
        EXPECT_LE(largest_difference(decoded(file), expected), 1) << extension;
    }
    const Bytes tiled = write_floats_with_oiio(
        light, 32, 2, 3, {.extension = "exr", .type = "float", .tile_side = 16});
    EXPECT_LE(largest_difference(decoded(tiled), expected), 1);
}

TEST(Decode, PremultipliedLightIsDividedBeforeTheCurve) {
    const std::vector<float> light = {0.25f, 0.1f, 0.0f, 0.5f, 0.0f, 0.0f, 0.0f, 0.0f};
    const Bytes file =
        write_floats_with_oiio(light, 2, 1, 4, {.extension = "exr", .type = "float"});
    const Raster got = decoded(file);
    ASSERT_EQ(got.channels, 4);
    EXPECT_NEAR(got.pixels[0], encode_srgb(0.5), 1);
    EXPECT_NEAR(got.pixels[1], encode_srgb(0.2), 1);
    EXPECT_EQ(got.pixels[2], 0);
    EXPECT_EQ(got.pixels[3], 128);
    EXPECT_EQ(got.pixels[7], 0);
}

TEST(Decode, TiledTiffIsReadWhole) {
    const Raster picture = sample_picture(150, 110, 3);
    const Bytes file = write_with_oiio(picture, {.extension = "tif", .tile_side = 64});
    EXPECT_EQ(largest_difference(decoded(file), picture), 0);
}

TEST(Decode, MoreRowsThanAreConvertedAtATime) {
    const Raster picture = sample_picture(50, 300, 3);
    EXPECT_EQ(largest_difference(decoded(write_with_oiio(picture, {.extension = "png"})),
                                 picture),
              0);
}

TEST(Decode, AnimationsGiveTheirFirstFrame) {
    const Raster light = flat_picture(16, 12, {240, 240, 240});
    const Raster gif = decoded(write_with_oiio(light, {.extension = "gif", .frames = 3}));
    ASSERT_EQ(gif.channels, 4);
    EXPECT_NEAR(gif.pixels[0], 240, 8);

    const Raster frame = flat_picture(8, 6, {10, 200, 90, 255});
    const Raster later = flat_picture(8, 6, {0, 0, 0, 255});
    const Raster webp = decoded(write_animated_webp({frame, later}, 16, 12));
    Raster expected = flat_picture(16, 12, {0, 0, 0, 0});
    for (int y = 2; y < 8; ++y) {
        std::copy_n(frame.row(0), frame.row_bytes(), expected.row(y) + 2 * 4);
    }
    EXPECT_EQ(largest_difference(webp, expected), 0);
}

TEST(Decode, ExtremeShapesAreRead) {
    for (const auto& [width, height] :
         {std::pair(1, 1), std::pair(1, 10'000), std::pair(10'000, 1)}) {
        const Raster picture = sample_picture(width, height, 3);
        for (const char* extension : {"png", "tif", "bmp"}) {
            EXPECT_EQ(
                largest_difference(
                    decoded(write_with_oiio(picture, {.extension = extension})), picture),
                0)
                << extension << " " << width << " x " << height;
        }
        EXPECT_EQ(largest_difference(decoded(write_webp(picture)), picture), 0);
        EXPECT_LE(
            mean_difference(decoded(write_jpeg(picture, {.quality = 100})), picture), 5);
    }
}

TEST(Decode, LargeJpegsComeBackSmallerButNameTheirSize) {
    const Bytes file =
        write_jpeg(sample_picture(1200, 900, 3), {.exif = exif_segment(6, true)});
    Decoder decoder({.min_side = 200});
    const auto picture = decoder.decode(file);
    ASSERT_TRUE(picture) << picture.error().message;
    EXPECT_EQ(picture->width, 900);
    EXPECT_EQ(picture->height, 1200);
    EXPECT_EQ(picture->pixel_width, 225);
    EXPECT_EQ(picture->pixel_height, 300);
}

TEST(Decode, BombsAreRefusedByTheirHeader) {
    struct Bomb {
        const char* name;
        Bytes bytes;
        const char* pixels;
    };
    Bytes jpeg = write_jpeg(sample_picture(16, 16, 1), {});
    for (std::size_t i = 0; i + 1 < jpeg.size(); ++i) {
        if (jpeg[i] == 0xff && jpeg[i + 1] == 0xc0) {
            jpeg[i + 5] = jpeg[i + 7] = 65500 >> 8;
            jpeg[i + 6] = jpeg[i + 8] = 65500 & 255;
            break;
        }
    }
    const Bytes gif = text_bytes(
        "GIF89a\xff\xff\xff\xff\x00\x00\x00,\0\0\0\0\xff\xff\xff\xff\x00\x02\x02\x4c\x01\x00;"sv);
    for (const Bomb& bomb : {Bomb{"PNG", png_header(100'000, 100'000), "10000000000"},
                             Bomb{"JPEG", jpeg, "4290250000"},
                             Bomb{"GIF", gif, "4294836225"}}) {
        const Error error = failure(shared_decoder(), bomb.bytes);
        EXPECT_EQ(error.code, ErrorCode::kTooLarge) << bomb.name;
        EXPECT_NE(error.message.find(bomb.pixels), std::string::npos) << error.message;
        EXPECT_NE(error.message.find("100000000"), std::string::npos) << error.message;
    }
    // Let through by a careless limit, they still cost an error and nothing more.
    DecodeLimits careless;
    careless.max_pixels = std::int64_t{1} << 40;
    Decoder careless_decoder(careless);
    EXPECT_EQ(failure(careless_decoder, gif).code, ErrorCode::kUndecodable);
}

TEST(Decode, WhatIsNoPictureIsNamed) {
    const Error pdf = failure(shared_decoder(), text_bytes("%PDF-1.4\n..."));
    EXPECT_EQ(pdf.code, ErrorCode::kUnsupportedFormat);
    EXPECT_NE(pdf.message.find("application/pdf"), std::string::npos);
    const Error html =
        failure(shared_decoder(), text_bytes("<!doctype html><title>404</title>"));
    EXPECT_EQ(html.code, ErrorCode::kUnsupportedFormat);
    EXPECT_NE(html.message.find("text/html"), std::string::npos);
    const Error empty = failure(shared_decoder(), {});
    EXPECT_EQ(empty.code, ErrorCode::kUnsupportedFormat);
    EXPECT_NE(empty.message.find("0 bytes"), std::string::npos);
    const Error noise = failure(shared_decoder(), {0x01, 0x02, 0xfe});
    EXPECT_EQ(noise.code, ErrorCode::kUnsupportedFormat);
    EXPECT_NE(noise.message.find("01 02 fe"), std::string::npos);
}

TEST(Decode, MagicAloneIsUndecodable) {
    for (const std::string_view magic : {"\xff\xd8\xff\xe0"sv,
                                         "\x89PNG\r\n\x1a\n"sv,
                                         "GIF89a"sv,
                                         "RIFF\0\0\0\0WEBP"sv,
                                         "II*\0"sv,
                                         "\x76\x2f\x31\x01"sv,
                                         "\0\0\0\x0c"
                                         "ftypheic"sv}) {
        EXPECT_EQ(failure(shared_decoder(), text_bytes(magic)).code,
                  ErrorCode::kUndecodable)
            << magic;
    }
}

// Half a file may still be a picture for no format that we read.
TEST(Decode, HalfAFileIsAnError) {
    Decoder& decoder = shared_decoder();
    for (const SampleFile& file : sample_files()) {
        const Bytes half(file.bytes.begin(), file.bytes.begin() + file.bytes.size() / 2);
        const auto picture = decoder.decode(half);
        const std::string name(describe_format(file.format).name);
        ASSERT_FALSE(picture) << name;
        EXPECT_EQ(picture.error().code, ErrorCode::kUndecodable) << name;
        EXPECT_FALSE(picture.error().message.empty());
    }
}

TEST(Decode, DamagedFilesAreDecodedOrRefusedButHarmNothing) {
    Decoder& decoder = shared_decoder();
    std::mt19937 random(3);
    const auto check = [&](const SampleFile& file, const Bytes& bytes) {
        const auto picture = decoder.decode(bytes);
        const std::string name(describe_format(file.format).name);
        if (picture) {
            EXPECT_EQ(picture->pixels.size(),
                      static_cast<std::size_t>(picture->pixel_width) *
                          picture->pixel_height * picture->channels)
                << name;
            return;
        }
        EXPECT_TRUE(picture.error().code == ErrorCode::kUndecodable ||
                    picture.error().code == ErrorCode::kTooLarge ||
                    picture.error().code == ErrorCode::kUnsupportedFormat)
            << name << ": " << picture.error().message;
        EXPECT_FALSE(picture.error().message.empty()) << name;
        EXPECT_EQ(picture.error().message.find('\n'), std::string::npos) << name;
    };
    for (const SampleFile& file : sample_files()) {
        for (int round = 0; round < 20; ++round) {
            const std::size_t length = random() % file.bytes.size();
            check(file, Bytes(file.bytes.begin(), file.bytes.begin() + length));
        }
        for (int round = 0; round < 30; ++round) {
            Bytes bytes = file.bytes;
            for (int i = 0; i < 3; ++i) {
                bytes[random() % bytes.size()] ^=
                    static_cast<std::uint8_t>(1u << random() % 8);
            }
            check(file, bytes);
        }
        // The same decoder still works.
        EXPECT_TRUE(decoder.decode(file.bytes)) << describe_format(file.format).name;
    }
}

}  // namespace
}  // namespace haarmony::ingest
