// Answers whose bodies are not simply bytes: compressed, conditional, files, streams.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "server/http/content_encoding.h"
#include "server/http/file_body.h"
#include "tests/server/http/scratch_folder.h"
#include "tests/server/http/test_server.h"

namespace haarmony::http::test {
namespace {

// A source of the given chunks.
Handler streaming(std::vector<std::string> chunks) {
    return [chunks](const Request&) {
        return Response{
            .status = 200,
            .headers = {{"Content-Type", "text/event-stream"}},
            .body = ChunkSource(
                [chunks, at = std::size_t{0}]() mutable -> std::optional<std::string> {
                    if (at == chunks.size()) return std::nullopt;
                    return chunks[at++];
                })};
    };
}

Handler serving(std::string path, std::uint64_t length) {
    return [path, length](const Request&) {
        return Response{.status = 200,
                        .headers = {{"Content-Type", "image/png"},
                                    {"ETag", "\"f1\""},
                                    {"Accept-Ranges", "bytes"}},
                        .body = FileRange{.path = path, .offset = 0, .length = length}};
    };
}

TEST(ListenerBody, JsonIsCompressedForThoseWhoAcceptIt) {
    TestServer server;
    const std::string json = "[" + std::string(5'000, ' ') + "]";
    server.router.add("GET", "/json", {}, [&](const Request&) {
        return Response{
            .status = 200,
            .headers = {{"Content-Type", "application/json"}, {"ETag", "\"j1\""}},
            .body = json};
    });
    server.start();
    HttpClient client(server.port());
    const HttpReply plain = client.get("/json");
    EXPECT_EQ(plain.body, json);
    EXPECT_EQ(plain.header("vary"), "Accept-Encoding");
    const HttpReply packed = client.get("/json", "Accept-Encoding: gzip\r\n");
    EXPECT_EQ(packed.header("content-encoding"), "gzip");
    EXPECT_EQ(packed.header("etag"), "W/\"j1\"");
    EXPECT_EQ(packed.body, gzip(json));
    const HttpReply head = client.request("HEAD", "/json", "Accept-Encoding: gzip\r\n");
    EXPECT_EQ(head.header("content-length"), packed.header("content-length"));
    for (const char* tag : {"\"j1\"", "W/\"j1\""}) {
        const HttpReply same = client.get(
            "/json",
            "Accept-Encoding: gzip\r\nIf-None-Match: " + std::string(tag) + "\r\n");
        EXPECT_EQ(same.status, 304);
        EXPECT_EQ(same.header("etag"), "W/\"j1\"");
        EXPECT_FALSE(same.headers.contains("content-length"));
        EXPECT_FALSE(same.headers.contains("content-encoding"));
    }
    EXPECT_EQ(client.get("/hello").body, "hello");
}

TEST(ListenerBody, FilesAreStreamedWholeAndInRanges) {
    const ScratchFolder folder;
    const std::string content = pattern(3 * kFileChunk + 100);
    TestServer server;
    server.router.add(
        "GET", "/file", {}, serving(folder.write("f", content), content.size()));
    server.start();
    HttpClient client(server.port());
    const HttpReply whole = client.get("/file");
    EXPECT_EQ(whole.body, content);
    EXPECT_EQ(whole.header("content-length"), std::to_string(content.size()));
    const HttpReply part = client.get("/file", "Range: bytes=1000-800000\r\n");
    EXPECT_EQ(part.status, 206);
    EXPECT_EQ(part.body, content.substr(1000, 799'001));
    const HttpReply none = client.get("/file", "Range: bytes=9999999-\r\n");
    EXPECT_EQ(none.status, 416);
    EXPECT_EQ(none.header("content-range"), "bytes */" + std::to_string(content.size()));
    const HttpReply head = client.request("HEAD", "/file");
    EXPECT_EQ(head.header("content-length"), std::to_string(content.size()));
    EXPECT_EQ(client.get("/file", "If-None-Match: \"f1\"\r\n").status, 304);
    EXPECT_EQ(client.get("/hello").body, "hello");
}

TEST(ListenerBody, FileThatIsGoneIs404WithoutItsPath) {
    const ScratchFolder folder;
    TestServer server;
    server.router.add("GET", "/file", {}, serving(folder.path() / "gone", 5));
    server.start();
    HttpClient client(server.port());
    const HttpReply reply = client.get("/file");
    EXPECT_EQ(reply.status, 404);
    EXPECT_THAT(reply.body, ::testing::Not(::testing::HasSubstr("gone\"")));
    EXPECT_THAT(reply.body, ::testing::Not(::testing::HasSubstr(folder.path().string())));
    EXPECT_EQ(client.get("/hello").status, 200);
}

TEST(ListenerBody, FileThatIsTooShortIs500) {
    const ScratchFolder folder;
    TestServer server;
    server.router.add("GET", "/file", {}, serving(folder.write("f", "1234"), 5));
    server.start();
    HttpClient client(server.port());
    EXPECT_EQ(client.get("/file").status, 500);
    EXPECT_EQ(server.failed().size(), 1U);
}

TEST(ListenerBody, FileThatShrinksMidwayBreaksTheConnectionOff) {
    // So long that the socket's buffers cannot hold it: the server waits for the client.
    constexpr std::uint64_t kLength = 64ULL * 1024 * 1024;
    const ScratchFolder folder;
    const std::string path = folder.write("f", "");
    std::filesystem::resize_file(path, kLength);
    TestServer server;
    server.router.add("GET", "/file", {}, serving(path, kLength));
    server.start();
    HttpClient client(server.port());
    client.send("GET /file HTTP/1.1\r\nHost: h\r\n\r\n");
    EXPECT_EQ(client.receive_head().header("content-length"), std::to_string(kLength));
    std::uint64_t got = client.read_some().size();
    std::filesystem::resize_file(path, 0);
    for (std::string bytes = client.read_some(); !bytes.empty();
         bytes = client.read_some()) {
        got += bytes.size();
    }
    EXPECT_LT(got, kLength);
    EXPECT_EQ(server.failed().size(), 1U);
    EXPECT_TRUE(server.is_usable());
}

TEST(ListenerBody, StreamsAreChunkedAndTheConnectionStays) {
    TestServer server;
    server.router.add(
        "GET", "/stream", {}, streaming({"one", "", "two", "", "", "three"}));
    server.options.poll_interval = std::chrono::milliseconds(1);
    server.start();
    HttpClient client(server.port());
    for (int i = 0; i < 2; ++i) {
        const HttpReply reply = client.get("/stream");
        EXPECT_EQ(reply.header("transfer-encoding"), "chunked");
        EXPECT_EQ(reply.body, "onetwothree");
    }
    const HttpReply head = client.request("HEAD", "/stream");
    EXPECT_EQ(head.header("transfer-encoding"), "chunked");
    EXPECT_EQ(client.get("/hello").body, "hello");
}

TEST(ListenerBody, StreamToHttp10EndsWithTheConnection) {
    TestServer server;
    server.router.add("GET", "/stream", {}, streaming({"one", "two"}));
    server.start();
    HttpClient client(server.port());
    client.send("GET /stream HTTP/1.0\r\nConnection: keep-alive\r\n\r\n");
    const HttpReply reply = client.receive();
    EXPECT_TRUE(reply.until_close);
    EXPECT_EQ(reply.header("connection"), "close");
    EXPECT_EQ(reply.body, "onetwo");
}

TEST(ListenerBody, ChunksArriveBeforeTheSourceIsDone) {
    TestServer server;
    std::atomic<bool> more = false;
    server.router.add("GET", "/events", {}, [&](const Request&) {
        return Response{.status = 200,
                        .headers = {},
                        .body = ChunkSource(
                            [&more, sent = 0]() mutable -> std::optional<std::string> {
                                if (sent == 1 && !more) return "";
                                return ++sent > 2 ? std::nullopt
                                                  : std::optional<std::string>("event");
                            })};
    });
    server.options.poll_interval = std::chrono::milliseconds(1);
    server.start();
    HttpClient client(server.port());
    client.send("GET /events HTTP/1.1\r\nHost: h\r\n\r\n");
    (void)client.receive_head();
    EXPECT_EQ(client.read_some(), "5\r\nevent\r\n");
    more = true;
    std::string rest;
    while (!rest.ends_with("0\r\n\r\n")) rest += client.read_some();
    EXPECT_EQ(rest, "5\r\nevent\r\n0\r\n\r\n");
}

TEST(ListenerBody, MoreWaitingStreamsThanThreadsDoNotBlockEachOther) {
    TestServer server;
    server.options.stream_threads = 1;
    server.options.poll_interval = std::chrono::milliseconds(1);
    std::atomic<bool> done = false;
    server.router.add("GET", "/events", {}, [&](const Request&) {
        return Response{.status = 200,
                        .headers = {},
                        .body = ChunkSource([&]() -> std::optional<std::string> {
                            if (done) return std::nullopt;
                            return "";
                        })};
    });
    server.router.add("GET", "/stream", {}, streaming({"one"}));
    server.start();
    std::vector<std::unique_ptr<HttpClient>> waiting;
    for (int i = 0; i < 10; ++i) {
        waiting.push_back(std::make_unique<HttpClient>(server.port()));
        waiting.back()->send("GET /events HTTP/1.1\r\nHost: h\r\n\r\n");
    }
    HttpClient client(server.port());
    EXPECT_EQ(client.get("/stream").body, "one");
    done = true;
    for (const auto& one : waiting) EXPECT_EQ(one->receive().body, "");
}

TEST(ListenerBody, SourceThatThrowsBreaksTheConnectionOff) {
    TestServer server;
    server.router.add("GET", "/broken", {}, [](const Request&) {
        return Response{
            .status = 200,
            .headers = {},
            .body = ChunkSource([sent = false]() mutable -> std::optional<std::string> {
                if (sent) throw std::runtime_error("the video ended early");
                sent = true;
                return "one";
            })};
    });
    server.start();
    HttpClient client(server.port());
    EXPECT_THROW((void)client.get("/broken"), std::runtime_error);
    EXPECT_THAT(server.failed(), ::testing::ElementsAre("the video ended early"));
    EXPECT_TRUE(server.is_usable());
}

TEST(ListenerBody, StreamEndsWhenItsClientLeaves) {
    TestServer server;
    server.options.poll_interval = std::chrono::milliseconds(1);
    auto alive = std::make_shared<int>(0);
    const std::weak_ptr<int> watch = alive;
    server.router.add("GET", "/events", {}, [&](const Request&) {
        return Response{
            .status = 200,
            .headers = {},
            .body = ChunkSource([held = std::exchange(alive, nullptr)]()
                                    -> std::optional<std::string> { return ""; })};
    });
    server.start();
    {
        HttpClient client(server.port());
        client.send("GET /events HTTP/1.1\r\nHost: h\r\n\r\n");
        (void)client.receive_head();
        EXPECT_FALSE(watch.expired());
    }
    EXPECT_TRUE(eventually([&] { return watch.expired(); }));
    ASSERT_TRUE(eventually([&] { return !server.finished().empty(); }));
    EXPECT_EQ(server.finished()[0].status, 499);
}

}  // namespace
}  // namespace haarmony::http::test
