// What a query is refused for: status, code, and the parameter it is about.
#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <vector>

#include "tests/schema/raw_sql.h"
#include "tests/server/api/interface.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

class QueryRefusalTest : public testing::Test {
  protected:
    QueryRefusalTest() { interface_.collection.add(1); }

    void expect_problem(const http::Response& response, const Refusal& expected) {
        EXPECT_EQ(refusal_of(response), expected) << body_of(response);
        EXPECT_EQ(header_of(response, "Content-Type"), "application/problem+json");
        const json problem = json_of(response);
        for (const char* member :
             {"type", "title", "status", "detail", "instance", "code", "request_id"})
            EXPECT_TRUE(problem.contains(member)) << member;
        EXPECT_EQ(body_of(response).find(interface_.collection.folder.path()),
                  std::string::npos);
    }

    Interface interface_;
};

TEST_F(QueryRefusalTest, BadOptionsInTheAddress) {
    const std::vector<std::tuple<std::string, std::string, std::string>> cases{
        {"limit=0", "invalid_argument", "limit"},
        {"limit=1001", "invalid_argument", "limit"},
        {"limit=-1", "invalid_argument", "limit"},
        {"limit=2.0", "invalid_argument", "limit"},
        {"limit=", "invalid_argument", "limit"},
        {"limit=+5", "invalid_argument", "limit"},
        {"limit=5 ", "invalid_argument", "limit"},
        {"limit=99999999999999999999", "invalid_argument", "limit"},
        {"m=0", "invalid_argument", "m"},
        {"m=101", "invalid_argument", "m"},
        {"min_similarity=1.1", "invalid_argument", "min_similarity"},
        {"min_similarity=-0.1", "invalid_argument", "min_similarity"},
        {"min_similarity=nan", "invalid_argument", "min_similarity"},
        {"min_similarity=inf", "invalid_argument", "min_similarity"},
        {"min_similarity=half", "invalid_argument", "min_similarity"},
        {"mask=white", "invalid_argument", "mask"},
        {"profile=crayon", "unknown_profile", "profile"},
        {"profile=", "unknown_profile", "profile"},
        {"autocrop=yes", "invalid_argument", "autocrop"},
        {"kind=video", "invalid_argument", "kind"},
        {"orientations=some", "invalid_argument", "orientations"},
        {"aspect_weight=-1", "invalid_argument", "aspect_weight"},
        {"kind=frame&text=x", "invalid_argument", "text"},
        {"kind=all&tags=x", "invalid_argument", "tags"},
        {"kind=frame&explain=true", "invalid_argument", "explain"},
        {"kind=all&combine=painted", "invalid_argument", "combine"},
        {"explain=maybe", "invalid_argument", "explain"},
        {"aspect_weight=10000.5", "invalid_argument", "aspect_weight"},
        {"aspect_weight=nan", "invalid_argument", "aspect_weight"},
        {"combine=painted,crayon", "unknown_profile", "combine"},
        {"combine=painted,painted", "invalid_argument", "combine"},
        {"combine=1,2,3,4,5,6,7,8,9", "invalid_argument", "combine"},
        {"profile=scanned&combine=painted", "invalid_argument", "profile"},
        {"combine_by=best", "invalid_argument", "combine_by"},
        {"text=...", "invalid_argument", "text"},
        {"text=" + std::string(1025, 'x'), "invalid_argument", "text"},
        {"tags=a,,b", "invalid_argument", "tags"},
        {"seq=" + std::string(257, 'x'), "invalid_argument", "seq"},
        {"foo=1", "unknown_parameter", "foo"},
        {"Limit=1", "unknown_parameter", "Limit"},
        {"limit=1&limit=1", "repeated_parameter", "limit"},
        {"id=1", "repeated_parameter", "id"},
    };
    for (const auto& [option, code, param] : cases) {
        SCOPED_TRACE(option);
        std::string encoded = option;
        for (std::size_t at; (at = encoded.find(' ')) != std::string::npos;)
            encoded.replace(at, 1, "%20");
        for (std::size_t at; (at = encoded.find("=+")) != std::string::npos;)
            encoded.replace(at, 2, "=%2B");
        expect_problem(interface_.get("/query?id=1&" + encoded), {400, code, param});
        if (param == "id") continue;
        expect_problem(interface_.get("/images/1/similar?" + encoded),
                       {400, code, param});
    }
}

