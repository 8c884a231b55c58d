#include "server/http/router.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace haarmony::http {
namespace {

using nlohmann::json;

Handler saying(std::string text) {
    return [text = std::move(text)](const Request&) {
        return Response{.status = 200, .headers = {}, .body = text};
    };
}

std::string text_of(const Response& response) {
    return std::get<std::string>(response.body);
}

Response ask(const Router& router, std::string method, std::string path) {
    Request request;
    request.method = std::move(method);
    request.path = std::move(path);
    return router.dispatch(request);
}

TEST(Router, ParametersReachTheHandlerByName) {
    Router router;
    router.add("GET", "/images/{id}/{part}", {}, [](const Request& request) {
        return Response{.status = 200,
                        .headers = {},
                        .body = request.path_parameters.at("id") + "|" +
                                request.path_parameters.at("part")};
    });
    EXPECT_EQ(text_of(ask(router, "GET", "/images/12/a b")), "12|a b");
}

TEST(Router, SamePlaceMayHaveAnotherNameForAnotherMethod) {
    Router router;
    const auto show = [](const char* name) {
        return [name](const Request& request) {
            return Response{
                .status = 200, .headers = {}, .body = request.path_parameters.at(name)};
        };
    };
    router.add("GET", "/x/{id}", {}, show("id"));
    router.add("PUT", "/x/{name}", {}, show("name"));
    EXPECT_EQ(text_of(ask(router, "GET", "/x/1")), "1");
    EXPECT_EQ(text_of(ask(router, "PUT", "/x/2")), "2");
}

TEST(Router, LiteralBeatsParameter) {
    Router router;
    router.add("GET", "/images/{id}", {}, saying("parameter"));
    router.add("GET", "/images/export", {}, saying("literal"));
    EXPECT_EQ(text_of(ask(router, "GET", "/images/export")), "literal");
    EXPECT_EQ(text_of(ask(router, "GET", "/images/exports")), "parameter");
}

TEST(Router, LiteralThatLeadsNowhereGivesWayToAParameter) {
    Router router;
    router.add("GET", "/images/{id}/thumbnail", {}, saying("thumbnail"));
    router.add("GET", "/images/export/all", {}, saying("all"));
    EXPECT_EQ(text_of(ask(router, "GET", "/images/export/thumbnail")), "thumbnail");
    EXPECT_EQ(text_of(ask(router, "GET", "/images/export/all")), "all");
}

TEST(Router, UnknownPathIsAProblemWithItsName) {
    Router router;
    router.add("GET", "/images", {}, saying("x"));
    for (const char* path :
         {"/", "/imag", "/images/", "/images/1", "//images", "/IMAGES"}) {
        const Response response = ask(router, "GET", path);
        EXPECT_EQ(response.status, 404) << path;
        const json problem = json::parse(text_of(response));
        EXPECT_EQ(problem["code"], "not_found");
        EXPECT_EQ(problem["instance"], path);
    }
}

TEST(Router, ParameterIsNeverEmpty) {
    Router router;
    router.add("GET", "/images/{id}/thumbnail", {}, saying("x"));
    EXPECT_EQ(ask(router, "GET", "/images//thumbnail").status, 404);
}

TEST(Router, OtherMethodIs405AndListsThoseThatAreAllowed) {
    Router router;
    router.add("GET", "/images", {}, saying("x"));
    router.add("POST", "/images", {}, saying("x"));
    router.add("DELETE", "/jobs/{id}", {}, saying("x"));
    const Response response = ask(router, "PATCH", "/images");
    EXPECT_EQ(response.status, 405);
    EXPECT_EQ(response.headers.at("Allow"), "GET, HEAD, OPTIONS, POST");
    EXPECT_EQ(json::parse(text_of(response))["code"], "method_not_allowed");
    EXPECT_EQ(ask(router, "GET", "/jobs/1").headers.at("Allow"), "DELETE, OPTIONS");
}

TEST(Router, OptionsListsTheMethodsWithoutABody) {
    Router router;
    router.add("GET", "/images", {}, saying("x"));
    const Response response = ask(router, "OPTIONS", "/images");
    EXPECT_EQ(response.status, 204);
    EXPECT_EQ(response.headers.at("Allow"), "GET, HEAD, OPTIONS");
    EXPECT_EQ(text_of(response), "");
    EXPECT_EQ(ask(router, "OPTIONS", "/none").status, 404);
    EXPECT_EQ(ask(router, "OPTIONS", "*").status, 204);
}

TEST(Router, HeadIsAnsweredByGet) {
    Router router;
    router.add("GET", "/images", {}, saying("body"));
    router.add("POST", "/query", {}, saying("x"));
    EXPECT_EQ(ask(router, "HEAD", "/images").status, 200);
    EXPECT_EQ(ask(router, "HEAD", "/query").status, 405);
}

TEST(Router, MatchGivesTheOptionsBeforeTheBodyIsRead) {
    Router router;
    router.add("POST", "/query", {.cost = Cost::kCostly, .body_limit = 100}, saying("x"));
    router.add("GET", "/healthz", {.open = true}, saying("x"));
    const RouteMatch query = router.match("POST", "/query");
    ASSERT_NE(query.options, nullptr);
    EXPECT_EQ(query.options->cost, Cost::kCostly);
    EXPECT_EQ(query.options->body_limit, 100U);
    EXPECT_FALSE(query.open);
    EXPECT_EQ(router.match("GET", "/query").options, nullptr);
    EXPECT_EQ(router.match("GET", "/none").options, nullptr);
    const RouteMatch head = router.match("HEAD", "/healthz");
    ASSERT_NE(head.options, nullptr);
    EXPECT_TRUE(head.options->open);
    EXPECT_TRUE(router.match("POST", "/healthz").open);
}

TEST(Router, FallbackAnswersGetAndHeadOfEveryOtherPath) {
    Router router;
    router.add("GET", "/images", {}, saying("api"));
    router.set_fallback({.open = true}, [](const Request& request) {
        const bool known = request.path == "/";
        return Response{
            .status = known ? 200 : 404, .headers = {}, .body = known ? "page" : "none"};
    });
    EXPECT_EQ(text_of(ask(router, "GET", "/")), "page");
    EXPECT_EQ(text_of(ask(router, "HEAD", "/")), "page");
    EXPECT_EQ(text_of(ask(router, "GET", "/x")), "none");
    EXPECT_EQ(text_of(ask(router, "GET", "/images")), "api");
    EXPECT_TRUE(router.match("GET", "/").options->open);
}

TEST(Router, OtherMethodsOfAFallbacksFileAre405) {
    Router router;
    router.set_fallback({.open = true}, [](const Request& request) {
        return Response{
            .status = request.path == "/" ? 200 : 404, .headers = {}, .body = "x"};
    });
    const Response refused = ask(router, "POST", "/");
    EXPECT_EQ(refused.status, 405);
    EXPECT_EQ(refused.headers.at("Allow"), "GET, HEAD, OPTIONS");
    EXPECT_EQ(ask(router, "POST", "/x").status, 404);
    EXPECT_EQ(ask(router, "OPTIONS", "/").status, 204);
    EXPECT_EQ(router.match("POST", "/").options, nullptr);
    EXPECT_TRUE(router.match("POST", "/").open);
}

TEST(Router, HandlersExceptionIsA500WhoseTextOnlyTheReportHears) {
    Router router;
    router.add("GET", "/throws", {}, [](const Request&) -> Response {
        throw std::runtime_error("secret at /var/lib/x");
    });
    router.add("GET", "/odd", {}, [](const Request&) -> Response { throw 42; });
    Request request;
    request.method = "GET";
    request.path = "/throws";
    request.request_id = "r1";
    std::string heard;
    const Response response = router.dispatch(
        request, [&](const Request&, std::string_view what) { heard = what; });
    EXPECT_EQ(response.status, 500);
    const json problem = json::parse(text_of(response));
    EXPECT_EQ(problem["code"], "internal");
    EXPECT_EQ(problem["request_id"], "r1");
    EXPECT_THAT(text_of(response), testing::Not(testing::HasSubstr("secret")));
    EXPECT_EQ(heard, "secret at /var/lib/x");

    request.path = "/odd";
    EXPECT_EQ(router
                  .dispatch(request,
                            [&](const Request&, std::string_view what) { heard = what; })
                  .status,
              500);
    EXPECT_EQ(heard, "an exception of unknown type");
}

}  // namespace
}  // namespace haarmony::http
