#include "server/http/answer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "server/http/content_encoding.h"
#include "tests/server/http/scratch_folder.h"

namespace haarmony::http {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// What a router with one handler answers, and what it reports.
class AnswerOfAHandler : public ::testing::Test {
  protected:
    Answer ask(const Response& response, const Headers& headers = {}) {
        Router router;
        router.add("GET", "/it", {}, [&](const Request&) { return response; });
        Request request;
        request.method = "GET";
        request.path = "/it";
        request.headers = headers;
        return answer(router, request, [this](const Request&, std::string_view what) {
            reports_.emplace_back(what);
        });
    }
    using Body = decltype(Response::body);
    static Response with(Body body, Headers headers = {}) {
        return {200, std::move(headers), std::move(body)};
    }
    static std::string text_of(const Answer& answer) {
        return std::get<std::string>(answer.response.body);
    }

    std::vector<std::string> reports_;
};

TEST_F(AnswerOfAHandler, HasTheLengthOfItsText) {
    const Answer made = ask(with("twelve bytes"));
    EXPECT_EQ(made.content_length, 12U);
    EXPECT_EQ(text_of(made), "twelve bytes");
}

TEST_F(AnswerOfAHandler, IsOfUnknownLengthWhereItIsAStream) {
    const Answer made =
        ask(with(ChunkSource([] { return std::optional<std::string>(); })));
    EXPECT_EQ(made.content_length, std::nullopt);
}

TEST_F(AnswerOfAHandler, IsCompressedAndThenHasTheLengthOfThat) {
    const std::string text(4 * kMinCompressed, 'a');
    const Response response = with(text, {{"Content-Type", "text/plain"}});
    const Answer made = ask(response, {{"Accept-Encoding", "gzip"}});
    EXPECT_EQ(text_of(made), gzip(text));
    EXPECT_EQ(made.content_length, text_of(made).size());
    EXPECT_EQ(text_of(ask(response)), text);
}

TEST_F(AnswerOfAHandler, IsNotCompressedWhereTheClientHasItAlready) {
    const Response response =
        with(std::string(4 * kMinCompressed, 'a'),
             {{"Content-Type", "text/plain"}, {"ETag", "\"seven\""}});
    const Answer made =
        ask(response, {{"Accept-Encoding", "gzip"}, {"If-None-Match", "\"seven\""}});
    EXPECT_EQ(made.response.status, 304);
    EXPECT_EQ(made.response.headers.count("Content-Encoding"), 0U);
}

TEST_F(AnswerOfAHandler, OpensItsFileBeforeAnythingIsSent) {
    const test::ScratchFolder folder;
    const std::string path = folder.write("file", "0123456789");
    const Answer made = ask(with(FileRange{.path = path, .offset = 2, .length = 5}));
    std::filesystem::remove(path);
    EXPECT_EQ(made.content_length, 5U);
    EXPECT_EQ(std::get<ChunkSource>(made.response.body)(), "23456");
    EXPECT_TRUE(reports_.empty());
}

TEST_F(AnswerOfAHandler, IsAProblemWhereItsFileIsGone) {
    const test::ScratchFolder folder;
    const std::string path = folder.path() / "gone";
    const Answer made = ask(with(FileRange{.path = path, .offset = 0, .length = 5}));
    EXPECT_EQ(made.response.status, 404);
    EXPECT_EQ(made.content_length, text_of(made).size());
    EXPECT_THAT(text_of(made), Not(HasSubstr(path)));
    EXPECT_EQ(reports_.size(), 1U);
}

}  // namespace
}  // namespace haarmony::http