TEST_F(QueryRefusalTest, WrongTypesInJson) {
    const std::vector<std::tuple<std::string, json, std::string>> cases{
        {"limit", "20", "invalid_argument"},
        {"limit", 20.0, "invalid_argument"},
        {"limit", nullptr, "invalid_argument"},
        {"limit", true, "invalid_argument"},
        {"limit", 18446744073709551615ULL, "invalid_argument"},
        {"limit", {1}, "invalid_argument"},
        {"m", "7", "invalid_argument"},
        {"min_similarity", "0.5", "invalid_argument"},
        {"min_similarity", nullptr, "invalid_argument"},
        {"profile", 1, "invalid_argument"},
        {"mask", false, "invalid_argument"},
        {"kind", 7, "invalid_argument"},
        {"autocrop", "false", "invalid_argument"},
        {"explain", 0, "invalid_argument"},
        {"aspect_weight", "0", "invalid_argument"},
        {"seq", nullptr, "invalid_argument"},
        {"seq", {1}, "invalid_argument"},
        {"seq", true, "invalid_argument"},
        {"combine", {"painted", 7}, "invalid_argument"},
        {"combine", json::array(), "invalid_argument"},
        {"text", 5, "invalid_argument"},
        {"tags", {{"sea", 1}}, "invalid_argument"},
        {"foo", 1, "unknown_parameter"},
    };
    for (const auto& [member, value, code] : cases) {
        SCOPED_TRACE(member + " = " + value.dump());
        expect_problem(interface_.post_json("/query", {{"id", 1}, {member, value}}),
                       {400, code, member});
    }
}

TEST_F(QueryRefusalTest, BadSources) {
    const std::vector<std::tuple<json, std::string, std::string>> cases{
        {json::object(), "no_source", ""},
        {{{"limit", 5}}, "no_source", ""},
        {{{"id", 1}, {"image", ""}}, "several_sources", "id"},
        {{{"id", 1}, {"url", "http://example.org"}}, "several_sources", "url"},
        {{{"id", 0}}, "invalid_argument", "id"},
        {{{"id", -1}}, "invalid_argument", "id"},
        {{{"id", "1"}}, "invalid_argument", "id"},
        {{{"id", 1.0}}, "invalid_argument", "id"},
        {{{"id", nullptr}}, "invalid_argument", "id"},
        {{{"image", 5}}, "invalid_argument", "image"},
        {{{"image", "not base64!"}}, "invalid_argument", "image"},
        {{{"image", "Zg"}}, "invalid_argument", "image"},
        {{{"signature", "damaged"}}, "invalid_argument", "signature"},
        {{{"signature", 5}}, "invalid_argument", "signature"},
        {{{"signature", {{"average", {0, 0, 0}}}}}, "invalid_argument", "signature"},
        {{{"strokes", "drawing"}}, "invalid_argument", "strokes"},
        {{{"url", 5}}, "invalid_argument", "url"},
    };
    for (const auto& [body, code, param] : cases) {
        SCOPED_TRACE(body.dump());
        expect_problem(interface_.post_json("/query", body), {400, code, param});
    }
    expect_problem(interface_.get("/query"), {400, "no_source", ""});
    expect_problem(interface_.get("/query?id=1&signature=x"),
                   {400, "several_sources", "signature"});
    expect_problem(interface_.get("/query?id=x"), {400, "invalid_argument", "id"});
    expect_problem(interface_.get("/query?strokes=1"),
                   {400, "invalid_argument", "strokes"});
    expect_problem(interface_.get("/query?image=Zg=="),
                   {400, "invalid_argument", "image"});
    expect_problem(interface_.post("/query?id=1", "image/jpeg", text_of(jpeg_scene(1))),
                   {400, "several_sources", "id"});
    expect_problem(interface_.post("/query", "image/jpeg", ""), {400, "no_source", ""});
}

TEST_F(QueryRefusalTest, AnIdThatIsNotThereIsNotFound) {
    expect_problem(interface_.get("/query?id=999"), {404, "not_found", "id"});
    expect_problem(interface_.get("/images/999/similar"), {404, "not_found", "id"});
    expect_problem(interface_.get("/images/x/similar"), {400, "invalid_argument", "id"});
    interface_.send("DELETE", "/images/1");
    expect_problem(interface_.get("/query?id=1"), {404, "not_found", "id"});
}

TEST_F(QueryRefusalTest, BytesThatAreNoPicture) {
    expect_problem(interface_.post("/query", "image/png", "just some text"),
                   {415, "unsupported_format", ""});
    const http::Response pdf = interface_.post("/query", "image/png", "%PDF-1.7 ...");
    expect_problem(pdf, {415, "unsupported_format", ""});
    EXPECT_NE(json_of(pdf)["detail"].get<std::string>().find("PDF"), std::string::npos);
    std::string damaged = text_of(png_of(image::scene(40, 30, 1).view()));
    damaged.resize(80);
    expect_problem(interface_.post("/query", "image/png", damaged),
                   {422, "undecodable", ""});
    expect_problem(interface_.post_json("/query", {{"image", base64(damaged)}}),
                   {422, "undecodable", ""});
    // A header that claims more pixels than the limit; no decoder gets to see it.
    std::string huge = text_of(png_of(image::flat(1, 1, {1, 2, 3}).view()));
    huge.replace(16, 8, std::string("\0\0\xff\xff\0\0\xff\xff", 8));
    EXPECT_EQ(interface_.post("/query", "image/png", huge).status, 413);
}

