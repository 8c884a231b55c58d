// haarmony-video as a process: what it may, and what becomes of us when it crashes, hangs or
// lies. Programs of the shell take its place where it must misbehave.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "ingest/socket_child.h"
#include "ingest/video_wire.h"
#include "tests/ingest/scratch_folder.h"
#include "tests/ingest/video/clips.h"

namespace haarmony::ingest {
namespace {

using namespace testing;
using std::chrono::milliseconds;
using ::testing::HasSubstr;

const video::FrameFormat kSmall = {32, 24, {10, 1}};

// A child that does what the shell says.
std::string fake_program(const ScratchFolder& folder, const std::string& script) {
    const std::string path = folder / "fake-video";
    std::ofstream(path) << "#!/bin/sh\n" << script << "\n";
    EXPECT_EQ(::chmod(path.c_str(), 0700), 0);
    return path;
}

// A child that reads the request, sends these bytes and does what the shell says.
std::string lying_program(const ScratchFolder& folder,
                          const std::string& bytes,
                          const std::string& then) {
    const std::string path = folder / "replies";
    std::ofstream(path, std::ios::binary) << bytes;
    return fake_program(folder,
                        "head -c " + std::to_string(sizeof(VideoRequest)) +
                            " <&0 >/dev/null; cat " + path + " >&0; " + then);
}

std::string as_bytes(const VideoReply& reply) {
    return {reinterpret_cast<const char*>(&reply), sizeof(reply)};
}

VideoReply opened(const video::FrameFormat& format) {
    VideoReply reply;
    reply.kind = VideoReplyKind::kOpened;
    reply.format = format;
    return reply;
}

VideoReply picture_of(const video::FrameFormat& format) {
    VideoReply reply;
    reply.kind = VideoReplyKind::kPicture;
    reply.length = picture_bytes(format);
    return reply;
}

const Bytes& gif_bytes() {
    static const Bytes bytes = {'G', 'I', 'F', '8', '9', 'a'};
    return bytes;
}

Error reading_error(const std::string& program, milliseconds patience) {
    VideoSourceOptions options;
    options.program = program;
    options.patience = patience;
    const auto shown = decode_in_child(gif_bytes(), options);
    EXPECT_FALSE(shown);
    return shown ? Error{ErrorCode::kIo, "it was read"} : shown.error();
}

Error writing_error(const std::string& program, milliseconds patience) {
    VideoSinkOptions options;
    options.program = program;
    options.patience = patience;
    options.format = kSmall;
    options.frames = 1;
    const auto sink = open_video_sink(
        options, [](std::span<const std::uint8_t>) { return Result<void>(); });
    EXPECT_FALSE(sink);
    return sink ? Error{ErrorCode::kIo, "it was written"} : sink.error();
}

bool no_child_is_left() { return ::waitpid(-1, nullptr, WNOHANG) < 0 && errno == ECHILD; }

constexpr milliseconds kLong{60'000};

TEST(VideoChild, ACrashIsTheErrorOfOneClip) {
    const ScratchFolder folder;
    const std::string program = lying_program(folder, "", "kill -SEGV $$");
    const Error reading = reading_error(program, kLong);
    EXPECT_EQ(reading.code, ErrorCode::kUndecodable);
    EXPECT_THAT(reading.message,
                HasSubstr("damaged GIF: its decoder crashed (signal 11"));
    const Error writing = writing_error(program, kLong);
    EXPECT_EQ(writing.code, ErrorCode::kUnavailable);
    EXPECT_THAT(writing.message, HasSubstr("encoder of the film crashed (signal 11"));
    EXPECT_TRUE(no_child_is_left());
}

TEST(VideoChild, RunningOutOfProcessorTimeIsNamed) {
    const ScratchFolder folder;
    const Error error = reading_error(lying_program(folder, "", "kill -XCPU $$"), kLong);
    EXPECT_THAT(error.message, HasSubstr("3600 s of processor time"));
}

TEST(VideoChild, AHangIsEndedByTheClock) {
    const ScratchFolder folder;
    const std::string program = fake_program(folder, "exec sleep 1000");
    EXPECT_THAT(reading_error(program, milliseconds(150)).message, HasSubstr("150 ms"));
    EXPECT_THAT(writing_error(program, milliseconds(150)).message, HasSubstr("150 ms"));
    EXPECT_TRUE(no_child_is_left());
}

TEST(VideoChild, OneThatTakesNoPicturesIsEndedByTheClock) {
    const ScratchFolder folder;
    VideoReply done;
    done.kind = VideoReplyKind::kDone;
    VideoSinkOptions options;
    options.program = lying_program(folder, as_bytes(done), "exec sleep 1000");
    options.patience = milliseconds(300);
    options.format = {512, 512, {10, 1}};  // more than a socket holds
    options.frames = 1;
    const auto sink = open_video_sink(
        options, [](std::span<const std::uint8_t>) { return Result<void>(); });
    ASSERT_TRUE(sink) << sink.error().message;
    const auto added = (*sink)->add(video::Picture(512, 512).view());
    ASSERT_FALSE(added);
    EXPECT_EQ(added.error().code, ErrorCode::kUnavailable);
    EXPECT_THAT(added.error().message, HasSubstr("300 ms"));
    EXPECT_TRUE(no_child_is_left());
}

TEST(VideoChild, GarbageIsNotBelieved) {
    const ScratchFolder folder;
    const std::string program = fake_program(folder, "exec cat /dev/zero >&0");
    EXPECT_THAT(reading_error(program, kLong).message, HasSubstr("makes no sense"));
    EXPECT_THAT(writing_error(program, kLong).message, HasSubstr("makes no sense"));
}

TEST(VideoChild, APictureBeforeTheSizeIsNotBelieved) {
    const ScratchFolder folder;
    VideoReply done;
    done.kind = VideoReplyKind::kDone;
    const std::string program = lying_program(folder, as_bytes(done), "exec sleep 1000");
    EXPECT_THAT(reading_error(program, kLong).message, HasSubstr("makes no sense"));
}

TEST(VideoChild, FewerPixelsThanPromisedIsACrash) {
    const ScratchFolder folder;
    const std::string program =
        lying_program(folder,
                      as_bytes(opened(kSmall)) + as_bytes(picture_of(kSmall)) + "short",
                      "exit 7");
    const Error error = reading_error(program, kLong);
    EXPECT_EQ(error.code, ErrorCode::kUndecodable);
    EXPECT_THAT(error.message, HasSubstr("ended with status 7"));
}

TEST(VideoChild, MessagesAreOneLineAndKeepTheirCode) {
    const ScratchFolder folder;
    VideoReply failed;
    failed.error = ErrorCode::kTooLarge;
    failed.length = 14;
    const std::string program = lying_program(
        folder, as_bytes(failed) + "much\n\n\x01too\tbig", "exec sleep 1000");
    const Error reading = reading_error(program, kLong);
    EXPECT_EQ(reading.code, ErrorCode::kTooLarge);
    EXPECT_EQ(reading.message, "much too big");
    const Error writing = writing_error(program, kLong);
    EXPECT_EQ(writing.code, ErrorCode::kTooLarge);
    EXPECT_EQ(writing.message, "much too big");
}

TEST(VideoChild, AMissingProgramIsAnErrorOfOurs) {
    const ScratchFolder folder;
    const Error reading = reading_error(folder / "no-such-program", kLong);
    EXPECT_EQ(reading.code, ErrorCode::kIo);
    EXPECT_THAT(reading.message,
                HasSubstr("the program that reads clips, cannot be started: No such"));
    EXPECT_EQ(writing_error(folder / "no-such-program", kLong).code, ErrorCode::kIo);
}

TEST(VideoChild, OneThatIsKilledWhileItReadsIsNamed) {
    const ScratchFolder folder;
    const std::string pixels(picture_bytes(kSmall), 'x');
    VideoSourceOptions options;
    options.program =
        lying_program(folder,
                      as_bytes(opened(kSmall)) + as_bytes(picture_of(kSmall)) + pixels,
                      "kill -KILL $$");
    const auto source = open_video(gif_bytes(), options);
    ASSERT_TRUE(source) << source.error().message;
    TimedPicture shown;
    const auto first = (*source)->next(shown);
    ASSERT_TRUE(first && *first);
    const auto second = (*source)->next(shown);
    ASSERT_FALSE(second);
    EXPECT_THAT(second.error().message, HasSubstr("crashed (signal 9"));
}

TEST(VideoChild, GoesWhenNobodyReadsOn) {
    const Bytes film =
        write_film(moving_clip({160, 160, {10, 1}}, 5, Alpha::kOpaque), Container::kApng);
    {
        const auto source = open_video(film, {});
        ASSERT_TRUE(source) << source.error().message;
        TimedPicture shown;
        ASSERT_TRUE((*source)->next(shown));
    }
    EXPECT_TRUE(no_child_is_left());
}

TEST(VideoChild, TooLittleMemoryIsAnErrorAndNoHarm) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers need more address space than any limit allows";
#endif
    const Clip clip = moving_clip(kSmall, 2, Alpha::kOpaque);
    VideoSourceOptions source;
    source.child_bytes = 1 << 20;
    const auto shown = decode_in_child(write_film(clip, Container::kMp4), source);
    ASSERT_FALSE(shown);
    EXPECT_TRUE(shown.error().code == ErrorCode::kTooLarge ||
                shown.error().code == ErrorCode::kUndecodable)
        << shown.error().message;
}

TEST(VideoWire, OnlyWhatAnHonestReaderCouldSendPasses) {
    const std::int64_t limit = 32 * 24;
    const video::FrameFormat none;
    const auto refused = [&](VideoReply reply, const video::FrameFormat& format) {
        return !check_read_reply(reply, format, limit);
    };
    EXPECT_FALSE(refused(opened(kSmall), none));
    EXPECT_TRUE(refused(opened(kSmall), kSmall)) << "twice";
    EXPECT_TRUE(refused(opened({32, 25, {10, 1}}), none)) << "too large";
    EXPECT_TRUE(refused(opened({-32, -24, {10, 1}}), none));
    EXPECT_TRUE(refused(opened({32, 0, {10, 1}}), none));
    EXPECT_TRUE(refused(opened({32, 24, {0, 1}}), none));
    EXPECT_TRUE(refused(opened({32, 24, {10, -1}}), none));

    EXPECT_FALSE(refused(picture_of(kSmall), kSmall));
    EXPECT_TRUE(refused(picture_of(kSmall), none)) << "before its size";
    EXPECT_TRUE(refused(picture_of({32, 23, {10, 1}}), kSmall));

    VideoReply failed;
    failed.length = kMaxVideoMessage;
    EXPECT_FALSE(refused(failed, none));
    failed.length += 1;
    EXPECT_TRUE(refused(failed, none));
    failed.length = 1;
    failed.error = ErrorCode::kForbidden;
    EXPECT_TRUE(refused(failed, none)) << "an error of ours";
    failed.error = static_cast<ErrorCode>(99);
    EXPECT_TRUE(refused(failed, none));

    VideoReply stranger = opened(kSmall);
    stranger.magic ^= 1;
    EXPECT_TRUE(refused(stranger, none));
    VideoReply bytes;
    bytes.kind = VideoReplyKind::kBytes;
    bytes.length = 1;
    EXPECT_TRUE(refused(bytes, kSmall)) << "no clip has those";
}

TEST(VideoWire, OnlyWhatAnHonestWriterCouldSendPasses) {
    VideoReply reply;
    reply.kind = VideoReplyKind::kBytes;
    reply.length = kMaxFilmPart;
    EXPECT_TRUE(check_film_reply(reply));
    reply.length += 1;
    EXPECT_FALSE(check_film_reply(reply));
    reply.length = 0;
    EXPECT_FALSE(check_film_reply(reply));
    reply.kind = VideoReplyKind::kDone;
    EXPECT_TRUE(check_film_reply(reply));
    reply.length = 1;
    EXPECT_FALSE(check_film_reply(reply));
    EXPECT_FALSE(check_film_reply(picture_of(kSmall)));
}

}  // namespace
}  // namespace haarmony::ingest
