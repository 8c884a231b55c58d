#include "server/http/json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <string>

namespace haarmony::http {
namespace {

using nlohmann::json;
using testing::HasSubstr;

std::string complaint(const std::string& text) {
    const auto parsed = parse_json(text);
    EXPECT_FALSE(parsed) << text;
    if (parsed) return {};
    EXPECT_EQ(parsed.error().code, ErrorCode::kInvalidArgument);
    return parsed.error().message;
}

std::string nested(int depth) {
    return std::string(static_cast<std::size_t>(depth), '[') +
           std::string(static_cast<std::size_t>(depth), ']');
}

json random_value(std::mt19937& random, int depth) {
    switch (random() % (depth > 0 ? 8U : 6U)) {
        case 0:
            return nullptr;
        case 1:
            return random() % 2 == 0;
        case 2:
            return static_cast<std::int64_t>(random()) - 2'000'000'000;
        case 3:
            return static_cast<double>(random()) / 977.0;
        case 4:
            return "text \"\\\n\xC3\xA9" + std::to_string(random() % 100);
        case 5:
            return std::uint64_t{1} << 63U;
        case 6: {
            json array = json::array();
            for (auto i = random() % 5; i > 0; --i) {
                array.push_back(random_value(random, depth - 1));
            }
            return array;
        }
        default: {
            json object = json::object();
            for (auto i = random() % 5; i > 0; --i) {
                object["k" + std::to_string(i)] = random_value(random, depth - 1);
            }
            return object;
        }
    }
}

TEST(Json, AgreesWithTheLibrarysOwnParser) {
    std::mt19937 random(20);
    for (int i = 0; i < 500; ++i) {
        const std::string text = random_value(random, 5).dump();
        const auto parsed = parse_json(text);
        ASSERT_TRUE(parsed) << text << ": " << parsed.error().message;
        EXPECT_EQ(*parsed, json::parse(text)) << text;
    }
}

TEST(Json, EveryTruncationIsRefused) {
    const std::string text = R"({"a":[1,{"b":"c\u00e9"},true,null],"d":{"e":-1.5e3}})";
    for (std::size_t size = 0; size < text.size(); ++size) {
        EXPECT_THAT(complaint(text.substr(0, size)), HasSubstr("malformed JSON")) << size;
    }
}

TEST(Json, MalformedTextIsRefusedWithItsPlace) {
    EXPECT_THAT(complaint("{\"a\":\n  tru}"), HasSubstr("line 2, column 6"));
    EXPECT_THAT(complaint("[1,]"), HasSubstr("line 1, column 4"));
    EXPECT_THAT(complaint("1 2"), HasSubstr("line 1, column 3"));
}

TEST(Json, NumbersThatAreNotFiniteAreRefused) {
    for (const char* text :
         {"NaN", "Infinity", "-Infinity", "[1e999]", "-1e400", "[nan]"}) {
        complaint(text);
    }
    EXPECT_THAT(complaint("[1e999]"), HasSubstr("1e999"));
}

TEST(Json, ThePlaceOfANumberThatIsNotFiniteIsNamed) {
    const auto place = [](const std::string& text) {
        return parse_json(text).error().param;
    };
    EXPECT_EQ(place(R"({"a":1,"points":[[0,1],[2,1e999]]})"), "points[1][1]");
    EXPECT_EQ(place(R"({"points":[[NaN,1]]})"), "points[0][0]");
    EXPECT_EQ(place(R"({"a":{"u":-Infinity}})"), "a.u");
    EXPECT_EQ(place("[[],[1],-1e400]"), "[2]");
    EXPECT_EQ(place(R"({"a":tru})"), "");
    EXPECT_EQ(place(R"({"a":1e-400x})"), "");
    EXPECT_TRUE(parse_json("[1e-400]"));
}

TEST(Json, MemberThatAppearsTwiceIsNamed) {
    EXPECT_EQ(complaint(R"({"limit":1,"x":{"limit":2},"limit":3})"),
              "JSON member 'limit' appears twice");
    EXPECT_TRUE(parse_json(R"([{"a":1},{"a":2}])"));
}

TEST(Json, DepthIsLimited) {
    EXPECT_TRUE(parse_json(nested(kMaxJsonDepth)));
    EXPECT_EQ(complaint(nested(kMaxJsonDepth + 1)),
              "JSON is nested deeper than " + std::to_string(kMaxJsonDepth));
    complaint(nested(1'000'000));
}

TEST(Json, TextThatIsNotUtf8IsRefused) { complaint("\"\xFF\""); }

TEST(Json, ComplaintAboutALongTextIsShort) {
    EXPECT_LT(complaint("\"" + std::string(100'000, 'x') + "\n\"").size(), 400U);
    const std::string key(100'000, 'k');
    EXPECT_LT(complaint("{\"" + key + "\":1,\"" + key + "\":1}").size(), 400U);
}

TEST(Json, ResponseReplacesBytesThatAreNotUtf8) {
    const Response response = json_response(201, json{{"uri", "a\xFFz"}});
    EXPECT_EQ(response.status, 201);
    EXPECT_EQ(response.headers.at("Content-Type"), "application/json");
    EXPECT_EQ(json::parse(std::get<std::string>(response.body))["uri"], "a\xEF\xBF\xBDz");
}

}  // namespace
}  // namespace haarmony::http
