#include "ingest/dimensions.h"

#include <gtest/gtest.h>

#include <random>
#include <string_view>

#include "ingest/tiff_directory.h"
#include "tests/ingest/samples.h"

namespace haarmony::ingest {
namespace {

using std::string_view_literals::operator""sv;

// HEVC is coded in blocks of 64: the header says the coded size, which is what must fit.
Dimensions header_size(Format format) {
    return format == Format::kHeif ? Dimensions{64, 64} : Dimensions{64, 48};
}

TEST(Dimensions, AgreeWithTheWriterInEveryFormat) {
    for (const SampleFile& file : sample_files()) {
        const auto found = read_dimensions(file.format, file.bytes);
        ASSERT_TRUE(found) << found.error().message;
        EXPECT_EQ(*found, header_size(file.format)) << describe_format(file.format).name;
    }
}

// Every prefix either has the whole answer or none: never another one, never a read beyond.
TEST(Dimensions, APrefixGivesTheSameAnswerOrUndecodable) {
    for (const SampleFile& file : sample_files()) {
        for (std::size_t length = 0; length < file.bytes.size(); ++length) {
            const Bytes prefix(file.bytes.begin(), file.bytes.begin() + length);
            const auto found = read_dimensions(file.format, prefix);
            if (found) {
                EXPECT_EQ(*found, header_size(file.format))
                    << describe_format(file.format).name;
            } else {
                EXPECT_EQ(found.error().code, ErrorCode::kUndecodable);
                EXPECT_NE(found.error().message.find(std::to_string(length) + " bytes"),
                          std::string::npos);
            }
        }
    }
}

TEST(Dimensions, NoiseNeverCrashesAndNeverGivesNonsense) {
    std::mt19937 random(11);
    for (const SampleFile& file : sample_files()) {
        for (int round = 0; round < 300; ++round) {
            Bytes bytes = file.bytes;
            for (int i = 0; i < 8; ++i) {
                bytes[random() % std::min<std::size_t>(bytes.size(), 200)] =
                    static_cast<std::uint8_t>(random());
            }
            const auto found = read_dimensions(file.format, bytes);
            if (!found) continue;
            EXPECT_GE(found->width, 1);
            EXPECT_GE(found->height, 1);
            EXPECT_LE(found->width, 0x7fffffff);
            EXPECT_LE(found->height, 0x7fffffff);
        }
    }
}

TEST(Dimensions, WebpInAllThreeContainers) {
    const Raster picture = sample_picture(31, 17, 4);
    EXPECT_EQ(webp_dimensions(write_webp(picture)), (Dimensions{31, 17}));
    EXPECT_EQ(webp_dimensions(write_webp_with_exif(picture, exif_tiff(1, true))),
              (Dimensions{31, 17}));
    const Bytes lossy = text_bytes(
        "RIFF\x20\0\0\0WEBPVP8 \x14\0\0\0\x30\x01\0\x9d\x01\x2a\x1f\x40\x11\x00\0\0"sv);
    // The upper two bits are a scale, not a size.
    EXPECT_EQ(webp_dimensions(lossy), (Dimensions{31, 17}));
}

TEST(Dimensions, BmpOfEveryHeaderAndDirection) {
    const Bytes core =
        text_bytes("BM\0\0\0\0\0\0\0\0\x1a\0\0\0\x0c\0\0\0\x05\0\x07\0\1\0\x18\0"sv);
    EXPECT_EQ(*read_dimensions(Format::kBmp, core), (Dimensions{5, 7}));
    const Bytes top_down = text_bytes(
        "BM\0\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x05\0\0\0\xf9\xff\xff\xff\1\0\x18\0"sv);
    EXPECT_EQ(*read_dimensions(Format::kBmp, top_down), (Dimensions{5, 7}));
}

TEST(Dimensions, TiffInBothByteOrdersAndSizes) {
    for (const bool big : {false, true}) {
        Bytes classic = text_bytes(big ? "MM" : "II");
        append(classic, 42, 2, big);
        append(classic, 8, 4, big);
        append(classic, 2, 2, big);
        append(classic, 256, 2, big);
        append(classic, 3, 2, big);  // SHORT
        append(classic, 1, 4, big);
        append(classic, 640, 2, big);
        append(classic, 0, 2, big);
        append(classic, 257, 2, big);
        append(classic, 4, 2, big);  // LONG
        append(classic, 1, 4, big);
        append(classic, 480, 4, big);
        EXPECT_EQ(*read_dimensions(Format::kTiff, classic), (Dimensions{640, 480}));

        Bytes large = text_bytes(big ? "MM" : "II");
        append(large, 43, 2, big);
        append(large, 8, 2, big);
        append(large, 0, 2, big);
        append(large, 16, 8, big);
        append(large, 2, 8, big);
        append(large, 256, 2, big);
        append(large, 16, 2, big);  // LONG8
        append(large, 1, 8, big);
        append(large, 640, 8, big);
        append(large, 257, 2, big);
        append(large, 3, 2, big);
        append(large, 1, 8, big);
        append(large, 480, 2, big);
        append(large, 0, 6, big);
        EXPECT_EQ(*read_dimensions(Format::kTiff, large), (Dimensions{640, 480}));
    }
}

// A value that does not fit its entry stands elsewhere; an offset there may point anywhere.
TEST(TiffDirectory, ValuesElsewhereAreFollowedAndChecked) {
    for (const std::uint64_t offset : {26u, 27u, 0xfffffffeu}) {
        Bytes tiff = text_bytes("II");
        append(tiff, 42, 2, false);
        append(tiff, 8, 4, false);
        append(tiff, 1, 2, false);
        append(tiff, 256, 2, false);
        append(tiff, 4, 2, false);
        append(tiff, 2, 4, false);  // two LONGs
        append(tiff, offset, 4, false);
        append(tiff, 0, 4, false);
        append(tiff, 77, 4, false);
        const auto value = first_directory_value(tiff, TiffTag::kImageWidth);
        if (offset == 26) {
            EXPECT_EQ(value, 77u);
        } else {
            EXPECT_FALSE(value) << offset;
        }
    }
}

TEST(Dimensions, ZeroIsUndecodableAndNamed) {
    const auto zero = read_dimensions(Format::kPng, png_header(0, 12));
    ASSERT_FALSE(zero);
    EXPECT_EQ(zero.error().code, ErrorCode::kUndecodable);
    EXPECT_NE(zero.error().message.find("0 x 12"), std::string::npos);
}

TEST(Dimensions, SidesBeyondThirtyOneBitsAreDamage) {
    const auto huge = read_dimensions(Format::kPng, png_header(0x80000000u, 1));
    ASSERT_FALSE(huge);
    EXPECT_EQ(huge.error().code, ErrorCode::kUndecodable);
}

TEST(Dimensions, TheLimitIsInclusiveAndNamed) {
    EXPECT_TRUE(check_pixels({100, 100}, 10'000));
    const auto refused = check_pixels({0x7fffffff, 0x7fffffff}, 10'000);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kTooLarge);
    EXPECT_NE(refused.error().message.find("4611686014132420609"), std::string::npos);
    EXPECT_NE(refused.error().message.find("2147483647 x 2147483647"), std::string::npos);
    EXPECT_NE(refused.error().message.find("10000"), std::string::npos);
    EXPECT_FALSE(check_pixels({10'001, 1}, 10'000));
}

TEST(Dimensions, OpenExrWindowsMayLieAnywhereButNotInsideOut) {
    const auto window = [](int left, int top, int right, int bottom) {
        Bytes exr = text_bytes("\x76\x2f\x31\x01\x02\0\0\0"sv);
        const Bytes name = text_bytes("dataWindow\0box2i\0"sv);
        exr.insert(exr.end(), name.begin(), name.end());
        append(exr, 16, 4, false);
        for (const int corner : {left, top, right, bottom}) {
            append(exr, static_cast<std::uint32_t>(corner), 4, false);
        }
        return exr;
    };
    EXPECT_EQ(openexr_dimensions(window(-5, -7, 4, 12)), (Dimensions{10, 20}));
    EXPECT_FALSE(openexr_dimensions(window(5, 0, 4, 9)));
    EXPECT_FALSE(openexr_dimensions(window(-0x7fffffff, 0, 0x7fffffff, 9)));
}

}  // namespace
}  // namespace haarmony::ingest
