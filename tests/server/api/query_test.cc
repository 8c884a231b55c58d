// POST /query, GET /query and GET /images/{id}/similar: what they find, and in which forms
// they may be asked.
#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "server/api/query.h"
#include "tests/server/api/interface.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

class QueryTest : public testing::Test {
  protected:
    QueryTest() {
        for (unsigned number = 1; number <= 6; ++number)
            interface_.collection.add(
                number, {"x:" + std::to_string(number), {"even", "all"}, R"({"n":1})"});
    }

    static std::string picture(unsigned number) { return text_of(jpeg_scene(number)); }

    // The first match, which is expected to be the picture itself.
    static std::int64_t first(const http::Response& response) {
        EXPECT_EQ(response.status, 200) << body_of(response);
        const json reply = json_of(response);
        if (!reply.contains("matches") || reply["matches"].empty()) return 0;
        EXPECT_EQ(reply["matches"][0]["distance"], 0.0);
        EXPECT_EQ(reply["matches"][0]["similarity"], 1.0);
        return reply["matches"][0]["id"];
    }

    // Without what differs from one call to the next.
    static json settled(const http::Response& response) {
        json reply = json_of(response);
        reply.erase("took_ms");
        return reply;
    }

    Interface interface_;
};

TEST_F(QueryTest, EveryFormOfTheSamePictureGivesTheSameAnswer) {
    const std::string bytes = picture(3);
    const http::Response raw = interface_.post("/query?limit=4", "image/jpeg", bytes);
    EXPECT_EQ(first(raw), 3);
    const json expected = settled(raw);
    const std::string opaque = expected["query"]["signature"];
    const json open = json_of(interface_.get("/images/3/signature"));
    json bare = open;
    bare.erase("signature");
    bare.erase("low_information");

    const std::vector<http::Response> others{
        interface_.post("/query?limit=4", "IMAGE/PNG; q=1", bytes),
        interface_.post("/query",
                        std::string(kFormType),
                        form_of({{"limit", "4"}, {"file", bytes, "../x.jpg"}})),
        interface_.post_json("/query", {{"image", base64(bytes)}, {"limit", 4}}),
        interface_.post_json("/query", {{"id", 3}, {"limit", 4}}),
        interface_.post_json("/query?limit=4", {{"signature", opaque}}),
        interface_.post_json("/query?limit=4", {{"signature", open}}),
        interface_.post_json("/query?limit=4", {{"signature", bare}}),
        interface_.post("/query?limit=4&id=3", "", ""),
        interface_.get("/query?limit=4&id=3"),
        interface_.get("/query?limit=4&signature=" + opaque),
        interface_.get("/images/3/similar?limit=4"),
    };
    for (std::size_t i = 0; i < others.size(); ++i)
        EXPECT_EQ(settled(others[i]), expected) << "form " << i;
}

TEST_F(QueryTest, AMatchTellsWhatThePictureIs) {
    const json reply = json_of(interface_.get("/query?id=2"));
    EXPECT_EQ(reply["searched"], 6);
    EXPECT_GE(reply["took_ms"], 0.0);
    ASSERT_EQ(reply["matches"].size(), 6U);
    double before = 0;
    for (std::size_t i = 0; i < reply["matches"].size(); ++i) {
        const json& match = reply["matches"][i];
        EXPECT_EQ(match["rank"], i + 1);
        EXPECT_GE(match["distance"], before);
        before = match["distance"];
        EXPECT_EQ(match["orientation"], "identity");
    }
    const json& best = reply["matches"][0];
    EXPECT_EQ(best["id"], 2);
    EXPECT_EQ(best["uri"], "x:2");
    EXPECT_EQ(best["width"], 96);
    EXPECT_EQ(best["height"], 64);
    EXPECT_EQ(best["thumbnail"], "/images/2/thumbnail");
    EXPECT_EQ(best["tags"], (json{"all", "even"}));
    EXPECT_EQ(best["metadata"], (json{{"n", 1}}));
    EXPECT_EQ(reply["query"]["profile"], "painted");
    EXPECT_EQ(reply["query"]["m"], 60);
    EXPECT_EQ(reply["query"]["low_information"], false);
    EXPECT_FALSE(reply.contains("seq"));
}

