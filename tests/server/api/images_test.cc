// /images: storing, listing, reading and deleting.
#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <vector>

#include "ingest/describe.h"
#include "tests/server/api/interface.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

class ImagesTest : public testing::Test {
  protected:
    // The ids of a list's pages, one after the other.
    std::vector<std::int64_t> listed(const std::string& parameters) {
        std::vector<std::int64_t> ids;
        std::string cursor;
        do {
            const json page = json_of(interface_.get(
                "/images?" + parameters + (cursor.empty() ? "" : "&cursor=" + cursor)));
            for (const json& item : page["items"]) ids.push_back(item["id"]);
            cursor = page["next_cursor"].is_null() ? "" : page["next_cursor"];
        } while (!cursor.empty());
        return ids;
    }

    Interface interface_;
};

TEST_F(ImagesTest, EveryFormStoresThePictureAndWhatIsSaidAboutIt) {
    const std::string bytes = text_of(jpeg_scene(1));
    const json metadata{{"a", {{"b", nullptr}}}};
    const std::vector<http::Response> replies{
        interface_.post(
            "/images?uri=x:1&tags=sea,%20sky%20,sea&metadata=%7B%22a%22:%7B%22b%22:"
            "null%7D%7D",
            "image/jpeg",
            bytes),
        interface_.post("/images",
                        std::string(kFormType),
                        form_of({{"uri", "x:1"},
                                 {"tags", R"(["sky","sea"])"},
                                 {"metadata", metadata.dump()},
                                 {"file", bytes, "a.jpg"}})),
        interface_.post_json("/images",
                             {{"image", base64(bytes)},
                              {"uri", "x:1"},
                              {"tags", {"sky", "sea"}},
                              {"metadata", metadata}}),
        interface_.post_json(
            "/images?uri=x:1",
            {{"image", base64(bytes)}, {"tags", "sea,sky"}, {"metadata", metadata}}),
    };
    for (std::size_t i = 0; i < replies.size(); ++i) {
        SCOPED_TRACE(i);
        ASSERT_EQ(replies[i].status, 201) << body_of(replies[i]);
        const std::string address = "/images/" + std::to_string(i + 1);
        EXPECT_EQ(json_of(replies[i]), (json{{"id", i + 1}}));
        EXPECT_EQ(header_of(replies[i], "Location"), address);
        const json image = json_of(interface_.get(address));
        EXPECT_EQ(image["uri"], "x:1");
        EXPECT_EQ(image["tags"], (json{"sea", "sky"}));
        EXPECT_EQ(image["metadata"], metadata);
        EXPECT_EQ(image["state"], "indexed");
        EXPECT_EQ(image["origin"], "upload");
        EXPECT_EQ(image["media_type"], "image/jpeg");
        EXPECT_EQ(image["bytes"], bytes.size());
        EXPECT_EQ(image["content_hash"], ingest::content_hash(jpeg_scene(1)));
        EXPECT_EQ(image["width"], 96);
        EXPECT_EQ(image["height"], 64);
        const json reply = json_of(interface_.get("/query?id=" + std::to_string(i + 1)));
        EXPECT_EQ(reply["matches"][0]["distance"], 0.0);
    }
}

TEST_F(ImagesTest, NothingNeedsToBeSaidAboutAPicture) {
    ASSERT_EQ(interface_.post("/images", "image/jpeg", text_of(jpeg_scene(1))).status,
              201);
    const json image = json_of(interface_.get("/images/1"));
    EXPECT_EQ(image["uri"], nullptr);
    EXPECT_EQ(image["tags"], json::array());
    EXPECT_EQ(image["metadata"], json::object());
}