TEST_F(QueryRefusalTest, BodiesThatAreNotRead) {
    for (const std::string type : {"",
                                   "text/plain",
                                   "application/x-www-form-urlencoded",
                                   "application/octet-stream"})
        expect_problem(interface_.post("/query", type, "body"),
                       {415, "unsupported_media_type", "Content-Type"});
    expect_problem(interface_.post("/query", "application/json", "{"),
                   {400, "invalid_argument", ""});
    expect_problem(interface_.post("/query", "application/json", "[1]"),
                   {400, "invalid_argument", ""});
    expect_problem(interface_.post("/query", "application/json", R"({"id":1,"id":1})"),
                   {400, "invalid_argument", ""});
    expect_problem(interface_.post("/query", "application/json", R"({"id":1,"m":1e999})"),
                   {400, "not_finite", "m"});
    expect_problem(interface_.post("/query", "application/json", R"({"id":1,"m":NaN})"),
                   {400, "not_finite", "m"});
    expect_problem(interface_.post("/query", "multipart/form-data", "--x--"),
                   {400, "invalid_argument", ""});
}

TEST_F(QueryRefusalTest, BadForms) {
    const std::string type(kFormType);
    const std::string jpeg = text_of(jpeg_scene(1));
    expect_problem(interface_.post("/query", type, form_of({{"limit", "3"}})),
                   {400, "no_source", ""});
    expect_problem(interface_.post("/query", type, form_of({{"file", "", "a.jpg"}})),
                   {400, "no_source", "file"});
    expect_problem(
        interface_.post("/query", type, form_of({{"file", jpeg}, {"file", jpeg}})),
        {400, "repeated_parameter", "file"});
    expect_problem(interface_.post(
                       "/query?limit=3", type, form_of({{"file", jpeg}, {"limit", "3"}})),
                   {400, "repeated_parameter", "limit"});
    expect_problem(
        interface_.post("/query", type, form_of({{"file", jpeg}, {"limit", "many"}})),
        {400, "invalid_argument", "limit"});
    expect_problem(interface_.post("/query", type, form_of({{"file", jpeg}, {"x", "1"}})),
                   {400, "unknown_parameter", "x"});
    expect_problem(
        interface_.post("/query", type, form_of({{"file", jpeg}, {"id", "1"}})),
        {400, "several_sources", "id"});
    expect_problem(
        interface_.post("/query", type, form_of({{"file", jpeg}, {"seq", "\xff"}})),
        {400, "invalid_argument", "seq"});
    expect_problem(interface_.post_json("/query?limit=3", {{"id", 1}, {"limit", 3}}),
                   {400, "repeated_parameter", "limit"});
}

TEST_F(QueryRefusalTest, AddressesAreFetchedOnlyWhereThatIsAllowed) {
    expect_problem(interface_.get("/query?url=http://example.org/a.jpg"),
                   {403, "forbidden", "url"});
    expect_problem(interface_.post_json("/images", {{"url", "http://example.org/a.jpg"}}),
                   {403, "forbidden", "url"});
    Interface allowed({}, true);
    EXPECT_EQ(refusal_of(allowed.get("/query?url=ftp://example.org/a.jpg")),
              (Refusal{400, "invalid_argument", "url"}));
    EXPECT_EQ(refusal_of(allowed.get("/query?url=http://127.0.0.1:9/a.jpg")),
              (Refusal{403, "forbidden", "url"}));
}

TEST_F(QueryRefusalTest, ADamagedSignatureCannotBeSearchedWith) {
    const schema::RawConnection raw(interface_.collection.path());
    schema::run_sql(raw.handle(), "UPDATE images SET signature = x'00'");
    expect_problem(interface_.get("/query?id=1"), {422, "undecodable", ""});
    expect_problem(interface_.get("/images/1/signature"), {422, "undecodable", ""});
}

TEST_F(QueryRefusalTest, AnotherMethodIsNotAllowed) {
    const http::Response response = interface_.send("PUT", "/query");
    EXPECT_EQ(response.status, 405);
    EXPECT_EQ(header_of(response, "Allow"), "GET, HEAD, OPTIONS, POST");
}

}  // namespace
}  // namespace haarmony::server
