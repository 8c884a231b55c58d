#include "server/http/problem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace haarmony::http {
namespace {

using nlohmann::json;

Request some_request() {
    Request request;
    request.path = "/images/a b";
    request.request_id = "id-7";
    return request;
}

json parsed(const Response& response) {
    return json::parse(std::get<std::string>(response.body));
}

TEST(Problem, CarriesEveryMemberOfTheContract) {
    const Response response = to_response({.status = 400,
                                           .code = "unknown_parameter",
                                           .detail = "'limt' is not a parameter.",
                                           .param = "limt",
                                           .headers = {{"Retry-After", "3"}}},
                                          some_request());
    EXPECT_EQ(response.status, 400);
    EXPECT_EQ(response.headers.at("Content-Type"), "application/problem+json");
    EXPECT_EQ(response.headers.at("Retry-After"), "3");
    EXPECT_EQ(parsed(response),
              json({{"type", "about:blank"},
                    {"title", "Bad Request"},
                    {"status", 400},
                    {"detail", "'limt' is not a parameter."},
                    {"instance", "/images/a%20b"},
                    {"code", "unknown_parameter"},
                    {"param", "limt"},
                    {"request_id", "id-7"}}));
}

TEST(Problem, LeavesAnEmptyParamOut) {
    EXPECT_FALSE(
        parsed(to_response({.status = 404, .code = "not_found", .detail = "gone"},
                           some_request()))
            .contains("param"));
}

TEST(Problem, BytesThatAreNotUtf8AreReplaced) {
    const json problem = parsed(
        to_response({.status = 400, .code = "x", .detail = "bad \xFF"}, some_request()));
    EXPECT_EQ(problem["detail"], "bad \xEF\xBF\xBD");
}

TEST(Problem, EveryErrorCodeHasItsStatus) {
    const auto status = [](ErrorCode code) {
        return problem_of({.code = code, .message = "m", .param = "p"}).status;
    };
    EXPECT_EQ(status(ErrorCode::kInvalidArgument), 400);
    EXPECT_EQ(status(ErrorCode::kForbidden), 403);
    EXPECT_EQ(status(ErrorCode::kNotFound), 404);
    EXPECT_EQ(status(ErrorCode::kConflict), 409);
    EXPECT_EQ(status(ErrorCode::kTooLarge), 413);
    EXPECT_EQ(status(ErrorCode::kUnsupportedFormat), 415);
    EXPECT_EQ(status(ErrorCode::kUndecodable), 422);
    EXPECT_EQ(status(ErrorCode::kUnavailable), 503);
    EXPECT_EQ(status(ErrorCode::kIo), 500);
    EXPECT_EQ(status(ErrorCode::kNotADatabase), 500);
    EXPECT_EQ(status(ErrorCode::kNewerVersion), 500);
}

TEST(Problem, ErrorOfTheClientKeepsItsTextAndParam) {
    const Problem problem = problem_of({.code = ErrorCode::kInvalidArgument,
                                        .message = "limit 0 is not in 1..1000",
                                        .param = "limit"});
    EXPECT_EQ(problem.code, "invalid_argument");
    EXPECT_EQ(problem.detail, "limit 0 is not in 1..1000");
    EXPECT_EQ(problem.param, "limit");
}

TEST(Problem, ErrorOfTheServerSaysNothingOfItsInside) {
    for (const ErrorCode code :
         {ErrorCode::kIo, ErrorCode::kNotADatabase, ErrorCode::kNewerVersion}) {
        const Problem problem =
            problem_of({.code = code, .message = "open /srv/db: no", .param = "/srv"});
        EXPECT_EQ(problem.code, "internal");
        EXPECT_THAT(problem.detail, testing::Not(testing::HasSubstr("/srv")));
        EXPECT_EQ(problem.param, "");
    }
}

TEST(Problem, UnavailableSaysWhenToComeBack) {
    const Problem problem =
        problem_of({.code = ErrorCode::kUnavailable, .message = "busy"});
    EXPECT_GE(std::stoi(problem.headers.at("Retry-After")), 1);
}

TEST(Problem, EveryStatusOfTheContractHasAPhrase) {
    for (const int status :
         {200, 201, 202, 204, 206, 304, 400, 401, 403, 404, 405, 408, 409,
          411, 413, 414, 415, 416, 417, 422, 429, 431, 500, 501, 503, 505}) {
        EXPECT_NE(reason_phrase(status), "Unknown") << status;
    }
    EXPECT_EQ(reason_phrase(299), "Unknown");
}

}  // namespace
}  // namespace haarmony::http
