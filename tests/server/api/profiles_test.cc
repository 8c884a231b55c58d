// /profiles: reading, making, replacing and removing how pictures are compared.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/image/profile.h"
#include "tests/server/api/interface.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

class ProfilesTest : public testing::Test {
  protected:
    http::Response put(const std::string& name, const json& body) {
        return interface_.send("PUT",
                               "/profiles/" + name,
                               {{"Content-Type", "application/json"}},
                               body.dump());
    }
    json profile(const std::string& name) {
        return json_of(interface_.get("/profiles/" + name));
    }
    json ranking(const std::string& profile) {
        json ids = json::array();
        const json reply =
            json_of(interface_.get("/query?id=1&limit=100&profile=" + profile));
        for (const json& match : reply.value("matches", json::array()))
            ids.push_back({match["id"], match["distance"]});
        return ids;
    }
    // What is queued waits for ever.
    void stop_jobs() { interface_.jobs->stop(); }

    Interface interface_;
};

json all_weights(double weight) { return json(3, json(6, weight)); }

TEST_F(ProfilesTest, BuiltInOnesComeFirstWithTheWeightsOfTable41) {
    ASSERT_EQ(put("aaa", json::object()).status, 201);
    const json items = json_of(interface_.get("/profiles"))["items"];
    ASSERT_EQ(items.size(), 3U);
    EXPECT_EQ(items[0]["name"], "painted");
    EXPECT_EQ(items[1]["name"], "scanned");
    EXPECT_EQ(items[2]["name"], "aaa");
    EXPECT_EQ(items[0]["m"], 60);
    EXPECT_EQ(items[1]["m"], 40);
    EXPECT_TRUE(items[0]["built_in"]);
    EXPECT_TRUE(items[0]["updated_at"].is_null());
    EXPECT_TRUE(items[0]["calibration"].is_null());
    EXPECT_FALSE(items[2]["built_in"]);
    EXPECT_TRUE(items[2]["updated_at"].is_string());
    EXPECT_EQ(items[0], profile("painted"));
    // Two decimals are written as such, not as what the nearest float looks like.
    EXPECT_EQ(items[0]["weights"][0].dump(), "[4.04,0.78,0.46,0.42,0.41,0.32]");
}

TEST_F(ProfilesTest, SaysHowManyPicturesCanBeSearchedUnderIt) {
    interface_.collection.add(1);
    interface_.collection.add(2);
    stop_jobs();
    ASSERT_EQ(put("mine", {{"color_space", "lab"}}).status, 201);
    EXPECT_EQ(profile("painted")["indexed"], 2);
    EXPECT_EQ(profile("mine")["indexed"], 0);
    interface_.collection.add(3);  // gets the signatures of all kinds in use
    EXPECT_EQ(profile("painted")["indexed"], 3);
    EXPECT_EQ(profile("mine")["indexed"], 1);
}

TEST_F(ProfilesTest, AJobMakesTheSignaturesThatStoredPicturesLack) {
    interface_.collection.add(1);
    interface_.collection.add(2);
    const json reply = json_of(put("mine", {{"decomposition", "nonstandard"}}));
    ASSERT_TRUE(reply.contains("reindex_job")) << reply;
    const std::string job = "/jobs/" + std::to_string(reply["reindex_job"].get<int>());
    EXPECT_EQ(json_of(interface_.get(job))["type"], "reindex");
    ASSERT_TRUE(
        becomes_true([&] { return json_of(interface_.get(job))["state"] == "done"; }));
    ASSERT_TRUE(becomes_true([&] { return profile("mine")["indexed"] == 2; }));
    // Nothing is lacking any more.
    EXPECT_FALSE(json_of(put("mine", {{"m", 9}})).contains("reindex_job"));
}

