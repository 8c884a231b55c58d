// Characters and strokes that have names.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/curve/built_in_character.h"
#include "tests/server/api/drawn_curves.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

// A word in a handwriting of its own: waves of three lengths and sizes.
json word(unsigned number, double x, double size) {
    json samples = json::array();
    for (int i = 0; i <= 200; ++i) {
        const double t = i / 200.0;
        const double wave = std::sin((7 + 4 * number) * t) + 0.5 * std::sin(31 * t) +
                            0.4 * std::cos((50 + 9 * number) * t);
        samples.push_back({x + size * 4 * t, size * wave});
    }
    return samples;
}

class CurveLibraryTest : public testing::Test {
  protected:
    http::Response put(const std::string& target, const json& body) {
        return interface_.send(
            "PUT", target, {{"Content-Type", "application/json"}}, body.dump());
    }
    // Of all pages of a list, one after the other.
    std::vector<std::string> names(const std::string& list, int limit) {
        std::vector<std::string> found;
        std::string cursor;
        do {
            const json page = json_of(
                interface_.get(list + "?limit=" + std::to_string(limit) +
                               (cursor.empty() ? std::string() : "&cursor=" + cursor)));
            EXPECT_LE(page["items"].size(), static_cast<std::size_t>(limit));
            for (const json& item : page["items"]) found.push_back(item["name"]);
            cursor = page["next_cursor"].is_null() ? "" : page["next_cursor"];
            if (!cursor.empty()) {
                EXPECT_EQ(cursor, found.back());
            }
        } while (!cursor.empty());
        return found;
    }
    std::vector<std::string> names() { return names("/curve/characters", 1000); }

    Interface interface_;
    json curve_{{"points", random_points(19, 2, 1)}};
};

TEST_F(CurveLibraryTest, BuiltInCharactersAreThereAndStay) {
    const auto built_in = curve::built_in_characters();
    ASSERT_FALSE(built_in.empty());
    ASSERT_EQ(names().size(), built_in.size());
    for (const curve::BuiltInCharacter& character : built_in) {
        const std::string target = "/curve/characters/" + std::string(character.name);
        const json found = json_of(interface_.get(target));
        EXPECT_EQ(found["built_in"], true);
        EXPECT_EQ(found["updated_at"], json());
        EXPECT_EQ(found["level"], curve::kBuiltInLevel);
        EXPECT_EQ(found["points"].size(), (std::size_t{1} << curve::kBuiltInLevel) + 3);
        const Refusal conflict{409, "conflict", "name"};
        EXPECT_EQ(refusal_of(put(target, curve_)), conflict);
        EXPECT_EQ(refusal_of(interface_.send("DELETE", target)), conflict);
        const json given = answer(interface_,
                                  "/curve/character",
                                  with(curve_, {{"character", character.name}}));
        EXPECT_EQ(given["level"], curve::kBuiltInLevel);
    }
    EXPECT_EQ(names().size(), built_in.size());
}

TEST_F(CurveLibraryTest, ACharacterIsPutReadReplacedAndDeleted) {
    const std::string target = "/curve/characters/mine";
    EXPECT_EQ(refusal_of(interface_.get(target)), (Refusal{404, "not_found", "name"}));
    const http::Response made = put(target, curve_);
    EXPECT_EQ(made.status, 201);
    EXPECT_EQ(header_of(made, "Location"), target);
    EXPECT_EQ(names().back(), "mine");
    const http::Response got = interface_.get(target);
    EXPECT_EQ(json_of(got), json_of(made));
    EXPECT_EQ(json_of(got)["points"], curve_["points"]);
    EXPECT_EQ(json_of(got)["level"], 4);
    EXPECT_EQ(json_of(got)["built_in"], false);
    const std::string etag = header_of(got, "ETag");
    EXPECT_EQ(interface_.get(target, {{"If-None-Match", etag}}).status, 304);

    const http::Response replaced = put(target, {{"samples", word(1, 0, 50)}});
    EXPECT_EQ(replaced.status, 200);
    EXPECT_TRUE(json_of(replaced).contains("fit"));
    EXPECT_EQ(interface_.get(target, {{"If-None-Match", etag}}).status, 200);
    const json by_name =
        answer(interface_, "/curve/character", with(curve_, {{"character", "mine"}}));
    const json by_points =
        answer(interface_,
               "/curve/character",
               with(curve_, {{"character", {{"points", json_of(replaced)["points"]}}}}));
    EXPECT_EQ(by_name, by_points);

    EXPECT_EQ(interface_.send("DELETE", target).status, 204);
    EXPECT_EQ(interface_.send("DELETE", target).status, 404);
    EXPECT_EQ(interface_.get(target).status, 404);
}