TEST_F(ImagesTest, BadUploadsAreRefusedAndStoreNothing) {
    const std::string image = base64(text_of(jpeg_scene(1)));
    const json tag_of_129 = {std::string(129, 't')};
    const std::vector<std::tuple<json, Refusal>> cases{
        {json::object(), {400, "no_source", ""}},
        {{{"image", image}, {"url", "http://x"}}, {400, "several_sources", "url"}},
        {{{"image", image}, {"id", 1}}, {400, "unknown_parameter", "id"}},
        {{{"image", image}, {"limit", 1}}, {400, "unknown_parameter", "limit"}},
        {{{"image", image}, {"uri", 5}}, {400, "invalid_argument", "uri"}},
        {{{"image", image}, {"uri", "a\nb"}}, {400, "invalid_argument", "uri"}},
        {{{"image", image}, {"uri", std::string(8193, 'u')}},
         {400, "invalid_argument", "uri"}},
        {{{"image", image}, {"tags", 5}}, {400, "invalid_argument", "tags"}},
        {{{"image", image}, {"tags", {1}}}, {400, "invalid_argument", "tags"}},
        {{{"image", image}, {"tags", {"a,b"}}}, {400, "invalid_argument", "tags"}},
        {{{"image", image}, {"tags", "a,,b"}}, {400, "invalid_argument", "tags"}},
        {{{"image", image}, {"tags", {" "}}}, {400, "invalid_argument", "tags"}},
        {{{"image", image}, {"tags", {"a\tb"}}}, {400, "invalid_argument", "tags"}},
        {{{"image", image}, {"tags", "[\"a\""}}, {400, "invalid_argument", "tags"}},
        {{{"image", image}, {"tags", tag_of_129}}, {400, "invalid_argument", "tags"}},
        {{{"image", image}, {"tags", std::vector<std::string>(257, "t")}},
         {400, "invalid_argument", "tags"}},
        {{{"image", image}, {"metadata", "{}"}}, {400, "invalid_argument", "metadata"}},
        {{{"image", image}, {"metadata", {1}}}, {400, "invalid_argument", "metadata"}},
        {{{"image", image}, {"metadata", {{"k", std::string(65'536, 'v')}}}},
         {400, "invalid_argument", "metadata"}},
        {{{"image", "Zm9v"}}, {415, "unsupported_format", ""}},
        {{{"image", base64(text_of(jpeg_scene(1)).substr(0, 100))}},
         {422, "undecodable", ""}},
    };
    for (const auto& [body, expected] : cases)
        EXPECT_EQ(refusal_of(interface_.post_json("/images", body)), expected)
            << body.dump().substr(0, 200);
    EXPECT_EQ(refusal_of(interface_.post(
                  "/images?metadata=[1]", "image/jpeg", text_of(jpeg_scene(1)))),
              (Refusal{400, "invalid_argument", "metadata"}));
    EXPECT_TRUE(listed("limit=10").empty());
}

TEST_F(ImagesTest, ListsInPagesByIdAndTags) {
    std::vector<std::int64_t> all;
    std::vector<std::int64_t> even;
    for (unsigned number = 1; number <= 7; ++number) {
        const bool is_even = number % 2 == 0;
        interface_.collection.add(1,
                                  {"",
                                   is_even ? std::vector<std::string>{"even", "any"}
                                           : std::vector<std::string>{"any"}});
        all.push_back(number);
        if (is_even) even.push_back(number);
    }
    for (const char* limit : {"1", "2", "3", "6", "7", "8", "1000"}) {
        SCOPED_TRACE(limit);
        EXPECT_EQ(listed(std::string("limit=") + limit), all);
        EXPECT_EQ(listed(std::string("tags=any,%20even&limit=") + limit), even);
    }
    EXPECT_TRUE(listed("tags=odd").empty());
    const json page = json_of(interface_.get("/images"));
    EXPECT_EQ(page["items"].size(), 7U);
    EXPECT_EQ(page["next_cursor"], nullptr);
    EXPECT_EQ(page["items"][0], json_of(interface_.get("/images/1")));
}

TEST_F(ImagesTest, BadListParametersAreRefused) {
    const std::vector<std::tuple<std::string, Refusal>> cases{
        {"limit=0", {400, "invalid_argument", "limit"}},
        {"limit=1001", {400, "invalid_argument", "limit"}},
        {"cursor=abc", {400, "invalid_argument", "cursor"}},
        {"cursor=0", {400, "invalid_argument", "cursor"}},
        {"tags=a,,b", {400, "invalid_argument", "tags"}},
        {"text=...", {400, "invalid_argument", "text"}},
        {"text=" + std::string(1025, 'x'), {400, "invalid_argument", "text"}},
        {"offset=5", {400, "unknown_parameter", "offset"}},
        {"limit=1&limit=2", {400, "repeated_parameter", "limit"}},
    };
    for (const auto& [parameters, expected] : cases)
        EXPECT_EQ(refusal_of(interface_.get("/images?" + parameters)), expected)
            << parameters;
}

TEST_F(ImagesTest, DeletedPicturesAreGone) {
    interface_.collection.add(1);
    interface_.collection.add(2);
    const http::Response deleted = interface_.send("DELETE", "/images/1");
    EXPECT_EQ(deleted.status, 204);
    EXPECT_EQ(body_of(deleted), "");
    for (const std::string part :
         {"", "/thumbnail", "/original", "/signature", "/similar"})
        EXPECT_EQ(refusal_of(interface_.get("/images/1" + part)),
                  (Refusal{404, "not_found", "id"}))
            << part;
    EXPECT_EQ(refusal_of(interface_.send("DELETE", "/images/1")),
              (Refusal{404, "not_found", "id"}));
    EXPECT_EQ(listed("limit=10"), std::vector<std::int64_t>{2});
    const json reply = json_of(interface_.get("/query?id=2"));
    EXPECT_EQ(reply["matches"].size(), 1U);
    // Ids are never given out again.
    EXPECT_EQ(to_int(interface_.collection.add(3)), 3);
}

TEST_F(ImagesTest, IdsAreWholeNumbersAboveZero) {
    for (const std::string id :
         {"0", "-1", "1x", "x", "1.0", "99999999999999999999", "%201"})
        for (const std::string part : {"", "/thumbnail", "/original", "/signature"}) {
            EXPECT_EQ(refusal_of(interface_.get("/images/" + id + part)),
                      (Refusal{400, "invalid_argument", "id"}))
                << id << part;
        }
    EXPECT_EQ(refusal_of(interface_.send("DELETE", "/images/x")),
              (Refusal{400, "invalid_argument", "id"}));
    EXPECT_EQ(refusal_of(interface_.get("/images/5")), (Refusal{404, "not_found", "id"}));
}

TEST_F(ImagesTest, StoredThingsHaveTagsThatChangeWithThem) {
    interface_.collection.add(1);
    for (const std::string target :
         {"/images/1", "/images/1/thumbnail", "/images/1/signature", "/images"}) {
        SCOPED_TRACE(target);
        const http::Response full = interface_.get(target);
        const std::string etag = header_of(full, "ETag");
        ASSERT_FALSE(etag.empty());
        const http::Response same = interface_.get(target, {{"If-None-Match", etag}});
        EXPECT_EQ(same.status, 304);
        EXPECT_EQ(body_of(same), "");
        EXPECT_EQ(interface_.get(target, {{"If-None-Match", "\"other\""}}).status, 200);
    }
    const std::string row = header_of(interface_.get("/images/1"), "ETag");
    const std::string list = header_of(interface_.get("/images"), "ETag");
    const auto other = beside(interface_.collection);
    ASSERT_TRUE(other->images().update(ImageId{1}, file_row(2, "")));
    EXPECT_NE(header_of(interface_.get("/images/1"), "ETag"), row);
    EXPECT_NE(header_of(interface_.get("/images"), "ETag"), list);
}

TEST_F(ImagesTest, AFailedFileTellsWhy) {
    const auto other = beside(interface_.collection);
    const auto id = other->images().mark_failed("file:///bad.jpg", {}, "truncated");
    ASSERT_TRUE(id);
    const std::string address = "/images/" + std::to_string(to_int(id.value()));
    const json image = json_of(interface_.get(address));
    EXPECT_EQ(image["state"], "failed");
    EXPECT_EQ(image["failure"], "truncated");
    EXPECT_EQ(image["thumbnail"], nullptr);
    for (const std::string part : {"/thumbnail", "/signature", "/similar"})
        EXPECT_EQ(interface_.get(address + part).status, 404) << part;
    EXPECT_TRUE(listed("limit=10").empty());
}

TEST_F(ImagesTest, AddressesThatTakeNoParametersSaySo) {
    interface_.collection.add(1);
    for (const std::string target : {"/images/1",
                                     "/images/1/thumbnail",
                                     "/images/1/original",
                                     "/images/1/signature"})
        EXPECT_EQ(refusal_of(interface_.get(target + "?size=1")),
                  (Refusal{400, "unknown_parameter", "size"}))
            << target;
    EXPECT_EQ(refusal_of(interface_.send("DELETE", "/images/1?force=1")),
              (Refusal{400, "unknown_parameter", "force"}));
    EXPECT_EQ(interface_.get("/images/1").status, 200);
}

}  // namespace
}  // namespace haarmony::server
