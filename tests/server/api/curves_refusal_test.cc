// What no curve can be, and what is said about it.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/server/api/drawn_curves.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

// `changes` are made to a request that is answered; null takes a member away.
struct Wrong {
    std::string operation;
    std::string changes;  // a merge patch
    Refusal refusal;
};

std::ostream& operator<<(std::ostream& out, const Wrong& wrong) {
    return out << wrong.operation << ' ' << wrong.changes;
}

// Level 2 in x, y and thickness.
json right(const std::string& operation) {
    const json points = random_points(7, 3, 1);
    json request{{"points", points}};
    if (operation == "smooth") request["level"] = 1.5;
    if (operation == "edit") {
        request["level"] = 1;
        request["control"] = {{"index", 1}, {"delta", {1, 2, 3}}};
    }
    if (operation == "character") request["character"] = {{"points", points}};
    if (operation == "approximate") request["tolerance"] = 3;
    if (operation == "evaluate") request["u"] = {0, 0.5};
    if (operation == "reconstruct")
        request = {{"coarse", random_points(4, 2, 3)},
                   {"details", {{{1, 2}}, {{3, 4}, {5, 6}}}}};
    return request;
}

class WrongCurves : public testing::TestWithParam<Wrong> {};

TEST_P(WrongCurves, AreRefused) {
    const Wrong& wrong = GetParam();
    Interface interface;
    const std::string target = "/curve/" + wrong.operation;
    json request = right(wrong.operation);
    EXPECT_EQ(interface.post_json(target, request).status, 200);
    request.merge_patch(json::parse(wrong.changes));
    const http::Response response = interface.post_json(target, request);
    EXPECT_EQ(refusal_of(response), wrong.refusal) << body_of(response);
}

