#include "ingest/jpeg.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/ingest/samples.h"

namespace haarmony::ingest {
namespace {

constexpr int kFull = 1 << 20;  // a min_side that forbids scaling

// Mean of each block of `factor` x `factor` pixels, the last ones cut off at the border.
Raster block_means(const Raster& picture, int factor) {
    Raster small((picture.width + factor - 1) / factor,
                 (picture.height + factor - 1) / factor,
                 picture.channels);
    for (int y = 0; y < small.height; ++y) {
        for (int x = 0; x < small.width; ++x) {
            for (int c = 0; c < small.channels; ++c) {
                double sum = 0;
                int count = 0;
                for (int v = y * factor; v < std::min(picture.height, (y + 1) * factor);
                     ++v) {
                    for (int u = x * factor;
                         u < std::min(picture.width, (x + 1) * factor);
                         ++u) {
                        sum += picture.row(v)[u * picture.channels + c];
                        ++count;
                    }
                }
                small.row(y)[x * small.channels + c] =
                    static_cast<std::uint8_t>(std::lround(sum / count));
            }
        }
    }
    return small;
}

TEST(Jpeg, FullSizeComesBackAsWritten) {
    for (const int channels : {1, 3}) {
        for (const bool progressive : {false, true}) {
            const Raster picture = sample_picture(61, 43, channels);
            const Bytes file = write_jpeg(
                picture, {.quality = 100, .progressive = progressive, .subsampling = 1});
            const auto decoded = decode_jpeg(file, kFull);
            ASSERT_TRUE(decoded) << decoded.error().message;
            // The patch's edge rings; elsewhere it is rounding.
            EXPECT_LE(mean_difference(*decoded, picture), 1.0);
            EXPECT_LE(largest_difference(*decoded, picture), 12);
        }
    }
}

TEST(Jpeg, ScaledDecodingIsTheAverageOfFullDecoding) {
    const Raster picture = sample_picture(512, 384, 3);
    const Bytes file = write_jpeg(picture, {.subsampling = 1});
    const auto full = decode_jpeg(file, kFull);
    ASSERT_TRUE(full);
    for (const int factor : {2, 4, 8}) {
        const auto scaled = decode_jpeg(file, 384 / factor);
        ASSERT_TRUE(scaled);
        ASSERT_EQ(scaled->width, 512 / factor);
        const Raster means = block_means(*full, factor);
        // The two differ by what clamping and rounding took before the average.
        EXPECT_LE(mean_difference(*scaled, means), 1.0) << factor;
        EXPECT_LE(largest_difference(*scaled, means), 24) << factor;
    }
}

TEST(Jpeg, BothSidesStayAtMinSideOrMore) {
    const Bytes file = write_jpeg(sample_picture(403, 201, 1), {});
    struct Case {
        int min_side, width, height;
    };
    // 201 / 2 rounds up to 101, 201 / 4 to 51, 201 / 8 to 26.
    for (const Case& c : {Case{202, 403, 201},
                          Case{102, 403, 201},
                          Case{101, 202, 101},
                          Case{52, 202, 101},
                          Case{51, 101, 51},
                          Case{26, 51, 26},
                          Case{1, 51, 26}}) {
        const auto decoded = decode_jpeg(file, c.min_side);
        ASSERT_TRUE(decoded);
        EXPECT_EQ(decoded->width, c.width) << c.min_side;
        EXPECT_EQ(decoded->height, c.height) << c.min_side;
    }
}

TEST(Jpeg, InksBecomeLightWithAndWithoutAdobesInversion) {
    // Cyan, magenta, yellow, black; the light that 255 - ink lets through, twice.
    const Bytes inks = {51, 102, 153, 64};
    for (const bool adobe : {false, true}) {
        for (const bool ycck : {false, true}) {
            if (ycck && !adobe)
                continue;  // no such files: the transform is in the marker
            const Bytes file = write_jpeg(
                flat_picture(24, 24, inks),
                {.quality = 100, .cmyk = true, .adobe_marker = adobe, .ycck = ycck});
            const auto decoded = decode_jpeg(file, kFull);
            ASSERT_TRUE(decoded) << decoded.error().message;
            ASSERT_EQ(decoded->channels, 3);
            for (int c = 0; c < 3; ++c) {
                const double light =
                    (255.0 - inks[static_cast<std::size_t>(c)]) * (255 - inks[3]) / 255;
                EXPECT_NEAR(decoded->row(12)[12 * 3 + c], light, 3)
                    << "adobe " << adobe << " ycck " << ycck << " channel " << c;
            }
        }
    }
}

TEST(Jpeg, EveryTruncationIsAnErrorWithLibjpegsWords) {
    for (const bool progressive : {false, true}) {
        const Bytes file =
            write_jpeg(sample_picture(64, 48, 3), {.progressive = progressive});
        for (std::size_t length = 2; length < file.size(); length += 7) {
            const Bytes cut(file.begin(), file.begin() + length);
            const auto decoded = decode_jpeg(cut, kFull);
            ASSERT_FALSE(decoded) << length << " of " << file.size();
            EXPECT_EQ(decoded.error().code, ErrorCode::kUndecodable);
            EXPECT_GT(decoded.error().message.size(),
                      std::string("damaged JPEG: ").size());
        }
    }
    const Bytes file = write_jpeg(sample_picture(64, 48, 3), {});
    const auto half =
        decode_jpeg(Bytes(file.begin(), file.begin() + file.size() / 2), kFull);
    ASSERT_FALSE(half);
    EXPECT_EQ(half.error().message, "damaged JPEG: Premature end of JPEG file");
}

TEST(Jpeg, OverwrittenScanIsDamage) {
    Bytes file = write_jpeg(sample_picture(256, 256, 3), {});
    // A restart marker that nobody announced, in the middle of the scan.
    file[file.size() / 2] = 0xff;
    file[file.size() / 2 + 1] = 0xd3;
    const auto decoded = decode_jpeg(file, kFull);
    ASSERT_FALSE(decoded);
    EXPECT_EQ(decoded.error().code, ErrorCode::kUndecodable);
}

TEST(Jpeg, AFewBytesOfPaddingBeforeTheEndAreNoDamage) {
    const Raster picture = sample_picture(64, 48, 3);
    const Bytes file = write_jpeg(picture, {});
    const auto padded = [&](std::size_t count) {
        Bytes bytes = file;
        bytes.insert(bytes.end() - 2, count, 0x00);
        return bytes;
    };
    const auto clean = decode_jpeg(file, kFull);
    const auto few = decode_jpeg(padded(8), kFull);
    ASSERT_TRUE(few) << few.error().message;
    EXPECT_EQ(largest_difference(*few, *clean), 0);
    const auto many = decode_jpeg(padded(500), kFull);
    ASSERT_FALSE(many);
    EXPECT_NE(many.error().message.find("extraneous bytes"), std::string::npos);
}

TEST(Jpeg, ScansAreLimited) {
    const Raster picture = sample_picture(16, 16, 3);
    EXPECT_TRUE(decode_jpeg(write_jpeg(picture, {.scans = kMaxJpegScans}), kFull));
    const auto bomb =
        decode_jpeg(write_jpeg(picture, {.scans = kMaxJpegScans + 2}), kFull);
    ASSERT_FALSE(bomb);
    EXPECT_EQ(bomb.error().code, ErrorCode::kUndecodable);
    EXPECT_NE(bomb.error().message.find("more than 100 scans"), std::string::npos);
}

}  // namespace
}  // namespace haarmony::ingest