TEST_F(CurveLibraryTest, ListsComePageByPage) {
    for (const std::string name : {"b", "a", "d-2", "c_1", "a0"}) {
        put("/curve/characters/" + name, curve_);
        put("/curve/strokes/" + name, {{"samples", word(1, 0, 10)}});
    }
    const std::vector<std::string> strokes{"a", "a0", "b", "c_1", "d-2"};
    std::vector<std::string> characters;
    for (const curve::BuiltInCharacter& character : curve::built_in_characters())
        characters.emplace_back(character.name);
    characters.insert(characters.end(), strokes.begin(), strokes.end());
    for (const int limit : {1, 2, 3, 5, 1000}) {
        EXPECT_EQ(names("/curve/strokes", limit), strokes) << limit;
        EXPECT_EQ(names("/curve/characters", limit), characters) << limit;
    }
    // A cursor is a place among the names, whether it has a curve still or not.
    EXPECT_EQ(interface_.send("DELETE", "/curve/strokes/a0").status, 204);
    const http::Response got = interface_.get("/curve/strokes?cursor=a0&limit=1");
    EXPECT_EQ(json_of(got)["items"][0]["name"], "b");
    EXPECT_EQ(json_of(got)["next_cursor"], "b");
    const std::string etag = header_of(got, "ETag");
    EXPECT_EQ(
        interface_.get("/curve/strokes?cursor=a0&limit=1", {{"If-None-Match", etag}})
            .status,
        304);
    put("/curve/strokes/b", {{"samples", word(2, 0, 10)}});
    EXPECT_EQ(
        interface_.get("/curve/strokes?cursor=a0&limit=1", {{"If-None-Match", etag}})
            .status,
        200);
}

TEST_F(CurveLibraryTest, AListedStrokeSaysHowLongItIs) {
    EXPECT_EQ(json_of(interface_.get("/curve/strokes")),
              (json{{"items", json::array()}, {"next_cursor", nullptr}}));
    const json ring{{"samples", random_points(17, 3, 5)}, {"closed", true}};
    const json made = json_of(put("/curve/strokes/ring", ring));
    const json item = json_of(interface_.get("/curve/strokes"))["items"][0];
    EXPECT_EQ(item,
              (json{{"name", "ring"},
                    {"count", 17},
                    {"dimension", 3},
                    {"closed", true},
                    {"updated_at", made["updated_at"]}}));
}

TEST_F(CurveLibraryTest, ACornerOfACharacterIsAmongItsDetails) {
    // There and back again.
    json tip = json::array();
    for (int i = 0; i <= 200; ++i)
        tip.push_back({std::abs(i - 100), 0.3 * std::sin(0.4 * i) + i});
    const json drawn{{"samples", tip}, {"corners", {0.5}}, {"fit_tolerance", 0.05}};
    const http::Response made = put("/curve/characters/tip", drawn);
    EXPECT_EQ(made.status, 201);
    const json character = json_of(made);
    ASSERT_EQ(character["corners"].size(), 1u);
    EXPECT_NEAR(character["corners"][0], 0.5, 0.01);
    EXPECT_GT(character["rounding_error"], 0);
    EXPECT_LE(character["rounding_error"], 0.05);
    EXPECT_LE(character["fit"]["max_error"], 0.05);
    const json at_tip = answer(interface_,
                               "/curve/evaluate",
                               {{"points", character["points"]}, {"count", 2001}});
    double least = 1e9;
    for (const json& point : at_tip["points"])
        least = std::min(least, difference(point, tip[100]));
    EXPECT_LE(least, 0.1);
    // Given by its name or as it is, it is the same.
    EXPECT_EQ(
        answer(interface_, "/curve/character", with(curve_, {{"character", "tip"}})),
        answer(interface_, "/curve/character", with(curve_, {{"character", drawn}})));
    // Control points are a curve already: a corner changes nothing.
    const json same =
        json_of(put("/curve/characters/same", with(curve_, {{"corners", {0.4}}})));
    EXPECT_EQ(same["points"], curve_["points"]);
    EXPECT_EQ(same["corners"], (json{0.4}));
    EXPECT_EQ(same["rounding_error"], 0);
    const json detected =
        json_of(put("/curve/characters/same", with(curve_, {{"corners", "detect"}})));
    EXPECT_EQ(detected["points"], curve_["points"]);
    EXPECT_FALSE(detected["corners"].empty());
}

