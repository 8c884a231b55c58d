// POST /profiles/{name}/train: from logged or given pairs to a stored profile.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/server/api/interface.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

constexpr int kPictures = 24;

class TrainingTest : public testing::Test {
  protected:
    TrainingTest() {
        for (int number = 1; number <= kPictures; ++number) {
            interface_.collection.add(static_cast<unsigned>(number));
            signatures_.push_back(json_of(interface_.get(
                "/images/" + std::to_string(number) + "/signature"))["signature"]);
        }
    }

    // Every second picture was drawn as it is, the others as those look that are `shift`
    // ids on: 0 is a perfect memory.
    json pairs(int count, int shift = 0) {
        json all = json::array();
        for (int i = 0; i < count; ++i)
            all.push_back({{"signature", signatures_[(i + i % 2 * shift) % kPictures]},
                           {"target", i % kPictures + 1}});
        return all;
    }
    void log(const json& all, const std::string& kind = "painted") {
        for (json pair : all) {
            pair["kind"] = kind;
            ASSERT_EQ(interface_.post_json("/feedback", pair).status, 201);
        }
    }
    http::Response train(const json& body, const std::string& name = "mine") {
        return interface_.post_json("/profiles/" + name + "/train", body);
    }
    json profile(const std::string& name = "mine") {
        return json_of(interface_.get("/profiles/" + name));
    }

    Interface interface_;
    std::vector<std::string> signatures_;
};

TEST_F(TrainingTest, MakesAProfileFromGivenPairs) {
    const http::Response response = train({{"pairs", pairs(24)}});
    ASSERT_EQ(response.status, 200) << body_of(response);
    const json reply = json_of(response);
    EXPECT_EQ(reply["profile"], "mine");
    EXPECT_TRUE(reply["stored"]);
    EXPECT_EQ(reply["fit"]["pairs"], 12);
    EXPECT_EQ(reply["fit"]["left_out"], 0);
    // Each of 12 queries with every picture but its target.
    EXPECT_EQ(reply["fit"]["mismatches"], 12 * (kPictures - 1));
    EXPECT_EQ(reply["held_back"]["pairs"], 12);
    EXPECT_EQ(reply["held_back"]["candidates"], kPictures + 1);
    EXPECT_TRUE(reply["held_back"]["existing"].is_null());
    // Each query is its target's very signature.
    EXPECT_EQ(reply["held_back"]["before"]["mrr"], 1.0);
    EXPECT_EQ(reply["held_back"]["after"]["mean_rank"], 1.0);
    EXPECT_TRUE(reply["better"]);

    const json stored = profile();
    EXPECT_EQ(stored["weights"], reply["weights"]);
    EXPECT_EQ(stored["calibration"]["intercept"], reply["fit"]["intercept"]);
    EXPECT_EQ(stored["calibration"]["scale"], reply["fit"]["scale"]);
    EXPECT_EQ(stored["m"], 60);
}

TEST_F(TrainingTest, AQueryUnderATrainedProfileHasProbabilities) {
    ASSERT_EQ(train({{"pairs", pairs(24)}}).status, 200);
    const json reply = json_of(interface_.get("/query?id=3&profile=mine"));
    ASSERT_EQ(reply["matches"].size(), 20U) << reply;
    double before = 1;
    for (const json& match : reply["matches"]) {
        EXPECT_LE(match["probability"].get<double>(), before);
        before = match["probability"];
    }
}

TEST_F(TrainingTest, UsesTheLoggedPairsOfTheKind) {
    log(pairs(22), "painted");
    log(pairs(20), "scanned");
    EXPECT_EQ(json_of(train(json::object()))["fit"]["pairs"], 11);
    EXPECT_EQ(json_of(train({{"kind", "scanned"}}, "other"))["fit"]["pairs"], 10);
    const json given = json_of(train({{"pairs", pairs(22)}}, "given"));
    EXPECT_EQ(given["weights"], profile()["weights"]);
    EXPECT_EQ(train({{"kind", "nothing"}}).status, 422);
}