TEST_F(ProfilesTest, OnlyWhatIsLackingIsMade) {
    stop_jobs();
    EXPECT_FALSE(json_of(put("lab", {{"color_space", "lab"}})).contains("reindex_job"));
    interface_.collection.add(1);
    EXPECT_FALSE(json_of(put("lab", json::object())).contains("reindex_job"));
    EXPECT_FALSE(json_of(put("yiq", json::object())).contains("reindex_job"));
    const json first = json_of(put("luv", {{"color_space", "luv"}}));
    ASSERT_TRUE(first.contains("reindex_job"));
    // One that waits is enough, for one profile.
    EXPECT_EQ(json_of(put("luv", {{"m", 9}}))["reindex_job"], first["reindex_job"]);
    EXPECT_NE(json_of(put("luv2", {{"base", "luv"}}))["reindex_job"],
              first["reindex_job"]);
}

TEST_F(ProfilesTest, AJobThatCannotBeQueuedIsAFailureOfTheServer) {
    interface_.collection.add(1);
    stop_jobs();
    interface_.sql("ALTER TABLE jobs RENAME TO gone");
    EXPECT_EQ(put("mine", {{"color_space", "lab"}}).status, 500);
    interface_.sql("ALTER TABLE image_signatures RENAME TO lost");
    EXPECT_EQ(put("mine", {{"color_space", "lab"}}).status, 500);
}

TEST_F(ProfilesTest, WhatIsPutIsWhatIsRead) {
    const json body{{"name", "mine"},
                    {"color_space", "luv"},
                    {"decomposition", "nonstandard"},
                    {"m", 17},
                    {"bin_rule", "linear"},
                    {"weights", {{10000, 0, 0.01, 1, 2.5, 3.07}, json(6, 1), json(6, 2)}},
                    {"calibration", {{"intercept", -3.25}, {"scale", 0.5}}}};
    const http::Response made = put("mine", body);
    EXPECT_EQ(made.status, 201);
    EXPECT_EQ(header_of(made, "Location"), "/profiles/mine");
    json read = profile("mine");
    EXPECT_EQ(json_of(made), read);
    for (const auto& [name, value] : body.items()) EXPECT_EQ(read[name], value) << name;
}

TEST_F(ProfilesTest, WhatIsLeftOutIsThatOfTheReplacedOneOrOfPainted) {
    ASSERT_EQ(put("mine", {{"m", 33}}).status, 201);
    EXPECT_EQ(profile("mine")["weights"], profile("painted")["weights"]);
    const http::Response replaced = put("mine", {{"weights", all_weights(2)}});
    EXPECT_EQ(replaced.status, 200);
    EXPECT_EQ(header_of(replaced, "Location"), "");
    EXPECT_EQ(profile("mine")["m"], 33);
    EXPECT_EQ(profile("mine")["weights"], all_weights(2));
}

TEST_F(ProfilesTest, ABaseFillsUpInsteadOfTheReplacedOne) {
    ASSERT_EQ(put("mine", {{"m", 33}, {"bin_rule", "linear"}}).status, 201);
    ASSERT_EQ(put("mine", {{"base", "scanned"}}).status, 200);
    EXPECT_EQ(profile("mine")["m"], 40);
    EXPECT_EQ(profile("mine")["bin_rule"], "log2_plus_1");
    ASSERT_EQ(put("other", {{"base", "mine"}, {"m", 5}}).status, 201);
    EXPECT_EQ(profile("other")["weights"], profile("scanned")["weights"]);
    const http::Response unknown = put("mine", {{"base", "nobody"}});
    EXPECT_EQ(refusal_of(unknown), (Refusal{400, "invalid_argument", "base"}));
    EXPECT_NE(body_of(unknown).find("nobody"), std::string::npos);
}

TEST_F(ProfilesTest, ACalibrationLastsUntilTheMetricChanges) {
    const json calibration{{"intercept", 2.0}, {"scale", 0.25}};
    ASSERT_EQ(put("mine", {{"calibration", calibration}}).status, 201);
    ASSERT_EQ(put("copy", {{"base", "mine"}}).status, 201);
    EXPECT_EQ(profile("copy")["calibration"], calibration);
    for (const json& change : std::vector<json>{{{"m", 59}},
                                                {{"color_space", "rgb"}},
                                                {{"decomposition", "nonstandard"}},
                                                {{"bin_rule", "literal"}},
                                                {{"weights", all_weights(1)}}}) {
        json body = change;
        body["base"] = "mine";
        ASSERT_EQ(put("copy", body).status, 200) << change;
        EXPECT_TRUE(profile("copy")["calibration"].is_null()) << change;
        body["calibration"] = calibration;
        ASSERT_EQ(put("copy", body).status, 200) << change;
        EXPECT_EQ(profile("copy")["calibration"], calibration) << change;
    }
    ASSERT_EQ(put("mine", {{"calibration", nullptr}}).status, 200);
    EXPECT_TRUE(profile("mine")["calibration"].is_null());
}