TEST_F(CurveLibraryTest, AStrokeTakesNoCorners) {
    const Refusal refused{422, "no_corners", "corners"};
    for (const json& corners : {json{0.5}, json("detect")}) {
        const json drawn{{"samples", word(1, 0, 10)}, {"corners", corners}};
        EXPECT_EQ(refusal_of(put("/curve/strokes/a", drawn)), refused);
        EXPECT_EQ(refusal_of(interface_.post_json("/curve/match", drawn)), refused);
    }
    EXPECT_EQ(interface_.get("/curve/strokes/a").status, 404);
}

TEST_F(CurveLibraryTest, AClosedCharacterStaysClosed) {
    const json closed{{"points", random_points(16, 2, 3)}, {"closed", true}};
    EXPECT_EQ(put("/curve/characters/ring", closed).status, 201);
    const json found = json_of(interface_.get("/curve/characters/ring"));
    EXPECT_EQ(found["closed"], true);
    EXPECT_EQ(found["level"], 4);
}

TEST_F(CurveLibraryTest, NamesAndBodiesAreChecked) {
    for (const std::string folder : {"/curve/characters/", "/curve/strokes/"}) {
        EXPECT_EQ(refusal_of(put(folder + "No", curve_)),
                  (Refusal{400, "invalid_argument", "name"}));
        EXPECT_EQ(refusal_of(put(folder + std::string(65, 'a'), curve_)),
                  (Refusal{400, "invalid_argument", "name"}));
        EXPECT_EQ(refusal_of(put(folder + "a", json::object())),
                  (Refusal{400, "invalid_argument", "points"}));
        EXPECT_EQ(refusal_of(put(folder + "a", with(curve_, {{"size", 1}}))),
                  (Refusal{400, "unknown_parameter", "size"}));
        EXPECT_EQ(refusal_of(put(folder + "a", {{"samples", {{1, 2}}}})),
                  (Refusal{422, "too_few_samples", "samples"}));
        EXPECT_EQ(refusal_of(interface_.get(folder + "a?x=1")),
                  (Refusal{400, "unknown_parameter", "x"}));
        EXPECT_EQ(refusal_of(interface_.send("DELETE", folder + "a?x=1")),
                  (Refusal{400, "unknown_parameter", "x"}));
    }
    for (const std::string list : {"/curve/characters", "/curve/strokes"}) {
        EXPECT_EQ(refusal_of(interface_.get(list + "?x=1")),
                  (Refusal{400, "unknown_parameter", "x"}));
        for (const std::string limit : {"0", "1001", "x"})
            EXPECT_EQ(refusal_of(interface_.get(list + "?limit=" + limit)),
                      (Refusal{400, "invalid_argument", "limit"}));
        EXPECT_EQ(refusal_of(interface_.get(list + "?cursor=A")),
                  (Refusal{400, "invalid_argument", "cursor"}));
    }
}

TEST_F(CurveLibraryTest, AStrokeIsPutReadAndDeleted) {
    const std::string target = "/curve/strokes/hello";
    const json samples = word(1, 0, 10);
    EXPECT_EQ(put(target, {{"samples", samples}}).status, 201);
    EXPECT_EQ(put(target, {{"samples", samples}}).status, 200);
    const http::Response got = interface_.get(target);
    EXPECT_EQ(json_of(got)["samples"], samples);
    EXPECT_EQ(interface_.get(target, {{"If-None-Match", header_of(got, "ETag")}}).status,
              304);
    EXPECT_EQ(interface_.send("DELETE", target).status, 204);
    EXPECT_EQ(refusal_of(interface_.get(target)), (Refusal{404, "not_found", "name"}));
    EXPECT_EQ(interface_.send("DELETE", target).status, 404);
}

