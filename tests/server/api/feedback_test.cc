// /feedback: logging, listing, exporting and forgetting training pairs.
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "server/api/training_pair_json.h"
#include "tests/server/api/interface.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

json drawing() {
    return {{"width", 40},
            {"height", 30},
            {"items",
             {{{"points", {{1, 2}, {30, 20}}}, {"width", 8}, {"color", "#c04020"}}}}};
}

std::string all_of(http::Response response) {
    auto* source = std::get_if<http::ChunkSource>(&response.body);
    if (source == nullptr) return {};
    std::string text;
    while (const auto chunk = (*source)()) text += *chunk;
    return text;
}

std::vector<json> lines_of(const std::string& text) {
    std::vector<json> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        lines.push_back(json::parse(line));
    return lines;
}

class FeedbackTest : public testing::Test {
  protected:
    FeedbackTest() {
        interface_.collection.add(1);
        interface_.collection.add(2);
    }

    json signature(int id) {
        return json_of(interface_.get("/images/" + std::to_string(id) + "/signature"));
    }
    std::string opaque(int id) { return signature(id)["signature"]; }
    std::int64_t log(const json& pair) {
        const http::Response response = interface_.post_json("/feedback", pair);
        EXPECT_EQ(response.status, 201) << body_of(response);
        return json_of(response)["id"];
    }
    json listed(const std::string& parameters = "") {
        return json_of(interface_.get("/feedback" + parameters))["items"];
    }

    Interface interface_;
};

TEST_F(FeedbackTest, WhatIsLoggedIsListed) {
    const std::int64_t id = log({{"signature", opaque(2)},
                                 {"strokes", drawing()},
                                 {"target", 1},
                                 {"kind", "scanned"},
                                 {"seconds", 7.5}});
    const json items = listed();
    ASSERT_EQ(items.size(), 1U);
    EXPECT_EQ(items[0]["id"], id);
    EXPECT_EQ(items[0]["signature"], opaque(2));
    EXPECT_EQ(items[0]["strokes"], drawing());
    EXPECT_EQ(items[0]["target"], 1);
    EXPECT_EQ(items[0]["kind"], "scanned");
    EXPECT_EQ(items[0]["seconds"], 7.5);
    EXPECT_TRUE(items[0]["created_at"].is_string());
}

TEST_F(FeedbackTest, EveryFormOfASignatureIsTheSamePair) {
    json open = signature(2);
    open.erase("signature");
    for (const json& form : std::vector<json>{opaque(2), signature(2), open})
        log({{"signature", form}, {"target", 1}});
    for (const json& item : listed()) {
        EXPECT_EQ(item["signature"], opaque(2));
        EXPECT_TRUE(item["strokes"].is_null());
        EXPECT_TRUE(item["seconds"].is_null());
        EXPECT_EQ(item["kind"], "painted");
    }
}

TEST_F(FeedbackTest, PagesAndKindsNarrowTheList) {
    std::vector<std::int64_t> painted;
    for (int i = 0; i < 5; ++i) {
        log({{"signature", opaque(1)}, {"target", 2}, {"kind", "scanned"}});
        painted.push_back(log({{"strokes", drawing()}, {"target", 2}}));
    }
    std::vector<std::int64_t> ids;
    std::string cursor;
    int pages = 0;
    do {
        const json page =
            json_of(interface_.get("/feedback?kind=painted&limit=2" +
                                   (cursor.empty() ? "" : "&cursor=" + cursor)));
        for (const json& item : page["items"]) ids.push_back(item["id"]);
        cursor = page["next_cursor"].is_null() ? "" : page["next_cursor"];
        ++pages;
    } while (!cursor.empty());
    EXPECT_EQ(ids, painted);
    EXPECT_EQ(pages, 3);
    EXPECT_EQ(listed().size(), 10U);
    EXPECT_TRUE(listed("?kind=nothing").empty());
}

TEST_F(FeedbackTest, AForgottenPairIsGone) {
    const std::string target =
        "/feedback/" + std::to_string(log({{"strokes", drawing()}, {"target", 1}}));
    EXPECT_EQ(interface_.send("DELETE", target).status, 204);
    EXPECT_TRUE(listed().empty());
    EXPECT_EQ(refusal_of(interface_.send("DELETE", target)),
              (Refusal{404, "not_found", "id"}));
    EXPECT_EQ(refusal_of(interface_.send("DELETE", "/feedback/x")),
              (Refusal{400, "invalid_argument", "id"}));
    EXPECT_EQ(refusal_of(interface_.send("DELETE", target + "?x=1")),
              (Refusal{400, "unknown_parameter", "x"}));
}

TEST_F(FeedbackTest, WhatIsExportedCanBeLoggedAgain) {
    log({{"signature", opaque(1)}, {"target", 2}, {"seconds", 3}});
    log({{"strokes", drawing()}, {"target", 1}, {"kind", "scanned"}});
    const http::Response response = interface_.get("/feedback/export");
    EXPECT_EQ(header_of(response, "Content-Type"), "application/jsonl");
    const std::vector<json> lines = lines_of(all_of(response));
    ASSERT_EQ(lines.size(), 2U);
    for (const json& line : lines) {
        EXPECT_TRUE(parse_pair(line.dump())) << line;
        log(line);
    }
    std::vector<json> twice = lines;
    twice.insert(twice.end(), lines.begin(), lines.end());
    EXPECT_EQ(lines_of(all_of(interface_.get("/feedback/export"))), twice);
    EXPECT_EQ(lines_of(all_of(interface_.get("/feedback/export?kind=scanned"))),
              (std::vector<json>{lines[1], lines[1]}));
}

