#include "ingest/decoder_child.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <thread>

#include "ingest/decode.h"
#include "tests/ingest/samples.h"

namespace haarmony::ingest {
namespace {

using std::chrono::milliseconds;

ChildOptions options_for(const std::string& program) {
    ChildOptions options;
    options.program = program;
    options.address_space = std::int64_t{2} << 30;
    options.cpu_seconds = 20;
    options.patience = milliseconds(60'000);
    options.max_pixels = 1'000'000;
    return options;
}

// A child that does what the shell says.
std::string fake_program(const ScratchFolder& folder, const std::string& script) {
    const std::string path = folder.path("fake-decoder");
    std::ofstream(path) << "#!/bin/sh\n" << script << "\n";
    EXPECT_EQ(::chmod(path.c_str(), 0700), 0);
    return path;
}

// A child that reads the request, sends these bytes and does what the shell says.
std::string lying_program(const ScratchFolder& folder,
                          const WireReply& reply,
                          const std::string& payload,
                          const std::string& then) {
    const std::string bytes = folder.path("reply");
    std::ofstream file(bytes, std::ios::binary);
    file.write(reinterpret_cast<const char*>(&reply), sizeof(reply));
    file << payload;
    file.close();
    return fake_program(folder,
                        "head -c 32 <&0 >/dev/null; cat " + bytes + " >&0; " + then);
}

Error failure_of(const ChildOptions& options) {
    DecoderChild child(options);
    const auto raster = child.decode(Format::kGif, text_bytes("GIF89a"));
    EXPECT_FALSE(raster);
    EXPECT_EQ(child.pid(), -1) << "a child that failed is not kept";
    return raster ? Error{ErrorCode::kIo, "decoded"} : raster.error();
}

bool mentions(const Error& error, const std::string& words) {
    return error.message.find(words) != std::string::npos;
}

std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

TEST(DecoderChild, IsStartedOnceAndKept) {
    DecoderChild child(options_for(find_decoder_program()));
    EXPECT_EQ(child.pid(), -1);
    const Raster picture = sample_picture(30, 20, 3);
    const Bytes file = write_webp(picture);
    const auto first = child.decode(Format::kWebp, file);
    ASSERT_TRUE(first) << first.error().message;
    EXPECT_EQ(largest_difference(*first, picture), 0);
    const pid_t pid = child.pid();
    EXPECT_GT(pid, 0);
    // A damaged picture is an answer, no reason to start again.
    EXPECT_FALSE(child.decode(Format::kWebp, Bytes(file.begin(), file.end() - 9)));
    ASSERT_TRUE(child.decode(Format::kWebp, file));
    EXPECT_EQ(child.pid(), pid);
}

TEST(DecoderChild, IsConfined) {
    ChildOptions options = options_for(find_decoder_program());
    DecoderChild child(options);
    ASSERT_TRUE(child.decode(Format::kWebp, write_webp(sample_picture(30, 20, 3))));
    const std::filesystem::path process = "/proc/" + std::to_string(child.pid());

    std::map<std::string, std::string> soft;
    std::istringstream limits(text_of(process / "limits"));
    for (std::string line; std::getline(limits, line);) {
        std::istringstream fields(line.substr(26));
        fields >> soft[line.substr(0, line.find("  "))];
    }
    EXPECT_EQ(soft["Max core file size"], "0");
    EXPECT_EQ(soft["Max file size"], "0");
    EXPECT_GE(std::stoi(soft["Max cpu time"]), options.cpu_seconds);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    EXPECT_EQ(soft["Max address space"], std::to_string(options.address_space));
#endif

    int descriptors = 0;
    for (const auto& entry : std::filesystem::directory_iterator(process / "fd")) {
        ++descriptors;
        EXPECT_LE(std::stoi(entry.path().filename()), 2) << entry.path();
    }
    EXPECT_EQ(descriptors, 3);
    EXPECT_EQ(text_of(process / "environ"), std::string("MALLOC_ARENA_MAX=1\0", 19));
    EXPECT_EQ(::getpgid(child.pid()), child.pid());
}

TEST(DecoderChild, OneThatWasKilledBetweenPicturesIsReplaced) {
    pid_t second = -1;
    {
        DecoderChild child(options_for(find_decoder_program()));
        const Bytes file = write_webp(sample_picture(30, 20, 3));
        ASSERT_TRUE(child.decode(Format::kWebp, file));
        const pid_t first = child.pid();
        ASSERT_EQ(::kill(first, SIGKILL), 0);
        // Waits for its death without taking its status away.
        siginfo_t info{};
        ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(first), &info, WEXITED | WNOWAIT), 0);
        const auto again = child.decode(Format::kWebp, file);
        ASSERT_TRUE(again) << again.error().message;
        second = child.pid();
        EXPECT_NE(second, first);
    }
    EXPECT_EQ(::kill(second, 0), -1) << "a child goes away with its owner";
    EXPECT_EQ(errno, ESRCH);
}

TEST(DecoderChild, ACrashIsTheErrorOfOnePicture) {
    const ScratchFolder folder;
    const Error error = failure_of(
        options_for(fake_program(folder, "head -c 32 <&0 >/dev/null; kill -SEGV $$")));
    EXPECT_EQ(error.code, ErrorCode::kUndecodable);
    EXPECT_TRUE(mentions(error, "its decoder crashed (signal 11")) << error.message;
    EXPECT_TRUE(mentions(error, "GIF")) << error.message;
}

TEST(DecoderChild, RunningOutOfProcessorTimeIsNamed) {
    const ScratchFolder folder;
    const Error error = failure_of(
        options_for(fake_program(folder, "head -c 32 <&0 >/dev/null; kill -XCPU $$")));
    EXPECT_EQ(error.code, ErrorCode::kUndecodable);
    EXPECT_TRUE(mentions(error, "20 s of processor time")) << error.message;
}

TEST(DecoderChild, AHangIsEndedByTheClock) {
    const ScratchFolder folder;
    ChildOptions options = options_for(fake_program(folder, "exec sleep 1000"));
    options.patience = milliseconds(150);
    const Error error = failure_of(options);
    EXPECT_EQ(error.code, ErrorCode::kUndecodable);
    EXPECT_TRUE(mentions(error, "150 ms")) << error.message;
}

TEST(DecoderChild, GarbageIsNotBelieved) {
    const ScratchFolder folder;
    const Error error =
        failure_of(options_for(fake_program(folder, "exec cat /dev/zero >&0")));
    EXPECT_EQ(error.code, ErrorCode::kUndecodable);
    EXPECT_TRUE(mentions(error, "makes no sense")) << error.message;
}

TEST(DecoderChild, FewerPixelsThanPromisedIsACrash) {
    const ScratchFolder folder;
    WireReply reply;
    reply.status = WireStatus::kPixels;
    reply.width = 100;
    reply.height = 100;
    reply.channels = 3;
    reply.length = 30'000;
    const Error error =
        failure_of(options_for(lying_program(folder, reply, "too short", "exit 7")));
    EXPECT_EQ(error.code, ErrorCode::kUndecodable);
    EXPECT_TRUE(mentions(error, "ended with status 7")) << error.message;
}

TEST(DecoderChild, PromisesThatStayOpenEndWithTheClock) {
    const ScratchFolder folder;
    WireReply reply;
    reply.status = WireStatus::kUndecodable;
    reply.length = 100;
    ChildOptions options =
        options_for(lying_program(folder, reply, "only this", "exec sleep 1000"));
    options.patience = milliseconds(300);
    EXPECT_TRUE(mentions(failure_of(options), "300 ms"));
}

TEST(DecoderChild, MessagesAreOneLineAndKeepTheirCode) {
    const ScratchFolder folder;
    WireReply reply;
    reply.status = WireStatus::kTooLarge;
    reply.length = 14;
    DecoderChild child(options_for(
        lying_program(folder, reply, "much\n\n\x01too\tbig", "exec sleep 1000")));
    const auto raster = child.decode(Format::kGif, text_bytes("GIF89a"));
    ASSERT_FALSE(raster);
    EXPECT_EQ(raster.error().code, ErrorCode::kTooLarge);
    EXPECT_EQ(raster.error().message, "much too big");
}

TEST(DecoderChild, AMissingProgramIsAnErrorOfOurs) {
    const ScratchFolder folder;
    DecoderChild child(options_for(folder.path("no-such-program")));
    const auto raster = child.decode(Format::kGif, text_bytes("GIF89a"));
    ASSERT_FALSE(raster);
    EXPECT_EQ(raster.error().code, ErrorCode::kIo);
    EXPECT_TRUE(mentions(raster.error(), "cannot be started: No such file"))
        << raster.error().message;
    // A path of the server's disk has no place in a reply.
    EXPECT_FALSE(mentions(raster.error(), "/")) << raster.error().message;
}

TEST(DecoderChild, TooLittleMemoryIsAnErrorAndNoHarm) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers need more address space than any limit allows";
#endif
    ChildOptions options = options_for(find_decoder_program());
    options.address_space = 64 << 20;
    DecoderChild child(options);
    const auto raster =
        child.decode(Format::kTiff,
                     write_with_oiio(sample_picture(640, 480, 3), {.extension = "tif"}));
    ASSERT_FALSE(raster);
    EXPECT_TRUE(raster.error().code == ErrorCode::kTooLarge ||
                raster.error().code == ErrorCode::kUndecodable)
        << raster.error().message;
}

