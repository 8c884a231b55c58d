// /clusters: an overview of the collection.
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "tests/server/api/interface.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

class ClustersTest : public testing::Test {
  protected:
    ClustersTest() {
        for (unsigned number = 0; number < 8; ++number)
            interface_.collection.add(number % 4 + 1,
                                      {"", {number < 5 ? "sea" : "sky"}, "{}"});
    }
    json clusters(const std::string& parameters = "") {
        const http::Response response = interface_.get("/clusters" + parameters);
        EXPECT_EQ(response.status, 200) << body_of(response);
        return json_of(response);
    }

    Interface interface_;
};

TEST_F(ClustersTest, EveryPictureIsInOneClusterAndEqualOnesAreTogether) {
    const json reply = clusters("?count=4");
    EXPECT_EQ(reply["count"], 4);
    EXPECT_EQ(reply["seed"], 1);
    EXPECT_EQ(reply["profile"], "painted");
    EXPECT_EQ(reply["searched"], 8);
    EXPECT_EQ(reply["total_cost"], 0.0);  // each scene is there twice
    std::set<std::int64_t> seen;
    for (const json& cluster : reply["clusters"]) {
        EXPECT_EQ(cluster["size"], 2);
        EXPECT_EQ(cluster["members"][0], cluster["representative"]);
        const std::int64_t first = cluster["members"][0]["id"];
        const std::int64_t second = cluster["members"][1]["id"];
        EXPECT_EQ((first - second) % 4, 0);
        seen.insert({first, second});
    }
    EXPECT_EQ(seen.size(), 8);
    EXPECT_EQ(clusters("?count=4")["clusters"], reply["clusters"]);
}

TEST_F(ClustersTest, OptionsAreObeyed) {
    EXPECT_EQ(clusters("?count=1")["clusters"].size(), 1);
    const json one = clusters("?count=1&members=3&seed=5&profile=scanned");
    EXPECT_EQ(one["clusters"][0]["members"].size(), 3);
    EXPECT_EQ(one["clusters"][0]["size"], 8);
    EXPECT_EQ(one["seed"], 5);
    EXPECT_EQ(one["profile"], "scanned");
    EXPECT_EQ(clusters("?tags=sea")["searched"], 5);
    EXPECT_EQ(clusters("?text=sky")["searched"], 3);
}

TEST_F(ClustersTest, AnEmptyCollectionHasNone) {
    Interface empty;
    const json reply = json_of(empty.get("/clusters"));
    EXPECT_EQ(reply["clusters"], json::array());
    EXPECT_EQ(reply["count"], 0);
    EXPECT_EQ(reply["searched"], 0);
}

TEST_F(ClustersTest, RefusesByName) {
    const std::vector<std::pair<std::string, Refusal>> refusals{
        {"?count=0", {400, "invalid_argument", "count"}},
        {"?count=101", {400, "invalid_argument", "count"}},
        {"?seed=-1", {400, "invalid_argument", "seed"}},
        {"?members=1001", {400, "invalid_argument", "members"}},
        {"?profile=x", {400, "unknown_profile", "profile"}},
        {"?k=4", {400, "unknown_parameter", "k"}}};
    for (const auto& [parameters, refusal] : refusals)
        EXPECT_EQ(refusal_of(interface_.get("/clusters" + parameters)), refusal)
            << parameters;
}

TEST_F(ClustersTest, ADatabaseThatFailsIsA500) {
    interface_.sql("ALTER TABLE images RENAME TO elsewhere");
    EXPECT_EQ(refusal_of(interface_.get("/clusters")), (Refusal{500, "internal", ""}));
}

}  // namespace
}  // namespace haarmony::server
