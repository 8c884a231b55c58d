#include "ingest/png.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>

#include "tests/ingest/samples.h"

namespace haarmony::ingest {
namespace {

// A PNG from its parts: chunk by chunk, with IHDR in front and IEND behind.
class PngBuilder {
  public:
    PngBuilder(int width, int height, int bits, int color_type) {
        file_ = png_header(static_cast<std::uint32_t>(width),
                           static_cast<std::uint32_t>(height));
        file_[24] = static_cast<std::uint8_t>(bits);
        file_[25] = static_cast<std::uint8_t>(color_type);
        const uLong sum = crc32(0, &file_[12], 17);
        for (int i = 0; i < 4; ++i) {
            file_[29 + static_cast<std::size_t>(i)] =
                static_cast<std::uint8_t>(sum >> (24 - 8 * i));
        }
    }
    PngBuilder& chunk(std::string_view type, const Bytes& content) {
        // Only the chunk itself: what stands before it is a header of 33 bytes.
        const Bytes whole = insert_png_chunk(png_header(1, 1), type, content);
        file_.insert(file_.end(), whole.begin() + 33, whole.end());
        return *this;
    }
    // Rows with their filter bytes.
    PngBuilder& rows(const Bytes& filtered) {
        Bytes packed(compressBound(filtered.size()));
        uLongf size = packed.size();
        EXPECT_EQ(compress(packed.data(), &size, filtered.data(), filtered.size()), Z_OK);
        packed.resize(size);
        return chunk("IDAT", packed).chunk("IEND", {});
    }
    [[nodiscard]] const Bytes& file() const { return file_; }

  private:
    Bytes file_;
};

constexpr int kGrey = 0;
constexpr int kRgb = 2;
constexpr int kPalette = 3;

Raster decoded(const Bytes& file) {
    auto raster = decode_png(file);
    EXPECT_TRUE(raster) << raster.error().message;
    return raster ? std::move(raster).value() : Raster();
}

TEST(Png, PaletteIsExpandedWithAndWithoutTransparency) {
    PngBuilder opaque(2, 1, 8, kPalette);
    opaque.chunk("PLTE", {10, 20, 30, 200, 100, 50}).rows({0, 1, 0});
    EXPECT_EQ(decoded(opaque.file()).pixels, (Bytes{200, 100, 50, 10, 20, 30}));

    PngBuilder clear(2, 1, 8, kPalette);
    clear.chunk("PLTE", {10, 20, 30, 200, 100, 50})
        .chunk("tRNS", {255, 128})
        .rows({0, 0, 1});
    EXPECT_EQ(decoded(clear.file()).pixels, (Bytes{10, 20, 30, 255, 200, 100, 50, 128}));
}

TEST(Png, OneBitIsBlackAndWhite) {
    PngBuilder png(8, 1, 1, kGrey);
    png.rows({0, 0b1010'0001});
    EXPECT_EQ(decoded(png.file()).pixels, (Bytes{255, 0, 255, 0, 0, 0, 0, 255}));
}

TEST(Png, TheTransparentColourOfAGreyPictureIsAlpha) {
    PngBuilder png(3, 1, 8, kGrey);
    png.chunk("tRNS", {0, 77}).rows({0, 76, 77, 78});
    const Raster got = decoded(png.file());
    ASSERT_EQ(got.channels, 4);
    EXPECT_EQ(got.pixels[3], 255);
    EXPECT_EQ(got.pixels[7], 0);
    EXPECT_EQ(got.pixels[11], 255);
    EXPECT_EQ(got.pixels[0], 76);
}

TEST(Png, SixteenBitsWithoutGammaAreSrgb) {
    PngBuilder png(3, 1, 16, kGrey);
    png.rows({0, 0, 0, 128, 128, 255, 255});
    EXPECT_EQ(decoded(png.file()).pixels, (Bytes{0, 128, 255}));
}

TEST(Png, GammaIsUndone) {
    struct Case {
        std::uint64_t gamma;  // in 1/100000, of the encoding
    };
    for (const Case& c : {Case{100'000}, Case{55'556}, Case{45'455}}) {
        Bytes gamma;
        append(gamma, c.gamma, 4, true);
        Bytes row = {0};
        for (int level = 0; level < 256; level += 5) {
            row.push_back(static_cast<std::uint8_t>(level));
        }
        PngBuilder png(52, 1, 8, kGrey);
        png.chunk("gAMA", gamma).rows(row);
        const Raster got = decoded(png.file());
        for (std::size_t i = 0; i < 52; ++i) {
            const double level = static_cast<double>(row[i + 1]) / 255;
            // Encoding by 1/2.2, as libpng takes it for sRGB: 45455 changes nothing.
            const double light =
                std::pow(level, 100'000.0 / static_cast<double>(c.gamma));
            const double expected = 255 * std::pow(light, 1 / 2.2);
            // libpng uses the true sRGB curve for the way back, which leaves the power
            // curve by at most a dozen levels, all of them in the darks.
            EXPECT_NEAR(got.pixels[i], expected, level > 0.1 ? 4 : 14)
                << c.gamma << ": " << int{row[i + 1]};
        }
    }
}

TEST(Png, MoreThanEnoughOrTooFewRows) {
    PngBuilder few(1, 3, 8, kGrey);
    few.rows({0, 1, 0, 2});
    const auto cut = decode_png(few.file());
    ASSERT_FALSE(cut);
    EXPECT_EQ(cut.error().code, ErrorCode::kUndecodable);
    EXPECT_NE(cut.error().message.find("damaged PNG: "), std::string::npos);
    EXPECT_GT(cut.error().message.size(), std::string("damaged PNG: ").size());
}

TEST(Png, CorruptHeadersAreNamedByLibpng) {
    PngBuilder bits(1, 1, 7, kRgb);
    bits.rows({0, 0, 0, 0});
    const auto refused = decode_png(bits.file());
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("IHDR"), std::string::npos)
        << refused.error().message;
}

TEST(Png, SaysNothingOnStandardError) {
    const Bytes file = write_with_oiio(sample_picture(40, 30, 3), {.extension = "png"});
    testing::internal::CaptureStderr();
    for (std::size_t length = 8; length < file.size(); length += 11) {
        const auto cut = decode_png(Bytes(file.begin(), file.begin() + length));
        static_cast<void>(cut.has_value());
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace haarmony::ingest
