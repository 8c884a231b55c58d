// A newcomer's session with the real programs: ingest a folder, serve it, search it.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/e2e/collection.h"

namespace haarmony::e2e {
namespace {

using nlohmann::json;

constexpr int kPictures = 48;

class Search : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder_ = new testing::TemporaryFolder;
        write_pictures(pictures(), kPictures);
        const auto finished = ingest(database(), {pictures()});
        ASSERT_EQ(finished.exit_code, 0) << finished.err;
        daemon_ = new Daemon(database(), {"--media-root", pictures()});
    }
    static void TearDownTestSuite() {
        delete std::exchange(daemon_, nullptr);
        delete std::exchange(folder_, nullptr);
    }

    static std::string pictures() { return folder_->file("pictures"); }
    static std::string database() { return folder_->file("haarmony.db"); }

    // The matches of a JPEG query.
    static json matches(const eval::RgbPicture& query, const std::string& options) {
        auto curl = daemon_->client();
        const auto reply = curl.post("/query?" + options, to_jpeg(query), "image/jpeg");
        EXPECT_EQ(reply.status, 200) << reply.body;
        return json::parse(reply.body)["matches"];
    }

    static bool names(const json& match, int number) {
        return match["uri"].get<std::string>().ends_with("/" + picture_name(number));
    }

    static inline testing::TemporaryFolder* folder_ = nullptr;
    static inline Daemon* daemon_ = nullptr;
};

TEST_F(Search, OriginalFindsItselfAtDistanceZero) {
    for (int number = 0; number < kPictures; number += 7) {
        const json found = matches(picture(number), "profile=scanned&limit=3");
        ASSERT_EQ(found.size(), 3U);
        EXPECT_TRUE(names(found[0], number)) << found[0];
        EXPECT_EQ(found[0]["distance"], 0);
        EXPECT_EQ(found[0]["similarity"], 1);
        EXPECT_EQ(found[0]["rank"], 1);
    }
}

TEST_F(Search, ShrunkenDarkenedBlurredCopyFindsItsOriginalFirst) {
    for (int number = 0; number < kPictures; ++number) {
        const json found =
            matches(eval::poor_copy(picture(number)), "profile=scanned&limit=1");
        ASSERT_EQ(found.size(), 1U);
        EXPECT_TRUE(names(found[0], number)) << number << ": " << found[0];
    }
}

TEST_F(Search, CoarsePaintingFindsItsTargetAmongTheFirstThree) {
    int missed = 0;
    for (int number = 0; number < kPictures; ++number) {
        const json found =
            matches(eval::painted_mosaic(picture(number), 8), "profile=painted&limit=3");
        const bool hit = std::any_of(found.begin(), found.end(), [&](const json& match) {
            return names(match, number);
        });
        if (!hit) ++missed;
    }
    EXPECT_LE(missed, kPictures / 16);
}

TEST_F(Search, OriginalAndThumbnailAreServed) {
    auto curl = daemon_->client();
    const json match = matches(picture(5), "limit=1")[0];
    const auto thumbnail = curl.get(match["thumbnail"]);
    EXPECT_EQ(thumbnail.status, 200);
    EXPECT_EQ(thumbnail.headers.at("content-type"), "image/jpeg");
    const auto original =
        curl.get("/images/" + std::to_string(match["id"].get<int>()) + "/original");
    EXPECT_EQ(original.status, 200);
    EXPECT_EQ(original.body, to_jpeg(picture(5)));
}

TEST_F(Search, StoredIdSignatureAndPictureAskTheSameQuestion) {
    auto curl = daemon_->client();
    const json by_picture = matches(picture(9), "limit=10");
    const int id = by_picture[0]["id"];
    const json by_id =
        json::parse(curl.get("/query?limit=10&id=" + std::to_string(id)).body);
    EXPECT_EQ(by_id["matches"], by_picture);
    const std::string signature = by_id["query"]["signature"];
    const json by_signature =
        json::parse(curl.get("/query?limit=10&signature=" + signature).body);
    EXPECT_EQ(by_signature["matches"], by_picture);
}

TEST_F(Search, PageIsServedWithoutAWebFolder) {
    auto curl = daemon_->client();
    const auto page = curl.get("/");
    EXPECT_EQ(page.status, 200);
    EXPECT_TRUE(page.headers.at("content-type").starts_with("text/html"));
    EXPECT_NE(page.body.find("Haarmony"), std::string::npos);
}

}  // namespace
}  // namespace haarmony::e2e
