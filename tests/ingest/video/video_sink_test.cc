// What a film is refused for, and how it ends early.
#include "ingest/video_sink.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "ingest/byte_reader.h"
#include "ingest/zip_writer.h"
#include "tests/ingest/video/clips.h"

namespace haarmony::ingest {
namespace {

using namespace testing;
using ::testing::HasSubstr;

const video::FrameFormat kSmall = {32, 24, {10, 1}};

VideoSinkOptions options_for(Container container, std::int64_t frames) {
    VideoSinkOptions options;
    options.container = container;
    options.format = kSmall;
    options.frames = frames;
    return options;
}

Result<void> ignore(std::span<const std::uint8_t>) { return {}; }

std::unique_ptr<VideoSink> open(const VideoSinkOptions& options) {
    auto sink = open_video_sink(options, ignore);
    EXPECT_TRUE(sink) << sink.error().message;
    return std::move(sink).value();
}

void expect_error(const Result<void>& result, ErrorCode code, const std::string& words) {
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, code) << result.error().message;
    EXPECT_THAT(result.error().message, HasSubstr(words));
}

TEST(Containers, AreFoundByTheirNames) {
    for (const ContainerDescription& entry : containers()) {
        EXPECT_EQ(container_named(entry.name), entry.container);
        EXPECT_EQ(describe_container(entry.container).media_type, entry.media_type);
    }
    EXPECT_EQ(container_named("png-zip"), Container::kPngZip);
    EXPECT_EQ(container_named("avi"), std::nullopt);
    EXPECT_EQ(container_named(""), std::nullopt);
}

TEST(VideoSink, HoldsTheFilmToWhatWasAnnounced) {
    const video::Picture picture(32, 24);
    const auto few = open(options_for(Container::kPngZip, 2));
    EXPECT_TRUE(few->add(picture.view()));
    expect_error(few->finish(),
                 ErrorCode::kInvalidArgument,
                 "1 pictures of 2 that were announced");
    const auto many = open(options_for(Container::kApng, 1));
    EXPECT_TRUE(many->add(picture.view()));
    expect_error(many->add(picture.view()),
                 ErrorCode::kInvalidArgument,
                 "more than the 1 pictures");
    const auto other = open(options_for(Container::kApng, 1));
    expect_error(other->add(video::Picture(32, 23).view()),
                 ErrorCode::kInvalidArgument,
                 "32 x 23 pixels in a film of 32 x 24");
}

TEST(VideoSink, WhatAContainerCannotHoldIsRefusedAtOnce) {
    const auto error = [](const VideoSinkOptions& options) {
        const auto sink = open_video_sink(options, ignore);
        EXPECT_FALSE(sink);
        return sink ? Error{} : sink.error();
    };
    const Error zip = error(options_for(Container::kPngZip, 65'536));
    EXPECT_EQ(zip.code, ErrorCode::kTooLarge);
    EXPECT_THAT(zip.message, HasSubstr("65535 pictures, not 65536"));
    const Error apng = error(options_for(Container::kApng, 0x4000'0000));
    EXPECT_EQ(apng.code, ErrorCode::kTooLarge);
    EXPECT_THAT(apng.message, HasSubstr("not 1073741824"));
    VideoSinkOptions wide = options_for(Container::kMp4, 1);
    wide.format.width = 20'000;
    const Error mp4 = error(wide);
    EXPECT_EQ(mp4.code, ErrorCode::kInvalidArgument);
    EXPECT_THAT(mp4.message, HasSubstr("H.264 of 20000 x 24 pixels"));
    VideoSinkOptions still = options_for(Container::kApng, 1);
    still.format.rate = {0, 1};
    EXPECT_EQ(error(still).param, "rate");
}

// The output fails at its n-th part, for all n that there are.
TEST(VideoSink, EndsWithTheErrorOfItsOutput) {
    const Clip clip = moving_clip(kSmall, 2, Alpha::kOpaque);
    for (const ContainerDescription& entry : containers()) {
        bool whole = false;
        for (int good = 0; !whole; ++good) {
            ASSERT_LT(good, 20) << entry.name;
            int parts = 0;
            const auto film = [&]() -> Result<void> {
                auto sink = open_video_sink(
                    options_for(entry.container, 2),
                    [&](std::span<const std::uint8_t> part) {
                        EXPECT_FALSE(part.empty());
                        if (parts++ < good) return Result<void>();
                        return Result<void>(Error{ErrorCode::kForbidden, "cancelled"});
                    });
                if (!sink) return sink.error();
                for (const video::Picture& picture : clip.pictures) {
                    auto added = (*sink)->add(picture.view());
                    if (!added) return added;
                }
                return (*sink)->finish();
            }();
            whole = film.has_value();
            if (whole) {
                EXPECT_EQ(parts, good) << entry.name;
            } else {
                EXPECT_EQ(film.error().message, "cancelled");
                EXPECT_EQ(parts, good + 1) << "nothing is written after an error";
            }
        }
    }
}

TEST(VideoSink, FilmsLeaveWhileTheyAreMade) {
    const Clip clip = moving_clip(kSmall, 60, Alpha::kOpaque);
    for (const Container container : {Container::kMp4, Container::kApng}) {
        std::size_t bytes = 0;
        auto sink = open_video_sink(options_for(container, 60),
                                    [&bytes](std::span<const std::uint8_t> part) {
                                        bytes += part.size();
                                        return Result<void>();
                                    });
        ASSERT_TRUE(sink) << sink.error().message;
        const std::size_t header = bytes;
        for (const video::Picture& picture : clip.pictures) {
            ASSERT_TRUE((*sink)->add(picture.view()));
        }
        EXPECT_GT(bytes, header + 500) << describe_container(container).name;
        ASSERT_TRUE((*sink)->finish());
    }
}

TEST(ZipWriter, RefusesWhat32BitsCannotCount) {
    const Bytes content(100, 1);
    ZipWriter almost(kMaxZipBytes - 250);
    EXPECT_TRUE(almost.entry("a", content));
    const auto more = almost.entry("b", content);
    ASSERT_FALSE(more);
    EXPECT_EQ(more.error().code, ErrorCode::kTooLarge);
    EXPECT_THAT(more.error().message, HasSubstr("with b (100 bytes)"));
    // What was refused leaves no trace: one entry in the directory.
    const Bytes end = almost.end();
    EXPECT_EQ(ByteReader(end, ByteOrder::kLittle).u16(end.size() - 12), 1U);

    ZipWriter full(0);
    for (std::int64_t i = 0; i < kMaxZipEntries; ++i) {
        ASSERT_TRUE(full.entry(std::to_string(i), {}));
    }
    const auto one_more = full.entry("one", {});
    ASSERT_FALSE(one_more);
    EXPECT_THAT(one_more.error().message, HasSubstr("at most 65535 entries; one"));
}

}  // namespace
}  // namespace haarmony::ingest