const std::vector<Wrong> kWrong{
    // Of every curve.
    {"decompose", R"({"points":null})", {400, "invalid_argument", "points"}},
    {"decompose", R"({"samples":[[1,2],[3,4]]})", {400, "invalid_argument", "points"}},
    {"decompose",
     R"({"points":null,"samples":[[1,2],[3,4]],"d":"M0 0L1 1"})",
     {400, "invalid_argument", "samples"}},
    {"decompose", R"({"colour":1})", {400, "unknown_parameter", "colour"}},
    {"decompose", R"({"points":7})", {400, "invalid_argument", "points"}},
    {"decompose", R"({"points":[1,2,3,4]})", {400, "invalid_argument", "points[0]"}},
    {"decompose",
     R"({"points":[[1,2],[1,2],[1,"2"],[1,2]]})",
     {400, "invalid_argument", "points[2][1]"}},
    {"decompose",
     R"({"points":[[1,2],[1,2],[1,null],[1,2]]})",
     {400, "invalid_argument", "points[2][1]"}},
    {"decompose",
     R"({"points":[[1,2],7,[1,1],[1,2]]})",
     {400, "invalid_argument", "points[1]"}},
    {"decompose",
     R"({"points":[[1,2],[1,2],[1,2,3],[1,2]]})",
     {422, "mixed_dimensions", "points[2]"}},
    {"decompose",
     R"({"points":[[],[],[],[]]})",
     {422, "dimension_out_of_range", "points[0]"}},
    {"decompose",
     R"({"points":[[1,2,3,4,5,6,7,8,9]]})",
     {422, "dimension_out_of_range", "points[0]"}},
    {"decompose",
     R"({"points":[[1,2],[1,2],[1,2],[1,-2e100]]})",
     {422, "out_of_range", "points[3][1]"}},
    {"decompose", R"({"points":[[1,2],[3,4],[5,6]]})", {422, "too_few_points", "points"}},
    {"decompose", R"({"points":[]})", {422, "too_few_points", "points"}},
    {"decompose",
     R"({"points":[[1,2],[3,4]],"closed":true})",
     {422, "too_few_points", "points"}},
    {"decompose",
     R"({"points":null,"samples":[[1,2]]})",
     {422, "too_few_samples", "samples"}},
    {"decompose", R"({"points":null,"d":"M0 0Lx"})", {422, "bad_path", "d"}},
    {"decompose", R"({"points":null,"d":5})", {400, "invalid_argument", "d"}},
    {"decompose",
     R"({"points":null,"d":"M0 0L9 9","subpath":1})",
     {422, "out_of_range", "subpath"}},
    {"decompose", R"({"subpath":0})", {400, "invalid_argument", "subpath"}},
    {"decompose", R"({"closed":1})", {400, "invalid_argument", "closed"}},
    {"decompose", R"({"fit_tolerance":0})", {400, "invalid_argument", "fit_tolerance"}},
    {"decompose", R"({"fit_tolerance":-1})", {400, "invalid_argument", "fit_tolerance"}},
    {"decompose", R"({"corners":0.5})", {400, "invalid_argument", "corners"}},
    {"decompose", R"({"corners":"find"})", {400, "invalid_argument", "corners"}},
    {"decompose", R"({"corners":["a"]})", {400, "invalid_argument", "corners[0]"}},
    {"decompose", R"({"corners":[0.5,1.5]})", {422, "out_of_range", "corners[1]"}},
    {"decompose", R"({"frame":"bent"})", {400, "invalid_argument", "frame"}},
    // Of one operation.
    {"reconstruct", R"({"coarse":null})", {400, "invalid_argument", "coarse"}},
    {"reconstruct", R"({"details":null})", {400, "invalid_argument", "details"}},
    {"reconstruct", R"({"details":{}})", {400, "invalid_argument", "details"}},
    {"reconstruct", R"({"points":[]})", {400, "unknown_parameter", "points"}},
    {"reconstruct", R"({"coarse":[[1,2],[3,4],[5,6]]})", {422, "row_count", "coarse"}},
    {"reconstruct", R"({"closed":true})", {422, "row_count", "coarse"}},
    {"reconstruct", R"({"details":[[[1,2],[3,4]]]})", {422, "row_count", "details[0]"}},
    {"reconstruct",
     R"({"details":[[[1,2,3]]]})",
     {422, "mixed_dimensions", "details[0]"}},
    {"reconstruct",
     R"({"details":[0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20]})",
     {422, "level_out_of_range", "details"}},
    {"reconstruct", R"({"level":2.5})", {422, "level_out_of_range", "level"}},
    {"smooth", R"({"level":null})", {400, "invalid_argument", "level"}},
    {"smooth", R"({"level":"1"})", {400, "invalid_argument", "level"}},
    {"smooth", R"({"level":2.1})", {422, "level_out_of_range", "level"}},
    {"smooth", R"({"level":-0.5})", {422, "level_out_of_range", "level"}},
    {"smooth", R"({"pin_ends":"yes"})", {400, "invalid_argument", "pin_ends"}},
    {"edit", R"({"level":null})", {400, "invalid_argument", "level"}},
    {"edit", R"({"portion":5})", {400, "invalid_argument", "level"}},
    {"edit", R"({"portion_unit":"length"})", {400, "invalid_argument", "portion_unit"}},
    {"edit", R"({"level":null,"portion":0})", {400, "invalid_argument", "portion"}},
    {"edit",
     R"({"level":null,"portion":1,"portion_unit":"mile"})",
     {400, "invalid_argument", "portion_unit"}},
    {"edit",
     R"({"level":null,"portion":1,"control":{"index":7}})",
     {422, "out_of_range", "control.index"}},
    {"edit", R"({"level":3})", {422, "level_out_of_range", "level"}},
    {"edit", R"({"control":null})", {400, "invalid_argument", "control"}},
    {"edit",
     R"({"point":{"u":0,"delta":[1,1,1]}})",
     {400, "invalid_argument", "control"}},
    {"edit", R"({"control":[1]})", {400, "invalid_argument", "control"}},
    {"edit", R"({"control":{"index":null}})", {400, "invalid_argument", "control.index"}},
    {"edit", R"({"control":{"index":1.5}})", {400, "invalid_argument", "control.index"}},
    {"edit", R"({"control":{"index":5}})", {422, "out_of_range", "control.index"}},
    {"edit", R"({"control":{"index":-1}})", {422, "out_of_range", "control.index"}},
    {"edit", R"({"control":{"delta":null}})", {400, "invalid_argument", "control.delta"}},
    {"edit",
     R"({"control":{"delta":[1,"2",3]}})",
     {400, "invalid_argument", "control.delta[1]"}},
    {"edit",
     R"({"control":{"delta":[1,2]}})",
     {422, "mixed_dimensions", "control.delta"}},
    {"edit", R"({"control":{"u":0}})", {400, "unknown_parameter", "control.u"}},
    {"edit", R"({"drag":"full"})", {400, "invalid_argument", "drag"}},
    {"edit",
     R"({"control":null,"point":{"delta":[1,2,3]}})",
     {400, "invalid_argument", "point.u"}},
    {"edit",
     R"({"control":null,"point":{"u":0.5,"near":[1,2],"delta":[1,2,3]}})",
     {400, "invalid_argument", "point.u"}},
    {"edit",
     R"({"control":null,"point":{"near":[1],"delta":[1,2,3]}})",
     {400, "invalid_argument", "point.near"}},
    {"edit",
     R"({"control":null,"point":{"u":1.5,"delta":[1,2,3]}})",
     {422, "out_of_range", "point.u"}},
    {"edit",
     R"({"points":[[1],[2],[3],[4]],"level":0,"control":null,
         "point":{"near":[1,2],"delta":[1]}})",
     {422, "dimension_out_of_range", "point.near"}},
    {"character", R"({"character":null})", {400, "invalid_argument", "character"}},
    {"character", R"({"character":5})", {400, "invalid_argument", "character"}},
    {"character", R"({"character":"none"})", {404, "not_found", "character"}},
    {"character",
     R"({"character":{"points":[[1,2]]}})",
     {422, "too_few_points", "character.points"}},
    {"character",
     R"({"character":{"size":1}})",
     {400, "unknown_parameter", "character.size"}},
    {"character",
     R"({"character":{"points":null,"coarse":[[1,2]],"details":[]}})",
     {422, "row_count", "character.coarse"}},
    {"character", R"({"from_level":1.5})", {400, "invalid_argument", "from_level"}},
    {"character", R"({"from_level":3})", {422, "level_out_of_range", "from_level"}},
    {"character", R"({"strength":"much"})", {400, "invalid_argument", "strength"}},
    {"fit", R"({"tolerance":0})", {400, "invalid_argument", "tolerance"}},
    {"fit", R"({"tolerance":1,"level":2})", {400, "invalid_argument", "level"}},
    {"fit",
     R"({"tolerance":1,"fit_tolerance":2})",
     {400, "invalid_argument", "fit_tolerance"}},
    {"fit", R"({"level":13})", {422, "level_out_of_range", "level"}},
    {"fit", R"({"level":1,"closed":true})", {422, "level_out_of_range", "level"}},
    {"fit", R"({"spacing":"wide"})", {400, "invalid_argument", "spacing"}},
    {"approximate", R"({"tolerance":null})", {400, "invalid_argument", "tolerance"}},
    {"approximate", R"({"tolerance":0})", {400, "invalid_argument", "tolerance"}},
    {"approximate", R"({"mode":"g2"})", {400, "invalid_argument", "mode"}},
    {"approximate", R"({"format":"pdf"})", {400, "invalid_argument", "format"}},
    {"evaluate", R"({"u":null})", {400, "invalid_argument", "u"}},
    {"evaluate", R"({"count":3})", {400, "invalid_argument", "u"}},
    {"evaluate", R"({"u":null,"count":0})", {400, "invalid_argument", "count"}},
    {"evaluate", R"({"u":[0,1.01]})", {422, "out_of_range", "u[1]"}},
    {"evaluate", R"({"level":9})", {422, "level_out_of_range", "level"}},
    {"match", R"({"limit":0})", {400, "invalid_argument", "limit"}},
};

