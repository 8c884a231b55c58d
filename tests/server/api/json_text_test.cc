#include "server/api/json_text.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <vector>

namespace haarmony::server {
namespace {

using nlohmann::json;

template <typename Write>
std::string written(const Write& write) {
    std::string out;
    JsonObject object(out);
    write(object);
    object.end();
    return out;
}

TEST(JsonText, AnEmptyObjectHasNoMembers) {
    EXPECT_EQ(written([](JsonObject&) {}), "{}");
}

TEST(JsonText, MembersOfEveryKindStandInTheirOrder) {
    const std::vector<std::string> tags{"a", "b \"c\""};
    EXPECT_EQ(
        written([&](JsonObject& object) {
            object.text("text", "x/y")
                .text_or_null("some", "z")
                .text_or_null("none", "")
                .texts("tags", tags)
                .texts("no_tags", {})
                .integer("integer", -12)
                .number("number", 0.25)
                .boolean("yes", true)
                .boolean("no", false)
                .json("json", R"({"a":[1]})");
        }),
        R"({"text":"x/y","some":"z","none":null,"tags":["a","b \"c\""],"no_tags":[],)"
        R"("integer":-12,"number":0.25,"yes":true,"no":false,"json":{"a":[1]}})");
}

TEST(JsonText, AnObjectIsAppendedToWhatIsThere) {
    std::string out = "[";
    JsonObject(out).integer("a", 1).end();
    EXPECT_EQ(out, R"([{"a":1})");
}

// Every byte, then runs of them: escapes, UTF-8, and what is neither.
TEST(JsonText, StringsAreThoseOfTheLibrary) {
    std::mt19937 random(5);
    std::vector<std::string> texts{
        "", "\xc3\xa4\xe2\x82\xac", "\xc3", "a\xffz", "\\u0041"};
    for (int byte = 0; byte < 256; ++byte) texts.emplace_back(1, static_cast<char>(byte));
    for (int i = 0; i < 300; ++i) {
        std::string text;
        for (int length = static_cast<int>(random() % 20); length > 0; --length)
            text += static_cast<char>(random());
        texts.push_back(text);
    }
    for (const std::string& text : texts)
        EXPECT_EQ(
            written([&](JsonObject& object) { object.text("t", text); }),
            (json{{"t", text}}).dump(-1, ' ', false, json::error_handler_t::replace));
}

TEST(JsonText, NumbersAreReadBackBitForBit) {
    std::mt19937_64 random(6);
    std::vector<double> numbers{0.0,
                                -0.0,
                                1.0,
                                1e15,
                                1e21,
                                1e300,
                                5e-324,
                                0.1,
                                -2.5,
                                std::numeric_limits<double>::max(),
                                std::numeric_limits<double>::lowest()};
    while (numbers.size() < 2000)
        if (const auto number = std::bit_cast<double>(random()); std::isfinite(number))
            numbers.push_back(number);
    for (const double number : numbers) {
        const json read = json::parse(
            written([&](JsonObject& object) { object.number("n", number); }))["n"];
        EXPECT_TRUE(read.is_number_float()) << number;
        EXPECT_EQ(std::bit_cast<std::uint64_t>(read.get<double>()),
                  std::bit_cast<std::uint64_t>(number))
            << number;
    }
}

TEST(JsonText, IntegersAreReadBackAndWhatIsNotFiniteIsNull) {
    using Limits = std::numeric_limits<std::int64_t>;
    for (const std::int64_t integer : {Limits::min(), std::int64_t{0}, Limits::max()})
        EXPECT_EQ(json::parse(written(
                      [&](JsonObject& object) { object.integer("i", integer); }))["i"],
                  json(integer));
    for (const double number : {std::numeric_limits<double>::infinity(),
                                -std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::quiet_NaN()})
        EXPECT_EQ(written([&](JsonObject& object) { object.number("n", number); }),
                  R"({"n":null})");
}

}  // namespace
}  // namespace haarmony::server