TEST_F(QueryTest, LimitProfileAndMAreObeyed) {
    EXPECT_EQ(json_of(interface_.get("/query?id=1&limit=2"))["matches"].size(), 2U);
    EXPECT_EQ(json_of(interface_.get("/query?id=1&limit=1000"))["matches"].size(), 6U);
    const json scanned = json_of(interface_.get("/query?id=1&profile=scanned"))["query"];
    EXPECT_EQ(scanned["profile"], "scanned");
    EXPECT_EQ(scanned["m"], 40);
    EXPECT_EQ(json_of(interface_.get("/query?id=1&m=7"))["query"]["m"], 7);
    EXPECT_EQ(json_of(interface_.get("/query?id=1&m=100"))["query"]["m"], 60);
}

TEST_F(QueryTest, MinSimilarityLeavesOutWhatIsLess) {
    const json all = json_of(interface_.get("/query?id=1"))["matches"];
    const double second = all[1]["similarity"];
    const json reply =
        json_of(interface_.post_json("/query", {{"id", 1}, {"min_similarity", second}}));
    ASSERT_FALSE(reply["matches"].empty());
    for (const json& match : reply["matches"])
        EXPECT_GE(match["similarity"].get<double>(), second);
    std::size_t expected = 0;
    for (const json& match : all)
        if (match["similarity"].get<double>() >= second) ++expected;
    EXPECT_EQ(reply["matches"].size(), expected);
}

TEST_F(QueryTest, SeqComesBackWithItsType) {
    for (const json& seq : {json(7), json(-1), json(2.5), json("7"), json("a b")}) {
        const http::Response response =
            interface_.post_json("/query", {{"id", 1}, {"seq", seq}});
        EXPECT_EQ(json_of(response)["seq"], seq);
        EXPECT_EQ(json_of(response)["seq"].is_string(), seq.is_string());
    }
    EXPECT_EQ(json_of(interface_.get("/query?id=1&seq=7"))["seq"], 7);
    EXPECT_EQ(json_of(interface_.get("/query?id=1&seq=7b"))["seq"], "7b");
}

TEST_F(QueryTest, TransparencyCountsOnlyWithMaskNone) {
    image::Pixels picture = image::noise(64, 64, 4, 5);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) picture.at(x, y, 3) = y < 20 ? 255 : 0;
    const std::string png = text_of(png_of(picture.view()));
    const auto signature = [&](const std::string& query) {
        return json_of(
            interface_.post("/query" + query, "image/png", png))["query"]["signature"];
    };
    EXPECT_EQ(signature(""), signature("?mask=alpha"));
    EXPECT_NE(signature(""), signature("?mask=none"));
}

