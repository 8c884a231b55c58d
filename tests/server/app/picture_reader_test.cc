#include "server/app/picture_reader.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

#include "engine/image/signature_codec.h"
#include "ingest/describe.h"
#include "tests/engine/image/pictures.h"
#include "tests/server/app/collection.h"

namespace haarmony::server {
namespace {

LookOptions look_with(Mask mask) {
    LookOptions look;
    look.mask = mask;
    return look;
}

// Opaque on the left, transparent on the right: the two masks differ.
image::Pixels half_transparent() {
    image::Pixels pixels = image::noise(64, 48, 4, 5);
    for (int y = 0; y < pixels.height; ++y)
        for (int x = 32; x < pixels.width; ++x) pixels.at(x, y, 3) = 0;
    return pixels;
}

TEST(PictureReader, BytesGiveTheSignatureOfTheirPixels) {
    PictureReader reader{ingest::DecodeLimits{}};
    const image::Pixels picture = half_transparent();
    const std::vector<std::uint8_t> png = png_of(picture.view());
    for (const Mask mask : {Mask::kAlpha, Mask::kNone}) {
        const auto found = reader.look(png, look_with(mask));
        ASSERT_TRUE(found) << found.error().message;
        const QueryPicture expected =
            look_at(picture.view(), picture.width, picture.height, look_with(mask));
        EXPECT_EQ(found->signatures, expected.signatures);
        EXPECT_EQ(found->log_aspect, expected.log_aspect);
    }
}

TEST(PictureReader, WhatIsStoredIsWhatAQueryAsks) {
    PictureReader reader{ingest::DecodeLimits{}};
    const std::vector<std::uint8_t> jpeg = jpeg_scene(4);
    const auto row = reader.describe(jpeg, ingest::kMainKind);
    const auto query = reader.look(jpeg, {});
    ASSERT_TRUE(row && query);
    EXPECT_EQ(row->signature, image::encode_signature(query->signatures.at({}).front()));
}

TEST(PictureReader, GivesTheDecodersErrors) {
    PictureReader reader{ingest::DecodeLimits{}};
    const std::string text = "not a picture at all";
    const std::vector<std::uint8_t> unknown(text.begin(), text.end());
    std::vector<std::uint8_t> truncated = png_of(image::scene(40, 30, 3).view());
    truncated.resize(truncated.size() / 2);
    for (const Mask mask : {Mask::kAlpha, Mask::kNone}) {
        const auto no_format = reader.look(unknown, look_with(mask));
        ASSERT_FALSE(no_format);
        EXPECT_EQ(no_format.error().code, ErrorCode::kUnsupportedFormat);
        const auto damaged = reader.look(truncated, look_with(mask));
        ASSERT_FALSE(damaged);
        EXPECT_EQ(damaged.error().code, ErrorCode::kUndecodable);
    }
    const auto row = reader.describe(truncated, ingest::kMainKind);
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
            const auto first = reader.look(jpeg, {});
            for (int i = 0; i < 10; ++i) {
                const auto again = reader.look(jpeg, {});
                if (!first || !again || again->signatures != first->signatures)
                    ++wrong[number];
            }
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

}  // namespace
}  // namespace haarmony::server