TEST(DecoderChild, SeveralThreadsEachWithTheirOwn) {
    const Raster picture = sample_picture(60, 40, 3);
    const Bytes webp = write_webp(picture);
    const Bytes tiff = write_with_oiio(picture, {.extension = "tif"});
    std::vector<std::string> errors(3);
    std::vector<std::thread> threads;
    for (std::string& error : errors) {
        threads.emplace_back([&] {
            DecoderChild child(options_for(find_decoder_program()));
            for (int i = 0; i < 10; ++i) {
                const bool even = i % 2 == 0;
                const auto raster = child.decode(even ? Format::kWebp : Format::kTiff,
                                                 even ? webp : tiff);
                if (!raster) error = raster.error().message;
                if (raster && raster->pixels != picture.pixels) error = "other pixels";
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (const std::string& error : errors) EXPECT_EQ(error, "");
}

// Children die and are started in all threads at once: no thread waits for another's child,
// and no child inherits the socket of another, which would keep that one from seeing its end.
TEST(DecoderChild, CrashesInSeveralThreadsStayApart) {
    const ScratchFolder folder;
    const ChildOptions options =
        options_for(fake_program(folder, "head -c 32 <&0 >/dev/null; kill -SEGV $$"));
    std::vector<int> crashes(4, 0);
    std::vector<std::thread> threads;
    for (int& count : crashes) {
        threads.emplace_back([&] {
            DecoderChild child(options);
            for (int i = 0; i < 10; ++i) {
                const auto raster = child.decode(Format::kGif, text_bytes("GIF89a"));
                if (!raster && mentions(raster.error(), "signal 11")) ++count;
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_THAT(crashes, testing::Each(10));
}

TEST(WireReply, OnlyWhatAnHonestChildCouldSendPasses) {
    WireReply good;
    good.status = WireStatus::kPixels;
    good.width = 1000;
    good.height = 1000;
    good.channels = 4;
    good.length = 4'000'000;
    EXPECT_TRUE(check_reply(good, 1'000'000));
    EXPECT_FALSE(check_reply(good, 999'999));
    const auto refused = [&](auto change) {
        WireReply reply = good;
        change(reply);
        return !check_reply(reply, 1'000'000);
    };
    EXPECT_TRUE(refused([](WireReply& r) { r.magic ^= 1; }));
    EXPECT_TRUE(refused([](WireReply& r) { r.status = static_cast<WireStatus>(3); }));
    EXPECT_TRUE(refused([](WireReply& r) { r.width = 0; }));
    EXPECT_TRUE(refused([](WireReply& r) { r.width = -1000, r.height = -1000; }));
    EXPECT_TRUE(refused([](WireReply& r) { r.channels = 2, r.length = 2'000'000; }));
    EXPECT_TRUE(refused([](WireReply& r) { r.length += 1; }));
    EXPECT_TRUE(refused([](WireReply& r) {
        r.status = WireStatus::kUndecodable;
        r.length = kMaxWireMessage + 1;
    }));
}

TEST(Decoder, UsesTheProgramThatItIsGiven) {
    const ScratchFolder folder;
    DecodeLimits limits;
    limits.child_program =
        fake_program(folder, "head -c 32 <&0 >/dev/null; kill -ABRT $$");
    Decoder decoder(limits);
    const auto webp = decoder.decode(write_webp(sample_picture(8, 8, 3)));
    ASSERT_FALSE(webp);
    EXPECT_EQ(webp.error().code, ErrorCode::kUndecodable);
    // PNG and JPEG do not need it.
    const Raster picture = sample_picture(8, 8, 3);
    EXPECT_TRUE(decoder.decode(write_with_oiio(picture, {.extension = "png"})));
    EXPECT_TRUE(decoder.decode(write_jpeg(picture, {})));
}

}  // namespace
}  // namespace haarmony::ingest
