// The choices of chapter 4 and its wishes (section 4.6) through POST /query: what each option
// finds that the plain query does not.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "engine/image/aspect.h"
#include "tests/server/api/interface.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

constexpr unsigned kScenes = 8;

class QueryChoicesTest : public testing::Test {
  protected:
    QueryChoicesTest() {
        for (unsigned number = 1; number <= kScenes; ++number)
            interface_.collection.add(number,
                                      {"file:///holiday/" + word(number), {}, "{}"});
    }

    static std::string word(unsigned number) {
        return number % 2 == 0 ? "beach_" + std::to_string(number) + ".jpg"
                               : "forest_" + std::to_string(number) + ".jpg";
    }
    static image::Pixels scene(unsigned number) { return image::scene(96, 64, number); }

    [[nodiscard]] json ask(const std::string& options, const image::Pixels& picture) {
        const http::Response response = interface_.post(
            "/query?" + options, "image/png", text_of(png_of(picture.view())));
        EXPECT_EQ(response.status, 200) << body_of(response);
        return json_of(response);
    }
    void store_profile(const std::string& name, const json& profile) {
        const http::Response response =
            interface_.send("PUT",
                            "/profiles/" + name,
                            {{"Content-Type", "application/json"}},
                            profile.dump());
        EXPECT_EQ(response.status / 100, 2) << body_of(response);
    }

    Interface interface_;
};

image::Pixels mirrored(const image::Pixels& picture) {
    image::Pixels result = picture;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            for (int channel = 0; channel < picture.channels; ++channel)
                result.at(x, y, channel) = picture.at(picture.width - 1 - x, y, channel);
    return result;
}

image::Pixels turned_clockwise(const image::Pixels& picture) {
    image::Pixels result = image::flat(picture.height, picture.width, {0, 0, 0});
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x)
            for (int channel = 0; channel < 3; ++channel)
                result.at(x, y, channel) = picture.at(y, picture.height - 1 - x, channel);
    return result;
}

image::Pixels framed(const image::Pixels& picture, int margin) {
    image::Pixels result = image::flat(
        picture.width + 2 * margin, picture.height + 2 * margin, {255, 255, 255});
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            for (int channel = 0; channel < 3; ++channel)
                result.at(margin + x, margin + y, channel) = picture.at(x, y, channel);
    return result;
}

image::Pixels middle_of(const image::Pixels& picture, int left, int top) {
    image::Pixels result =
        image::flat(picture.width - 2 * left, picture.height - 2 * top, {0, 0, 0});
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x)
            for (int channel = 0; channel < 3; ++channel)
                result.at(x, y, channel) = picture.at(left + x, top + y, channel);
    return result;
}

TEST_F(QueryChoicesTest, AMirroredOrTurnedCopyIsFoundAndNamed) {
    for (unsigned number = 1; number <= kScenes; ++number) {
        const json mirror =
            ask("orientations=mirror", mirrored(scene(number)))["matches"][0];
        EXPECT_EQ(mirror["id"], number);
        EXPECT_EQ(mirror["orientation"], "mirror_x");
        EXPECT_GT(mirror["similarity"], 0.8);
        // Turned back it is the picture.
        const json turned =
            ask("orientations=all", turned_clockwise(scene(number)))["matches"][0];
        EXPECT_EQ(turned["id"], number);
        EXPECT_EQ(turned["orientation"], "turn_270");
        const json plain = ask("orientations=all", scene(number))["matches"][0];
        EXPECT_EQ(plain["orientation"], "identity");
    }
}

TEST_F(QueryChoicesTest, BordersAreDropped) {
    const json plain = ask("", framed(scene(3), 20))["matches"];
    const json cropped = ask("autocrop=true", framed(scene(3), 20))["matches"];
    EXPECT_EQ(cropped[0]["id"], 3);
    EXPECT_GT(cropped[0]["similarity"], 0.9);
    const auto same =
        std::ranges::find_if(plain, [](const json& match) { return match["id"] == 3; });
    ASSERT_NE(same, plain.end());
    EXPECT_LT((*same)["similarity"], 0.7);
}

// A stored picture with borders is found by what is within them, and by itself.
TEST_F(QueryChoicesTest, StoredBordersAreLookedBehind) {
    const std::string bytes = text_of(png_of(framed(scene(77), 20).view()));
    const std::int64_t id = json_of(interface_.post("/images", "image/png", bytes))["id"];
    const json within = ask("autocrop=true", scene(77))["matches"][0];
    EXPECT_EQ(within["id"], id);
    EXPECT_GT(within["similarity"], 0.9);
    const json itself =
        json_of(interface_.get("/query?autocrop=true&id=" + std::to_string(id)));
    EXPECT_EQ(itself["matches"][0]["id"], id);
    EXPECT_EQ(itself["matches"][0]["distance"], 0.0);
    EXPECT_EQ(itself["searched"], kScenes + 1);
}