TEST_F(TrainingTest, LoggedPairsThatTeachNothingAreLeftOut) {
    log(pairs(21));
    const json flat{
        {"width", 9}, {"height", 9}, {"background", "#808080"}, {"items", json::array()}};
    log({{{"strokes", flat}, {"target", 1}}});
    const json reply = json_of(train(json::object()));
    EXPECT_EQ(reply["fit"]["left_out"], 1);
    EXPECT_EQ(reply["fit"]["pairs"].get<int>() + reply["held_back"]["pairs"].get<int>(),
              21);
}

TEST_F(TrainingTest, StrokesMakeTheSignatureOfTheBasesKind) {
    interface_.jobs->stop();  // or it would make what is lacking here
    ASSERT_EQ(interface_
                  .send("PUT",
                        "/profiles/rgb",
                        {{"Content-Type", "application/json"}},
                        json{{"color_space", "rgb"}}.dump())
                  .status,
              201);
    // Those that come now have signatures of both kinds.
    std::vector<std::int64_t> ids;
    for (unsigned number = 1; number <= 20; ++number)
        ids.push_back(to_int(interface_.collection.add(number)));
    json drawn = json::array();
    for (int i = 0; i < 20; ++i)
        drawn.push_back({{"target", ids[static_cast<std::size_t>(i)]},
                         {"strokes",
                          {{"width", 64},
                           {"height", 48},
                           {"items",
                            {{{"points", {{3 * i, 2}, {60 - 2 * i, 40}}},
                              {"width", 9},
                              {"color", "#d02030"}},
                             {{"points", {{2, 40 - i}, {60, 2 * i}}},
                              {"width", 9},
                              {"color", "#2040a0"}}}}}}});
    const http::Response response = train({{"pairs", drawn}, {"base", "rgb"}});
    ASSERT_EQ(response.status, 200) << body_of(response);
    EXPECT_EQ(profile()["color_space"], "rgb");
    // Only those 20 have such a signature.
    EXPECT_EQ(json_of(response)["held_back"]["candidates"], 21);

    json scanned = drawn;
    scanned[3].erase("strokes");
    scanned[3]["signature"] = signatures_[3];
    EXPECT_EQ(refusal_of(train({{"pairs", scanned}, {"base", "rgb"}})),
              (Refusal{422, "untrainable", "pairs[3]"}));
    drawn[5]["target"] = 5;
    EXPECT_EQ(refusal_of(train({{"pairs", drawn}, {"base", "rgb"}})),
              (Refusal{409, "conflict", "pairs[5]"}));
}

// Half of what was drawn has nothing to do with what was meant: some fits are worse by
// chance.
TEST_F(TrainingTest, AWorseProfileReplacesNoneUnasked) {
    ASSERT_EQ(train({{"pairs", pairs(24)}}).status, 200);
    const json before = profile();
    int kept = 0;
    for (int seed = 0; seed < 12; ++seed) {
        const json found = profile();
        const http::Response response = train({{"pairs", pairs(24, 7)}, {"seed", seed}});
        ASSERT_EQ(response.status, 200) << body_of(response);
        const json reply = json_of(response);
        const auto fell = [&](const json& than, const char* measure) {
            return reply["held_back"]["after"][measure] < than[measure];
        };
        bool worse = false;
        for (const char* base : {"before", "existing"})
            for (const char* measure : {"mrr", "top_20"})
                worse = worse || fell(reply["held_back"][base], measure);
        EXPECT_EQ(reply["stored"], !worse) << reply["held_back"];
        EXPECT_EQ(profile() == found, worse);
        if (!worse) {
            EXPECT_EQ(profile()["weights"], reply["weights"]);
        }
        kept += worse ? 1 : 0;
    }
    EXPECT_GT(kept, 0);

    const json forced =
        json_of(train({{"pairs", pairs(24, 7)}, {"seed", 1}, {"replace_worse", true}}));
    EXPECT_TRUE(forced["stored"]);
    EXPECT_EQ(profile()["weights"], forced["weights"]);
}

TEST_F(TrainingTest, AWorseProfileIsMadeWhereThereIsNone) {
    int worse = 0;
    for (int seed = 0; seed < 8; ++seed) {
        const std::string name = "seed" + std::to_string(seed);
        const http::Response response =
            train({{"pairs", pairs(24, 5)}, {"seed", seed}}, name);
        ASSERT_EQ(response.status, 200) << body_of(response);
        const json reply = json_of(response);
        EXPECT_TRUE(reply["stored"]);
        EXPECT_EQ(profile(name)["weights"], reply["weights"]);
        worse += reply["better"] ? 0 : 1;
    }
    EXPECT_GT(worse, 0);
}

