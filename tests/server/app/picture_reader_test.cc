#include "server/app/picture_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "engine/image/signature_codec.h"
#include "tests/engine/image/pictures.h"
#include "tests/server/app/collection.h"

namespace haarmony::server {
namespace {

// A scene whose left half is opaque; the rest fades out.
image::Pixels half_transparent() {
    image::Pixels pixels = image::noise(64, 48, 4, 5);
    for (int y = 0; y < pixels.height; ++y)
        for (int x = 0; x < pixels.width; ++x)
            pixels.at(x, y, 3) = static_cast<std::uint8_t>(x < 32 ? 255 : 255 - 4 * x);
    return pixels;
}

// By the definition of compositing over black, in floating point.
image::Pixels over_black(const image::Pixels& picture) {
    image::Pixels opaque = image::flat(picture.width, picture.height, {0, 0, 0});
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            for (int channel = 0; channel < 3; ++channel)
                opaque.at(x, y, channel) = static_cast<std::uint8_t>(std::floor(
                    picture.at(x, y, channel) * (picture.at(x, y, 3) / 255.0) + 0.5));
    return opaque;
}

TEST(PictureReader, MaskNoneCountsTransparencyAsBlack) {
    const image::Pixels picture = half_transparent();
    EXPECT_EQ(signature_of_pixels(picture.view(), Mask::kNone),
              image::make_signature(over_black(picture).view()));
}

TEST(PictureReader, MaskAlphaIsTheRuleOfIngest) {
    const image::Pixels picture = half_transparent();
    EXPECT_EQ(signature_of_pixels(picture.view(), Mask::kAlpha),
              image::make_signature(picture.view()));
    EXPECT_NE(signature_of_pixels(picture.view(), Mask::kAlpha),
              signature_of_pixels(picture.view(), Mask::kNone));
}

TEST(PictureReader, MaskMakesNoDifferenceToAnOpaquePicture) {
    const image::Pixels picture = image::scene(40, 30, 3);
    EXPECT_EQ(signature_of_pixels(picture.view(), Mask::kAlpha),
              signature_of_pixels(picture.view(), Mask::kNone));
}

TEST(PictureReader, BytesGiveTheSignatureOfTheirPixels) {
    PictureReader reader{ingest::DecodeLimits{}};
    const image::Pixels picture = half_transparent();
    const std::vector<std::uint8_t> png = png_of(picture.view());
    for (const Mask mask : {Mask::kAlpha, Mask::kNone}) {
        const auto signature = reader.signature(png, mask);
        ASSERT_TRUE(signature) << signature.error().message;
        EXPECT_EQ(signature.value(), signature_of_pixels(picture.view(), mask));
    }
}

TEST(PictureReader, WhatIsStoredIsWhatAQueryAsks) {
    PictureReader reader{ingest::DecodeLimits{}};
    const std::vector<std::uint8_t> jpeg = jpeg_scene(4);
    const auto row = reader.describe(jpeg);
    const auto query = reader.signature(jpeg, Mask::kAlpha);
    ASSERT_TRUE(row && query);
    EXPECT_EQ(row->signature, image::encode_signature(query.value()));
}

TEST(PictureReader, GivesTheDecodersErrors) {
    PictureReader reader{ingest::DecodeLimits{}};
    const std::string text = "not a picture at all";
    const std::vector<std::uint8_t> unknown(text.begin(), text.end());
    std::vector<std::uint8_t> truncated = png_of(image::scene(40, 30, 3).view());
    truncated.resize(truncated.size() / 2);
    for (const Mask mask : {Mask::kAlpha, Mask::kNone}) {
        const auto no_format = reader.signature(unknown, mask);
        ASSERT_FALSE(no_format);
        EXPECT_EQ(no_format.error().code, ErrorCode::kUnsupportedFormat);
        const auto damaged = reader.signature(truncated, mask);
        ASSERT_FALSE(damaged);
        EXPECT_EQ(damaged.error().code, ErrorCode::kUndecodable);
    }
    const auto row = reader.describe(truncated);
    ASSERT_FALSE(row);
    EXPECT_EQ(row.error().code, ErrorCode::kUndecodable);
}

TEST(PictureReader, DecodesOnManyThreadsAtOnce) {
    PictureReader reader{ingest::DecodeLimits{}};
    std::vector<std::thread> threads;
    std::vector<int> wrong(4, 0);
    for (unsigned number = 0; number < wrong.size(); ++number)
        threads.emplace_back([&, number] {
            const std::vector<std::uint8_t> jpeg = jpeg_scene(number);
            const auto first = reader.signature(jpeg, Mask::kAlpha);
            for (int i = 0; i < 10; ++i) {
                const auto again = reader.signature(jpeg, Mask::kAlpha);
                if (!first || !again || again.value() != first.value()) ++wrong[number];
            }
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

}  // namespace
}  // namespace haarmony::server