TEST_F(QueryChoicesTest, APartIsFoundAsAPart) {
    const image::Pixels part = middle_of(scene(5), 19, 13);
    const json found = ask("partial=true", part)["matches"][0];
    EXPECT_EQ(found["id"], 5);
    json plain = ask("", part)["matches"];
    const auto same =
        std::ranges::find_if(plain, [](const json& match) { return match["id"] == 5; });
    ASSERT_NE(same, plain.end());
    EXPECT_LT(found["distance"], (*same)["distance"]);
    for (const char* source : {"id=1", "signature="}) {
        std::string address = "/query?partial=true&" + std::string(source);
        if (address.ends_with('=')) {
            address += json_of(interface_.get("/images/1/signature"))["signature"];
        }
        EXPECT_EQ(refusal_of(interface_.get(address)),
                  (Refusal{400, "invalid_argument", "partial"}));
    }
}

TEST_F(QueryChoicesTest, APictureThatLiesOffIsNearerWhenThatIsSaid) {
    const image::Pixels picture = scene(5);
    image::Pixels moved = picture;
    const int right = picture.width / 48;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            for (int c = 0; c < picture.channels; ++c)
                moved.at(x, y, c) = picture.at(std::max(x - right, 0), y, c);
    const json plain = ask("", moved)["matches"][0];
    const json found = ask("misregistered=true", moved)["matches"][0];
    EXPECT_EQ(found["id"], 5);
    EXPECT_LT(found["distance"], plain["distance"]);
    // As it is remains one of the ways.
    EXPECT_EQ(ask("misregistered=true", picture)["matches"][0]["distance"],
              ask("", picture)["matches"][0]["distance"]);
    EXPECT_EQ(ask("misregistered=true&partial=true", picture)["matches"][0]["id"], 5);
    EXPECT_EQ(refusal_of(interface_.get("/query?misregistered=true&id=1")),
              (Refusal{400, "invalid_argument", "misregistered"}));
}

TEST_F(QueryChoicesTest, TheShapeIsATerm) {
    const json plain = ask("", image::scene(64, 96, 5))["matches"];
    const json shaped = ask("aspect_weight=2.5", image::scene(64, 96, 5))["matches"];
    const double difference =
        double(image::log_aspect(96, 64) - image::log_aspect(64, 96)) /
        double{image::kAverageOne};
    ASSERT_EQ(plain.size(), shaped.size());
    for (std::size_t i = 0; i < plain.size(); ++i) {
        // All are of one shape here, so the order stays.
        EXPECT_EQ(plain[i]["id"], shaped[i]["id"]);
        EXPECT_NEAR(
            shaped[i]["distance"].get<double>() - plain[i]["distance"].get<double>(),
            2.5 * difference,
            1e-6);
    }
    const std::string signature =
        json_of(interface_.get("/images/1/signature"))["signature"];
    EXPECT_EQ(refusal_of(interface_.get("/query?aspect_weight=1&signature=" + signature)),
              (Refusal{400, "invalid_argument", "aspect_weight"}));
}

TEST_F(QueryChoicesTest, TextAndTagsNarrowTheSearch) {
    const json beaches = ask("text=beach&limit=3", scene(1));
    EXPECT_EQ(beaches["searched"], kScenes / 2);
    ASSERT_EQ(beaches["matches"].size(), 3U);
    for (const json& match : beaches["matches"])
        EXPECT_NE(match["uri"].get<std::string>().find("beach"), std::string::npos);
    EXPECT_EQ(ask("text=beach%20forest", scene(1))["searched"], 0);

    const http::Response tagged =
        interface_.post("/images?tags=red,%20old", "image/jpeg", text_of(jpeg_scene(70)));
    const json found = ask("tags=old,red", scene(1));
    EXPECT_EQ(found["searched"], 1);
    EXPECT_EQ(found["matches"][0]["id"], json_of(tagged)["id"]);
    EXPECT_TRUE(ask("tags=old,green", scene(1))["matches"].empty());
    EXPECT_EQ(json_of(interface_.get("/images?text=forest"))["items"].size(),
              kScenes / 2);
}

TEST_F(QueryChoicesTest, RanksAreCombined) {
    const json combined = ask("combine=painted,scanned&combine_by=worst", scene(4));
    EXPECT_EQ(combined["query"]["combine"], (json{"painted", "scanned"}));
    EXPECT_EQ(combined["query"]["combine_by"], "worst");
    EXPECT_EQ(combined["query"]["profile"], "painted");
    const auto rank_under = [&](const std::string& profile, const json& id) {
        const json matches = ask("profile=" + profile, scene(4))["matches"];
        const auto match = std::ranges::find_if(
            matches, [&](const json& other) { return other["id"] == id; });
        return (*match)["rank"].get<double>();
    };
    double before = 0;
    for (const json& match : combined["matches"]) {
        const double painted = rank_under("painted", match["id"]);
        const double scanned = rank_under("scanned", match["id"]);
        EXPECT_EQ(match["combined_rank"], std::max(painted, scanned));
        EXPECT_GE(match["combined_rank"], before);
        before = match["combined_rank"];
    }
    const json alone = ask("profile=painted&combine=painted", scene(4));
    EXPECT_EQ(alone["matches"][0]["id"], 4);
    EXPECT_EQ(alone["matches"][0]["combined_rank"], 1.0);
    EXPECT_FALSE(ask("", scene(4))["matches"][0].contains("combined_rank"));
}