TEST_F(QueryTest, StrokesFindThePictureTheyWerePaintedAfter) {
    // A picture of two colours: what a client would store, and what a hand would paint.
    image::Pixels target = image::flat(64, 64, {200, 30, 20});
    for (int y = 32; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            for (int channel = 0; channel < 3; ++channel)
                target.at(x, y, channel) = channel == 2 ? 220 : 40;
    const http::Response stored =
        interface_.post("/images", "image/png", text_of(png_of(target.view())));
    ASSERT_EQ(stored.status, 201);
    json drawing{{"width", 640}, {"height", 640}, {"background", "#c81e14"}};
    drawing["items"] = {{{"points", {{0, 320}, {640, 320}, {640, 640}, {0, 640}}},
                         {"fill", true},
                         {"color", "#2828dc"}}};
    const json reply = json_of(interface_.post_json("/query", {{"strokes", drawing}}));
    ASSERT_FALSE(reply["matches"].empty()) << reply;
    EXPECT_EQ(reply["matches"][0]["id"], json_of(stored)["id"]);
}

TEST_F(QueryTest, OptionsThatSayNothingNewAreTaken) {
    EXPECT_EQ(interface_
                  .get("/query?id=1&orientations=none&kind=image&autocrop=false&"
                       "aspect_weight=0&explain=false&mask=alpha")
                  .status,
              200);
    EXPECT_EQ(interface_
                  .post_json("/query",
                             {{"id", 1},
                              {"autocrop", false},
                              {"explain", false},
                              {"aspect_weight", 0.0},
                              {"kind", "image"}})
                  .status,
              200);
}

TEST_F(QueryTest, ServerTimingSaysWhatOfTheTimeTookHowLong) {
    const http::Response response = interface_.get("/query?id=1");
    const std::string timing = header_of(response, "Server-Timing");
    const std::regex form(
        R"(search;dur=(\d+\.\d{3}), picture;dur=(\d+\.\d{3}), reply;dur=(\d+\.\d{3}))");
    std::smatch parts;
    ASSERT_TRUE(std::regex_match(timing, parts, form)) << timing;
    // Parts of the whole, each rounded to a thousandth.
    EXPECT_LE(std::stod(parts[1]) + std::stod(parts[2]),
              json_of(response)["took_ms"].get<double>() + 0.001);
    EXPECT_EQ(header_of(interface_.get("/query?id=9999999"), "Server-Timing"), "");
}

TEST_F(QueryTest, OnlyWhatMayDecodeIsCostly) {
    const auto cost = [](const std::string& parameter,
                         const std::string& type,
                         const std::string& body) {
        http::Request request;
        if (!parameter.empty()) request.query = {{parameter, "1"}};
        request.headers["Content-Type"] = type;
        request.body = body;
        return cost_of_query(request);
    };
    const std::string json_type = "application/json; charset=utf-8";
    const std::string signature =
        json_of(interface_.get("/query?id=1"))["query"]["signature"];
    EXPECT_EQ(cost("id", "", ""), http::Cost::kCheap);
    EXPECT_EQ(cost("", json_type, R"({"id": 1, "limit": 3})"), http::Cost::kCheap);
    EXPECT_EQ(cost("", json_type, json{{"signature", signature}}.dump()),
              http::Cost::kCheap);
    EXPECT_EQ(cost("", json_type, json_of(interface_.get("/images/1/signature")).dump()),
              http::Cost::kCheap);
    EXPECT_EQ(cost("url", "", ""), http::Cost::kCostly);
    EXPECT_EQ(cost("", "image/png", "x"), http::Cost::kCostly);
    EXPECT_EQ(cost("", std::string(kFormType), "x"), http::Cost::kCostly);
    EXPECT_EQ(cost("", json_type, R"({"image": ""})"), http::Cost::kCostly);
    EXPECT_EQ(cost("", json_type, R"({"strokes": {}})"), http::Cost::kCostly);
    EXPECT_EQ(cost("", json_type, R"({"url": ""})"), http::Cost::kCostly);
    EXPECT_EQ(cost("", json_type, R"({"ima\u0067e": ""})"), http::Cost::kCostly);
    EXPECT_EQ(cost("", json_type, std::string(20'000, ' ')), http::Cost::kCostly);
}

TEST_F(QueryTest, AnEmptyCollectionIsAnEmptyAnswer) {
    Interface empty;
    const json reply = json_of(empty.post("/query", "image/jpeg", picture(1)));
    EXPECT_EQ(reply["matches"], json::array());
    EXPECT_EQ(reply["searched"], 0);
}

TEST_F(QueryTest, AFlatPictureHasLowInformation) {
    const std::string png = text_of(png_of(image::flat(32, 32, {120, 120, 120}).view()));
    const http::Response response = interface_.post("/query", "image/png", png);
    EXPECT_EQ(json_of(response)["query"]["low_information"], true);
}

}  // namespace
}  // namespace haarmony::server
