#include "ingest/orientation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <utility>

#include "tests/ingest/samples.h"

namespace haarmony::ingest {
namespace {

// The table of the standard: where the stored first row and first column are seen. It is
// the oracle because OpenImageIO's reorient() exchanges 5 and 7.
enum class Side { kTop, kRight, kBottom, kLeft };
struct Seen {
    Side first_row;
    Side first_column;
};
constexpr std::array kSeen = {Seen{Side::kTop, Side::kLeft},
                              Seen{Side::kTop, Side::kRight},
                              Seen{Side::kBottom, Side::kRight},
                              Seen{Side::kBottom, Side::kLeft},
                              Seen{Side::kLeft, Side::kTop},
                              Seen{Side::kRight, Side::kTop},
                              Seen{Side::kRight, Side::kBottom},
                              Seen{Side::kLeft, Side::kBottom}};

Raster reoriented(const Raster& picture, int orientation) {
    const Seen seen = kSeen[static_cast<std::size_t>(orientation - 1)];
    const bool rows_stand =
        seen.first_row == Side::kLeft || seen.first_row == Side::kRight;
    Raster result(rows_stand ? picture.height : picture.width,
                  rows_stand ? picture.width : picture.height,
                  picture.channels);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            int seen_x = 0;
            int seen_y = 0;
            // Steps away from the side where the first row, or column, is seen.
            for (const auto& [side, steps] :
                 {std::pair(seen.first_row, y), std::pair(seen.first_column, x)}) {
                if (side == Side::kTop) seen_y = steps;
                if (side == Side::kBottom) seen_y = result.height - 1 - steps;
                if (side == Side::kLeft) seen_x = steps;
                if (side == Side::kRight) seen_x = result.width - 1 - steps;
            }
            std::copy_n(picture.row(y) + x * picture.channels,
                        picture.channels,
                        result.row(seen_y) + seen_x * picture.channels);
        }
    }
    return result;
}

class Orientation : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(All, Orientation, testing::Range(1, 9));

TEST_P(Orientation, PutsFirstRowAndColumnWhereTheStandardSaysTheyAreSeen) {
    for (const int channels : {1, 3, 4}) {
        const Raster picture = sample_picture(13, 9, channels);
        const Raster turned = upright(picture, GetParam());
        EXPECT_EQ(largest_difference(turned, reoriented(picture, GetParam())), 0);
    }
}

TEST_P(Orientation, OneRowOneColumnAndOnePixel) {
    for (const auto& [width, height] :
         {std::pair(7, 1), std::pair(1, 7), std::pair(1, 1)}) {
        const Raster picture = sample_picture(width, height, 3);
        const Raster turned = upright(picture, GetParam());
        EXPECT_EQ(largest_difference(turned, reoriented(picture, GetParam())), 0);
    }
}

TEST_P(Orientation, IsReadFromJpegPngWebpAndTiff) {
    const Raster picture = sample_picture(40, 24, 3);
    const Raster expected = reoriented(picture, GetParam());
    for (const bool big : {false, true}) {
        const std::vector<SampleFile> files = {
            {Format::kJpeg,
             write_jpeg(picture,
                        {.quality = 100,
                         .exif = exif_segment(GetParam(), big),
                         .subsampling = 1})},
            {Format::kPng,
             insert_png_chunk(write_with_oiio(picture, {.extension = "png"}),
                              "eXIf",
                              exif_tiff(GetParam(), big))},
            {Format::kWebp, write_webp_with_exif(picture, exif_tiff(GetParam(), big))},
            {Format::kWebp, write_webp_with_exif(picture, exif_segment(GetParam(), big))},
            {Format::kTiff,
             write_with_oiio(picture, {.extension = "tif", .orientation = GetParam()})},
        };
        Decoder& decoder = shared_decoder();
        for (const SampleFile& file : files) {
            const std::string name(describe_format(file.format).name);
            EXPECT_EQ(exif_orientation(file.format, file.bytes), GetParam()) << name;
            const auto decoded = decoder.decode(file.bytes);
            ASSERT_TRUE(decoded) << name << ": " << decoded.error().message;
            EXPECT_EQ(decoded->width, expected.width) << name;
            EXPECT_EQ(decoded->height, expected.height) << name;
            Raster got(decoded->pixel_width, decoded->pixel_height, decoded->channels);
            got.pixels = decoded->pixels;
            // JPEG rounds; a wrong turn is off by two hundred.
            const int tolerance = file.format == Format::kJpeg ? 12 : 0;
            EXPECT_LE(largest_difference(got, expected), tolerance) << name;
        }
    }
}

// 6 = held so that the stored top belongs to the right:  a b c      d a
//                                                        d e f  ->  e b
//                                                                   f c
TEST(OrientationByHand, SixIsAQuarterTurnClockwise) {
    Raster picture(3, 2, 1);
    picture.pixels = {'a', 'b', 'c', 'd', 'e', 'f'};
    const Raster turned = upright(picture, 6);
    EXPECT_EQ(turned.width, 2);
    EXPECT_EQ(turned.height, 3);
    EXPECT_EQ(turned.pixels, (Bytes{'d', 'a', 'e', 'b', 'f', 'c'}));
}

TEST(ExifOrientation, ValuesOutsideOneToEightAreUpright) {
    const Raster picture = sample_picture(8, 8, 3);
    for (const int value : {0, 9, 65535}) {
        const Bytes file = write_jpeg(picture, {.exif = exif_segment(value, true)});
        EXPECT_EQ(exif_orientation(Format::kJpeg, file), 1) << value;
    }
}

TEST(ExifOrientation, TheFirstOfTwoBlocksCounts) {
    const Raster picture = sample_picture(8, 8, 3);
    const Bytes png = insert_png_chunk(
        write_with_oiio(picture, {.extension = "png"}), "eXIf", exif_tiff(8, false));
    EXPECT_EQ(
        exif_orientation(Format::kPng, insert_png_chunk(png, "eXIf", exif_tiff(3, true))),
        3);
}

TEST(ExifOrientation, CutAndNoisyBlocksAreUprightOrARealValue) {
    const Raster picture = sample_picture(8, 8, 3);
    const std::vector<SampleFile> files = {
        {Format::kJpeg, write_jpeg(picture, {.exif = exif_segment(6, true)})},
        {Format::kPng,
         insert_png_chunk(write_with_oiio(picture, {.extension = "png"}),
                          "eXIf",
                          exif_tiff(6, false))},
        {Format::kWebp, write_webp_with_exif(picture, exif_tiff(6, false))},
        {Format::kTiff, write_with_oiio(picture, {.extension = "tif", .orientation = 6})},
    };
    std::mt19937 random(5);
    for (const SampleFile& file : files) {
        for (std::size_t length = 0; length < file.bytes.size(); ++length) {
            const Bytes prefix(file.bytes.begin(), file.bytes.begin() + length);
            const int found = exif_orientation(file.format, prefix);
            EXPECT_TRUE(found == 1 || found == 6) << found;
        }
        for (int round = 0; round < 500; ++round) {
            Bytes bytes = file.bytes;
            for (int i = 0; i < 4; ++i) {
                bytes[random() % std::min<std::size_t>(bytes.size(), 120)] =
                    static_cast<std::uint8_t>(random());
            }
            const int found = exif_orientation(file.format, bytes);
            EXPECT_GE(found, 1);
            EXPECT_LE(found, 8);
        }
    }
}

}  // namespace
}  // namespace haarmony::ingest