TEST_F(ProfilesTest, TheNextQueryUsesIt) {
    for (unsigned number = 1; number <= 5; ++number) interface_.collection.add(number);
    ASSERT_EQ(put("mine", json::object()).status, 201);
    EXPECT_EQ(ranking("mine"), ranking("painted"));
    ASSERT_EQ(put("mine", {{"base", "scanned"}}).status, 200);
    EXPECT_EQ(ranking("mine"), ranking("scanned"));
    EXPECT_NE(ranking("mine"), ranking("painted"));
}

TEST_F(ProfilesTest, ARemovedOneIsGone) {
    ASSERT_EQ(put("mine", json::object()).status, 201);
    EXPECT_EQ(interface_.send("DELETE", "/profiles/mine").status, 204);
    EXPECT_EQ(refusal_of(interface_.get("/profiles/mine")),
              (Refusal{404, "not_found", "name"}));
    EXPECT_EQ(refusal_of(interface_.send("DELETE", "/profiles/mine")),
              (Refusal{404, "not_found", "name"}));
}

TEST_F(ProfilesTest, BuiltInOnesCannotBeChanged) {
    for (const std::string name : {"painted", "scanned"}) {
        EXPECT_EQ(refusal_of(put(name, {{"m", 3}})), (Refusal{409, "conflict", "name"}));
        EXPECT_EQ(refusal_of(interface_.send("DELETE", "/profiles/" + name)),
                  (Refusal{409, "conflict", "name"}));
    }
    EXPECT_EQ(profile("painted")["m"], 60);
}

TEST_F(ProfilesTest, NamesAreWords) {
    const std::string longest(64, 'a');
    EXPECT_EQ(put(longest, json::object()).status, 201);
    EXPECT_EQ(put("0_-", json::object()).status, 201);
    for (const std::string& name :
         {longest + "a", std::string("A"), std::string("a%20b"), std::string("%C3%A4")})
        EXPECT_EQ(refusal_of(put(name, json::object())),
                  (Refusal{400, "invalid_argument", "name"}))
            << name;
    EXPECT_EQ(refusal_of(put("mine", {{"name", "yours"}})),
              (Refusal{400, "invalid_argument", "name"}));
}

TEST_F(ProfilesTest, EveryBadMemberIsNamed) {
    struct Case {
        json body;
        std::string param;
    };
    json narrow = all_weights(1);
    narrow[1].erase(0);
    json decimals = all_weights(1);
    decimals[2][5] = 0.125;
    json negative = all_weights(1);
    negative[0][3] = -0.01;
    json heavy = all_weights(1);
    heavy[0][0] = 10000.01;
    json word = all_weights(1);
    word[1][1] = "1";
    const std::vector<Case> cases{
        {{{"color_space", "cmyk"}}, "color_space"},
        {{{"decomposition", "fast"}}, "decomposition"},
        {{{"bin_rule", 1}}, "bin_rule"},
        {{{"m", 0}}, "m"},
        {{{"m", 101}}, "m"},
        {{{"weights", 1}}, "weights"},
        {{{"weights", {1, 2, 3}}}, "weights[0]"},
        {{{"weights", narrow}}, "weights[1]"},
        {{{"weights", decimals}}, "weights[2][5]"},
        {{{"weights", negative}}, "weights[0][3]"},
        {{{"weights", heavy}}, "weights[0][0]"},
        {{{"weights", word}}, "weights[1][1]"},
        {{{"calibration", 1}}, "calibration"},
        {{{"calibration", {{"intercept", 1}}}}, "calibration"},
        {{{"calibration", {{"intercept", 1}, {"scale", "1"}}}}, "calibration"},
        {{{"calibration", {{"intercept", 1}, {"scale", 1}, {"x", 1}}}}, "calibration"},
        {{{"calibration", {{"intercept", 1}, {"scale", -1}}}}, "calibration"},
    };
    for (const Case& bad : cases)
        EXPECT_EQ(refusal_of(put("mine", bad.body)),
                  (Refusal{400, "invalid_argument", bad.param}))
            << bad.body;
    EXPECT_NE(body_of(put("mine", {{"weights", decimals}})).find("0.125"),
              std::string::npos);
    EXPECT_EQ(refusal_of(put("mine", {{"weight", 1}})),
              (Refusal{400, "unknown_parameter", "weight"}));
    EXPECT_EQ(interface_.get("/profiles/mine").status, 404);
}

