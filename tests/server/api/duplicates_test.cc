// /duplicates: what is there more than once, and what somebody says is not.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "ingest/thumbnail.h"
#include "tests/server/api/interface.h"
#include "tests/server/app/job_watch.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

class DuplicatesTest : public testing::Test {
  protected:
    // Two equal files, a copy of them in other bytes, and another picture.
    DuplicatesTest() {
        interface_.collection.add(1);
        interface_.collection.add(1);
        const auto copy = ingest::encode_jpeg(image::scene(96, 64, 1).view(), 70);
        (void)interface_.collection.service->add(copy.value(), {}).value();
        interface_.collection.add(2);
    }
    void search() {
        EXPECT_EQ(done(*interface_.jobs, "find_duplicates", "{}").state,
                  schema::JobState::kDone);
    }
    json listed(const std::string& parameters = "") {
        return json_of(interface_.get("/duplicates" + parameters));
    }

    Interface interface_;
};

TEST_F(DuplicatesTest, EqualFilesAreListedBeforeAnySearchAndCopiesAfterIt) {
    const json before = listed();
    EXPECT_EQ(before["as_of"], nullptr);
    ASSERT_EQ(before["items"].size(), 1);
    EXPECT_EQ(before["items"][0]["ids"], (json{1, 2}));
    EXPECT_EQ(before["items"][0]["level"], "exact");
    EXPECT_EQ(before["items"][0]["similarity"], 1.0);
    EXPECT_EQ(before["items"][0]["images"][1], json_of(interface_.get("/images/2")));

    search();
    const json after = listed();
    EXPECT_EQ(after["as_of"], json_of(interface_.get("/jobs/1"))["finished_at"]);
    ASSERT_EQ(after["items"].size(), 1);
    EXPECT_EQ(after["items"][0]["ids"], (json{1, 2, 3}));
    EXPECT_EQ(after["items"][0]["level"], "near");
    EXPECT_LT(after["items"][0]["similarity"], 1.0);
    EXPECT_EQ(listed("?level=near")["items"], after["items"]);
    EXPECT_EQ(listed("?level=exact")["items"], before["items"]);
    EXPECT_EQ(listed("?min_similarity=1")["items"], before["items"]);
}

TEST_F(DuplicatesTest, PagesFollowOneAnother) {
    interface_.collection.add(2);
    const json first = listed("?limit=1");
    ASSERT_EQ(first["items"].size(), 1);
    EXPECT_EQ(first["next_cursor"], "1");
    const json second = listed("?limit=1&cursor=1");
    EXPECT_EQ(second["items"][0]["ids"], (json{4, 5}));
    EXPECT_EQ(second["next_cursor"], nullptr);
}

TEST_F(DuplicatesTest, WhatIsIgnoredStaysAwayThroughLaterSearches) {
    for (const json& ids : {json{2, 1}, json{1, 3}, json{2, 3}})
        EXPECT_EQ(interface_.post_json("/duplicates/ignore", {{"ids", ids}}).status, 204);
    EXPECT_EQ(listed()["items"], json::array());
    search();
    EXPECT_EQ(listed()["items"], json::array());
}

TEST_F(DuplicatesTest, RefusesByName) {
    const std::vector<std::pair<std::string, Refusal>> lists{
        {"?level=same", {400, "invalid_argument", "level"}},
        {"?min_similarity=2", {400, "invalid_argument", "min_similarity"}},
        {"?limit=0", {400, "invalid_argument", "limit"}},
        {"?cursor=x", {400, "invalid_argument", "cursor"}},
        {"?sort=1", {400, "unknown_parameter", "sort"}}};
    for (const auto& [parameters, refusal] : lists)
        EXPECT_EQ(refusal_of(interface_.get("/duplicates" + parameters)), refusal)
            << parameters;
    const auto refused = [&](const json& body) {
        return refusal_of(interface_.post_json("/duplicates/ignore", body));
    };
    for (const json& ids :
         {json(1), json{1}, json{1, 1}, json{1, 0}, json{1, "2"}, json{1, 2, 3}})
        EXPECT_EQ(refused({{"ids", ids}}), (Refusal{400, "invalid_argument", "ids"}))
            << ids;
    EXPECT_EQ(refused(json::object()), (Refusal{400, "invalid_argument", "ids"}));
    EXPECT_EQ(refused({{"ids", {1, 77}}}), (Refusal{404, "not_found", "id"}));
    EXPECT_EQ(refused({{"ids", {1, 2}}, {"why", 1}}),
              (Refusal{400, "unknown_parameter", "why"}));
}

}  // namespace
}  // namespace haarmony::server