// New pictures get signatures of every kind that a profile compares; without any, a search
// says what to do.
TEST_F(QueryChoicesTest, AStoredProfileIsSearchedByItsOwnKind) {
    store_profile("mine", {{"color_space", "lab"}, {"decomposition", "nonstandard"}});
    const std::vector<std::uint8_t> fresh = jpeg_scene(60);
    const json added = json_of(interface_.post("/images", "image/jpeg", text_of(fresh)));
    const http::Response found =
        interface_.post("/query?profile=mine", "image/jpeg", text_of(fresh));
    ASSERT_EQ(found.status, 200) << body_of(found);
    const json first = json_of(found)["matches"][0];
    EXPECT_EQ(first["id"], added["id"]);
    EXPECT_EQ(first["distance"], 0.0);
    // The opaque signature says its kind.
    const std::string opaque = json_of(found)["query"]["signature"];
    EXPECT_EQ(json_of(interface_.get("/query?profile=mine&signature=" +
                                     opaque))["matches"][0]["distance"],
              0.0);
    EXPECT_EQ(refusal_of(interface_.get("/query?signature=" + opaque)),
              (Refusal{400, "invalid_argument", "profile"}));

    store_profile("other", {{"color_space", "luv"}});
    EXPECT_EQ(refusal_of(interface_.get("/query?profile=other&id=1")),
              (Refusal{409, "conflict", "profile"}));
}

TEST_F(QueryChoicesTest, AnExplanationAddsUpToTheDistance) {
    const json reply = ask("explain=true&profile=scanned&limit=3", scene(66));
    ASSERT_EQ(reply["matches"].size(), 3U);
    for (const json& match : reply["matches"]) {
        const json& explained = match["explain"];
        EXPECT_EQ(explained["variant"], "yiq-standard");
        EXPECT_TRUE(explained["picture"].get<std::string>().starts_with(
            "data:image/jpeg;base64,/9j/"));
        double total = 0;
        for (const json& channel : explained["channels"])
            total += channel["distance"].get<double>();
        EXPECT_NEAR(total, match["distance"].get<double>(), 1e-9);
        EXPECT_EQ(explained["channels"][1]["channel"], "I");
    }
    EXPECT_FALSE(ask("", scene(66))["matches"][0].contains("explain"));
}

TEST_F(QueryChoicesTest, ABatchAnswersInOrder) {
    const json reply =
        json_of(interface_.post_json("/query/batch",
                                     {{"queries",
                                       {{{"id", 2}, {"limit", 1}, {"seq", 7}},
                                        {{"id", 999}},
                                        {{"image", base64(text_of(jpeg_scene(3)))}},
                                        {{"id", 1}, {"colour", "red"}},
                                        5}}}));
    ASSERT_EQ(reply["results"].size(), 5U);
    EXPECT_EQ(reply["results"][0]["matches"][0]["id"], 2);
    EXPECT_EQ(reply["results"][0]["seq"], 7);
    EXPECT_EQ(reply["results"][1]["status"], 404);
    EXPECT_EQ(reply["results"][1]["code"], "not_found");
    EXPECT_EQ(reply["results"][2]["matches"][0]["id"], 3);
    EXPECT_EQ(reply["results"][3]["status"], 400);
    EXPECT_EQ(reply["results"][3]["param"], "colour");
    EXPECT_EQ(reply["results"][4]["status"], 400);
}

TEST_F(QueryChoicesTest, ABatchIsAListOfOneToAHundred) {
    const std::vector<json> bodies{json::object(),
                                   {{"queries", json::array()}},
                                   {{"queries", {{"id", 1}}}},
                                   {{"queries", std::vector<json>(101, {{"id", 1}})}}};
    for (const json& body : bodies)
        EXPECT_EQ(refusal_of(interface_.post_json("/query/batch", body)),
                  (Refusal{400, "invalid_argument", "queries"}));
    EXPECT_EQ(refusal_of(interface_.post_json(
                  "/query/batch", {{"queries", {{{"id", 1}}}}, {"limit", 3}})),
              (Refusal{400, "unknown_parameter", "limit"}));
    EXPECT_EQ(
        interface_
            .post_json("/query/batch", {{"queries", std::vector<json>(100, {{"id", 1}})}})
            .status,
        200);
}

}  // namespace
}  // namespace haarmony::server