TEST_F(ProfilesTest, OtherBodiesAndParametersAreRefused) {
    const auto send = [&](const std::string& type, const std::string& body) {
        return refusal_of(
            interface_.send("PUT", "/profiles/mine", {{"Content-Type", type}}, body));
    };
    EXPECT_EQ(send("image/png", "x"), (Refusal{415, "unsupported_format", "file"}));
    EXPECT_EQ(send("text/plain", "x"),
              (Refusal{415, "unsupported_media_type", "Content-Type"}));
    EXPECT_EQ(send("application/json", "[]").status, 400);
    for (const std::string target : {"/profiles?x=1", "/profiles/painted?x=1"})
        EXPECT_EQ(refusal_of(interface_.get(target)),
                  (Refusal{400, "unknown_parameter", "x"}));
    EXPECT_EQ(refusal_of(interface_.send("DELETE", "/profiles/mine?x=1")),
              (Refusal{400, "unknown_parameter", "x"}));
}

TEST_F(ProfilesTest, TagsChangeWithTheProfile) {
    ASSERT_EQ(put("mine", json::object()).status, 201);
    for (const std::string target : {"/profiles", "/profiles/mine"}) {
        const std::string tag = header_of(interface_.get(target), "ETag");
        EXPECT_EQ(interface_.get(target, {{"If-None-Match", tag}}).status, 304);
        ASSERT_EQ(put("mine", {{"m", target.size()}}).status, 200);
        EXPECT_EQ(interface_.get(target, {{"If-None-Match", tag}}).status, 200);
    }
}

// Another version may have written it.
TEST_F(ProfilesTest, OneThatIsNotUnderstoodIsShownAndReplacedOnlyWithABase) {
    ASSERT_EQ(put("mine", {{"m", 7}}).status, 201);
    interface_.sql("UPDATE profiles SET color_space = 'oklab'");
    EXPECT_EQ(profile("mine")["color_space"], "oklab");
    EXPECT_EQ(profile("mine")["indexed"], 0);
    EXPECT_EQ(refusal_of(put("mine", {{"m", 8}})),
              (Refusal{400, "invalid_argument", "profile"}));
    EXPECT_EQ(refusal_of(put("other", {{"base", "mine"}})),
              (Refusal{400, "invalid_argument", "profile"}));
    EXPECT_EQ(put("mine", {{"base", "painted"}}).status, 200);
    EXPECT_EQ(profile("mine")["color_space"], "yiq");
}

TEST_F(ProfilesTest, WhatTheDatabaseCannotReadIsAFailureOfTheServer) {
    ASSERT_EQ(put("mine", json::object()).status, 201);
    interface_.sql(
        "UPDATE profiles SET weights = '[[1,1,1,1,1,1],[1,1,1,1,1,1],[1,1,1,1,1,0.5]]'");
    for (const std::string target : {"/profiles", "/profiles/mine"})
        EXPECT_EQ(refusal_of(interface_.get(target)), (Refusal{500, "internal", ""}));
    EXPECT_EQ(put("mine", {{"base", "painted"}}).status, 500);
}

}  // namespace
}  // namespace haarmony::server