INSTANTIATE_TEST_SUITE_P(Each, WrongCurves, testing::ValuesIn(kWrong));

TEST(CurvesRefusal, ANumberThatIsNotFiniteIsNamedWithItsPlace) {
    Interface interface;
    for (const std::string number : {"1e999", "-1e400", "NaN", "Infinity", "-Infinity"}) {
        const http::Response response =
            interface.post("/curve/decompose",
                           "application/json",
                           R"({"points":[[0,1],[2,3],[4,)" + number + "],[6,7]]}");
        EXPECT_EQ(refusal_of(response), (Refusal{422, "not_finite", "points[2][1]"}));
        EXPECT_NE(body_of(response).find(number), std::string::npos);
    }
}

TEST(CurvesRefusal, MalformedBodiesAndOtherTypes) {
    Interface interface;
    EXPECT_EQ(refusal_of(interface.post("/curve/smooth", "application/json", "{")),
              (Refusal{400, "invalid_argument", ""}));
    EXPECT_EQ(refusal_of(interface.post("/curve/smooth", "application/json", "[]")),
              (Refusal{400, "invalid_argument", ""}));
    EXPECT_EQ(refusal_of(interface.post("/curve/smooth", "image/png", "x")),
              (Refusal{415, "unsupported_format", "file"}));
    EXPECT_EQ(refusal_of(interface.post("/curve/smooth", "text/plain", "x")),
              (Refusal{415, "unsupported_media_type", "Content-Type"}));
    EXPECT_EQ(refusal_of(interface.send("POST", "/curve/smooth?points=1")),
              (Refusal{400, "invalid_argument", "points"}));
    EXPECT_EQ(interface.get("/curve/smooth").status, 405);
}

TEST(CurvesRefusal, MorePointsThanTheFinestLevelHas) {
    Interface interface;
    std::string body = R"({"points":[[1])";
    constexpr std::size_t kMost = (std::size_t{1} << 20) + 3;
    body.reserve(5 * kMost);
    for (std::size_t i = 0; i < kMost; ++i) body += ",[1]";
    EXPECT_EQ(
        refusal_of(interface.post("/curve/decompose", "application/json", body + "]}")),
        (Refusal{422, "too_many_points", "points"}));
}

}  // namespace
}  // namespace haarmony::server
