#include "ingest/describe.h"

#include <gtest/gtest.h>

#include "engine/image/signature_codec.h"
#include "ingest/dimensions.h"
#include "ingest/thumbnail.h"
#include "ingest/variant.h"
#include "tests/ingest/samples.h"

namespace haarmony::ingest {
namespace {

// FIPS 180-2, appendix B.
TEST(ContentHash, IsSha256InLowerCaseHex) {
    EXPECT_EQ(content_hash(text_bytes("abc")),
              "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(content_hash({}),
              "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(Describe, FillsEverythingThatThePixelsAndBytesGive) {
    const Bytes file =
        write_jpeg(sample_picture(800, 600, 3), {.exif = exif_segment(6, false)});
    const auto image = describe(shared_decoder(), file, kMainKind);
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->width, 600);
    EXPECT_EQ(image->height, 800);
    EXPECT_EQ(image->media_type, "image/jpeg");
    EXPECT_EQ(image->stamp.size, static_cast<std::int64_t>(file.size()));
    EXPECT_EQ(image->stamp.content_hash, content_hash(file));
    EXPECT_FALSE(image->low_information);
    EXPECT_EQ(image->thumbnail.media_type, "image/jpeg");
    EXPECT_EQ(jpeg_dimensions(image->thumbnail.bytes), (Dimensions{192, 256}));
    // What the caller alone knows.
    EXPECT_EQ(image->uri, "");
    EXPECT_EQ(image->stamp.mtime_ns, 0);
    EXPECT_TRUE(image->tags.empty());
}

TEST(Describe, AQueryBySameBytesHasTheSameSignature) {
    for (const SampleFile& file : sample_files()) {
        const std::string name(describe_format(file.format).name);
        const auto stored = describe(shared_decoder(), file.bytes, kMainKind);
        ASSERT_TRUE(stored) << name << ": " << stored.error().message;
        const auto query = shared_decoder().decode(file.bytes);
        ASSERT_TRUE(query) << name;
        const auto decoded = image::decode_signature(stored->signature);
        ASSERT_TRUE(decoded) << name << ": " << decoded.error().message;
        EXPECT_EQ(*decoded, image::make_signature(query->view())) << name;
        EXPECT_TRUE(stored->variants.empty()) << name;
    }
}

TEST(Describe, EveryKindInUseGetsASignature) {
    const std::vector<image::SignatureKind> kinds = {
        {},
        {image::ColorSpace::kLab, image::Decomposition::kStandard},
        {image::ColorSpace::kLab, image::Decomposition::kNonstandard}};
    const Bytes file = write_jpeg(sample_picture(90, 60, 3), {});
    const auto stored = describe(shared_decoder(), file, kinds);
    const auto picture = shared_decoder().decode(file);
    ASSERT_TRUE(stored && picture);
    ASSERT_EQ(stored->variants.size(), 2U);
    EXPECT_EQ(stored->variants[0].variant, "lab-standard");
    EXPECT_EQ(stored->variants[1].variant, "lab-nonstandard");
    for (std::size_t i = 1; i < kinds.size(); ++i) {
        EXPECT_EQ(
            stored->variants[i - 1].signature,
            image::encode_signature(image::make_signature(picture->view(), kinds[i])));
    }
    EXPECT_EQ(signature_variants(picture->view(), kinds)[0],
              (schema::SignatureVariant{kMainVariant, stored->signature}));
}

TEST(Describe, AlphaReachesTheSignature) {
    // Left half painted, right half clear over another colour: the clear part does not count.
    Raster clear(64, 64, 4);
    Raster other(64, 64, 4);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const bool painted = x < 32;
            const std::uint8_t level = static_cast<std::uint8_t>(painted ? 3 * y : 0);
            const Bytes one = {
                level, 90, 40, static_cast<std::uint8_t>(painted ? 255 : 0)};
            const Bytes two = {static_cast<std::uint8_t>(painted ? level : 255),
                               90,
                               static_cast<std::uint8_t>(painted ? 40 : 200),
                               one[3]};
            std::copy_n(one.begin(), 4, clear.row(y) + 4 * x);
            std::copy_n(two.begin(), 4, other.row(y) + 4 * x);
        }
    }
    const auto a = describe(
        shared_decoder(), write_with_oiio(clear, {.extension = "png"}), kMainKind);
    const auto b = describe(
        shared_decoder(), write_with_oiio(other, {.extension = "png"}), kMainKind);
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->signature, b->signature);
}

TEST(Describe, FlatPicturesHaveLowInformation) {
    const Bytes file =
        write_with_oiio(flat_picture(40, 40, {9, 99, 199}), {.extension = "png"});
    const auto image = describe(shared_decoder(), file, kMainKind);
    ASSERT_TRUE(image);
    EXPECT_TRUE(image->low_information);
}

TEST(Describe, WhatCannotBeDecodedIsThatError) {
    const auto image = describe(shared_decoder(), text_bytes("%PDF-1.4"), kMainKind);
    ASSERT_FALSE(image);
    EXPECT_EQ(image.error().code, ErrorCode::kUnsupportedFormat);
    const auto damaged = describe(shared_decoder(), png_header(3, 3), kMainKind);
    ASSERT_FALSE(damaged);
    EXPECT_EQ(damaged.error().code, ErrorCode::kUndecodable);
}

}  // namespace
}  // namespace haarmony::ingest