TEST_F(FeedbackTest, AnExportIsWholeAcrossItsPages) {
    const std::string bytes = opaque(1);
    constexpr int kPairs = 230;  // three pages
    for (int i = 0; i < kPairs; ++i)
        log({{"signature", bytes}, {"target", 2}, {"seconds", i}});
    const std::vector<json> lines = lines_of(all_of(interface_.get("/feedback/export")));
    ASSERT_EQ(lines.size(), std::size_t{kPairs});
    for (int i = 0; i < kPairs; ++i) EXPECT_EQ(lines[i]["seconds"], i);
}

TEST_F(FeedbackTest, EveryBadMemberIsNamed) {
    struct Case {
        json pair;
        Refusal refusal;
    };
    const json strokes = drawing();
    json empty = strokes;
    empty["items"] = json::array();
    json colorless = strokes;
    colorless["items"][0].erase("color");
    const std::string text = opaque(1);
    const auto bad = [](const std::string& param) {
        return Refusal{400, "invalid_argument", param};
    };
    const std::vector<Case> cases{
        {{{"target", 1}}, {400, "no_source", "signature"}},
        {{{"signature", text}}, bad("target")},
        {{{"signature", text}, {"target", 0}}, bad("target")},
        {{{"signature", text}, {"target", "1"}}, bad("target")},
        {{{"signature", text}, {"target", 77}}, {404, "not_found", "target"}},
        {{{"signature", "no"}, {"target", 1}}, bad("signature")},
        {{{"signature", 1}, {"target", 1}}, bad("signature")},
        {{{"strokes", 1}, {"target", 1}}, bad("strokes")},
        {{{"strokes", empty}, {"target", 1}}, {422, "nothing_painted", "strokes"}},
        {{{"strokes", colorless}, {"target", 1}}, bad("strokes.items[0].color")},
        {{{"signature", text}, {"target", 1}, {"kind", ""}}, bad("kind")},
        {{{"signature", text}, {"target", 1}, {"kind", "A"}}, bad("kind")},
        {{{"signature", text}, {"target", 1}, {"kind", 1}}, bad("kind")},
        {{{"signature", text}, {"target", 1}, {"seconds", -1}}, bad("seconds")},
        {{{"signature", text}, {"target", 1}, {"second", 1}},
         {400, "unknown_parameter", "second"}},
    };
    for (const Case& wrong : cases)
        EXPECT_EQ(refusal_of(interface_.post_json("/feedback", wrong.pair)),
                  wrong.refusal)
            << wrong.pair.dump().substr(0, 200);
    EXPECT_EQ(refusal_of(interface_.post("/feedback", "image/png", "x")),
              (Refusal{415, "unsupported_format", "file"}));
    EXPECT_EQ(interface_.post("/feedback", "application/json", "[]").status, 400);
    EXPECT_TRUE(listed().empty());
}

TEST_F(FeedbackTest, BadParametersOfAListAreNamed) {
    for (const std::string path : {"/feedback", "/feedback/export"}) {
        EXPECT_EQ(refusal_of(interface_.get(path + "?kind=A%20b")),
                  (Refusal{400, "invalid_argument", "kind"}));
        EXPECT_EQ(refusal_of(interface_.get(path + "?x=1")),
                  (Refusal{400, "unknown_parameter", "x"}));
        EXPECT_EQ(refusal_of(interface_.get(path + "?kind=a&kind=b")),
                  (Refusal{400, "repeated_parameter", "kind"}));
    }
    for (const std::string bad : {"limit=0", "limit=1001", "cursor=0", "cursor=x"})
        EXPECT_EQ(refusal_of(interface_.get("/feedback?" + bad)),
                  (Refusal{400, "invalid_argument", bad.substr(0, bad.find('='))}));
}

// Written by others, or by a version that knew more.
TEST_F(FeedbackTest, WhatCannotBeReadIsShownAsNothingAndNotExported) {
    log({{"signature", opaque(1)}, {"target", 2}});
    log({{"strokes", drawing()}, {"target", 2}});
    log({{"signature", opaque(1)}, {"target", 1}});
    interface_.sql("UPDATE feedback SET signature = x'00' WHERE id = 1");
    interface_.sql("UPDATE feedback SET strokes = '{\"a\":1}' WHERE id = 2");
    const json items = listed();
    ASSERT_EQ(items.size(), 3U);
    EXPECT_TRUE(items[0]["signature"].is_null());
    EXPECT_EQ(items[1]["strokes"], json({{"a", 1}}));
    const std::vector<json> lines = lines_of(all_of(interface_.get("/feedback/export")));
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0]["target"], 1);
}

TEST_F(FeedbackTest, AFailureOfTheDatabaseIsAFailureOfTheServer) {
    const std::string text = opaque(1);
    http::Response response;
    for (int i = 0; i < 101; ++i) log({{"signature", text}, {"target", 2}});
    response = interface_.get("/feedback/export");
    interface_.sql("ALTER TABLE feedback RENAME TO gone");
    EXPECT_EQ(interface_.get("/feedback").status, 500);
    EXPECT_EQ(interface_.get("/feedback/export").status, 500);
    EXPECT_EQ(interface_.send("DELETE", "/feedback/1").status, 500);
    EXPECT_EQ(
        interface_.post_json("/feedback", {{"signature", text}, {"target", 2}}).status,
        500);
    // One that has begun breaks off, so that nobody takes it for whole.
    EXPECT_THROW((void)all_of(response), std::runtime_error);
}

}  // namespace
}  // namespace haarmony::server