TEST_F(CurveLibraryTest, ControlPointsOfAStrokeBecomePointsOfTheCurve) {
    EXPECT_EQ(put("/curve/strokes/a", curve_).status, 201);
    const json samples = json_of(interface_.get("/curve/strokes/a"))["samples"];
    ASSERT_EQ(samples.size(), 65u);
    const json u{0.0, 0.25, 1.0};
    const json points =
        answer(interface_, "/curve/evaluate", with(curve_, {{"u", u}}))["points"];
    EXPECT_LT(difference({samples[0], samples[16], samples[64]}, points), 1e-9);
}

TEST_F(CurveLibraryTest, AWordIsFoundWhereverAndHoweverLargeItIsWritten) {
    constexpr unsigned kWords = 6;
    EXPECT_EQ(answer(interface_, "/curve/match", {{"samples", word(0, 0, 10)}})["items"],
              json::array());
    for (unsigned i = 0; i < kWords; ++i)
        EXPECT_EQ(put("/curve/strokes/w" + std::to_string(i),
                      {{"samples", word(i, 10 * i, 10)}})
                      .status,
                  201);
    for (unsigned i = 0; i < kWords; ++i) {
        const json found =
            answer(interface_, "/curve/match", {{"samples", word(i, 300, 25)}});
        EXPECT_EQ(found["strokes"], kWords);
        EXPECT_EQ(found["items"][0]["name"], "w" + std::to_string(i));
        EXPECT_GT(found["items"][0]["similarity"], 0.9);
    }
    // What is stored and what is removed counts at once.
    EXPECT_EQ(interface_.send("DELETE", "/curve/strokes/w2").status, 204);
    const json found =
        answer(interface_, "/curve/match", {{"samples", word(2, 0, 10)}, {"limit", 3}});
    EXPECT_EQ(found["strokes"], kWords - 1);
    EXPECT_LE(found["items"].size(), 3u);
    for (const json& item : found["items"]) EXPECT_NE(item["name"], "w2");
}

TEST_F(CurveLibraryTest, DamagedRowsAreTheServersFault) {
    const Refusal internal{500, "internal", ""};
    EXPECT_EQ(put("/curve/characters/bad", curve_).status, 201);
    EXPECT_EQ(put("/curve/strokes/bad", curve_).status, 201);
    // One point alone is neither of a level nor a stroke.
    interface_.sql("UPDATE curves SET numbers = zeroblob(16)");
    for (const std::string target : {"/curve/characters",
                                     "/curve/characters/bad",
                                     "/curve/strokes",
                                     "/curve/strokes/bad"})
        EXPECT_EQ(refusal_of(interface_.get(target)), internal) << target;
    EXPECT_EQ(refusal_of(interface_.post_json("/curve/match", curve_)), internal);
    EXPECT_EQ(refusal_of(interface_.post_json("/curve/character",
                                              with(curve_, {{"character", "bad"}}))),
              internal);
}

TEST_F(CurveLibraryTest, ALostTableIsTheServersFault) {
    interface_.sql("DROP TABLE curves");
    const Refusal internal{500, "internal", ""};
    EXPECT_EQ(refusal_of(interface_.get("/curve/characters")), internal);
    EXPECT_EQ(refusal_of(interface_.get("/curve/strokes")), internal);
    for (const std::string folder : {"/curve/characters/", "/curve/strokes/"}) {
        EXPECT_EQ(refusal_of(interface_.get(folder + "a")), internal);
        EXPECT_EQ(refusal_of(put(folder + "a", curve_)), internal);
        EXPECT_EQ(refusal_of(interface_.send("DELETE", folder + "a")), internal);
    }
    EXPECT_EQ(refusal_of(interface_.post_json("/curve/match", curve_)), internal);
}

}  // namespace
}  // namespace haarmony::server