TEST_F(TrainingTest, TheSameTrainingAgainIsNoWorse) {
    const json body{{"pairs", pairs(24, 3)}, {"seed", 4}};
    const json first = json_of(train(body));
    const json again = json_of(train(body));
    EXPECT_EQ(again["weights"], first["weights"]);
    EXPECT_EQ(again["held_back"]["existing"], first["held_back"]["after"]);
}

TEST_F(TrainingTest, BuiltInProfilesCannotBeTrained) {
    EXPECT_EQ(refusal_of(train({{"pairs", pairs(24)}}, "painted")),
              (Refusal{409, "conflict", "name"}));
    EXPECT_EQ(refusal_of(train({{"pairs", pairs(24)}}, "No")),
              (Refusal{400, "invalid_argument", "name"}));
}

TEST_F(TrainingTest, TooFewPairsAreCounted) {
    const http::Response given = train({{"pairs", pairs(19)}});
    EXPECT_EQ(refusal_of(given), (Refusal{422, "untrainable", "pairs"}));
    EXPECT_NE(body_of(given).find("19 pairs: at least 20"), std::string::npos)
        << body_of(given);
    EXPECT_EQ(interface_.get("/profiles/mine").status, 404);

    log(pairs(20));
    interface_.sql("UPDATE feedback SET signature = x'00' WHERE id = 7");
    EXPECT_NE(body_of(train(json::object())).find("19 pairs: at least 20"),
              std::string::npos);
}

TEST_F(TrainingTest, EveryBadMemberIsNamed) {
    json unknown = pairs(24);
    unknown[4]["target"] = 99;
    json wrong = pairs(24);
    wrong[6]["signature"] = "no";
    json without = pairs(24);
    without[2].erase("signature");
    json number = pairs(24);
    number[1] = 5;
    const auto bad = [](const std::string& param) {
        return Refusal{400, "invalid_argument", param};
    };
    const std::vector<std::pair<json, Refusal>> cases{
        {{{"pairs", 1}}, bad("pairs")},
        {{{"pairs", wrong}}, bad("pairs[6].signature")},
        {{{"pairs", number}}, bad("pairs[1]")},
        {{{"pairs", without}}, {400, "no_source", "pairs[2].signature"}},
        {{{"pairs", unknown}}, {404, "not_found", "pairs[4]"}},
        {{{"pairs", pairs(24)}, {"base", "nobody"}}, bad("base")},
        {{{"base", 1}}, bad("base")},
        {{{"kind", 1}}, bad("kind")},
        {{{"seed", -1}}, bad("seed")},
        {{{"replace_worse", 1}}, bad("replace_worse")},
        {{{"pair", 1}}, {400, "unknown_parameter", "pair"}},
    };
    for (const auto& [body, refusal] : cases)
        EXPECT_EQ(refusal_of(train(body)), refusal) << body.dump().substr(0, 100);
    EXPECT_EQ(refusal_of(interface_.post("/profiles/mine/train", "image/png", "x")),
              (Refusal{415, "unsupported_format", "file"}));
    EXPECT_EQ(interface_.post("/profiles/mine/train", "application/json", "[]").status,
              400);
}

TEST_F(TrainingTest, ATargetWithADamagedSignatureIsNamed) {
    interface_.sql("UPDATE images SET signature = x'00' WHERE id = 3");
    EXPECT_EQ(refusal_of(train({{"pairs", pairs(24)}})),
              (Refusal{422, "undecodable", "pairs[2]"}));
    log(pairs(24));
    EXPECT_EQ(json_of(train(json::object()))["fit"]["left_out"], 1);
}

TEST_F(TrainingTest, AFailureOfTheDatabaseIsAFailureOfTheServer) {
    interface_.sql("ALTER TABLE feedback RENAME TO gone");
    EXPECT_EQ(train(json::object()).status, 500);
    interface_.sql("ALTER TABLE profiles RENAME TO lost");
    EXPECT_EQ(train({{"pairs", pairs(24)}}).status, 500);
}

}  // namespace
}  // namespace haarmony::server
