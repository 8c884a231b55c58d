#include "schema/feedback_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "schema/image_store.h"
#include "tests/schema/pictures.h"
#include "tests/schema/raw_sql.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::schema {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class FeedbackPairs : public testing::Test {
  protected:
    [[nodiscard]] NewFeedback pair(const std::string& kind, ImageId target) const {
        NewFeedback feedback;
        feedback.kind = kind;
        feedback.target = target;
        feedback.signature = some_bytes(3, 100);
        return feedback;
    }
    [[nodiscard]] std::vector<std::int64_t> listed(
        std::optional<std::string_view> kind,
        std::optional<std::int64_t> after = std::nullopt,
        int limit = 100) {
        std::vector<std::int64_t> ids;
        for (const Feedback& one : expect(store_.list(kind, after, limit))) {
            ids.push_back(one.id);
        }
        return ids;
    }

    ScratchFolder folder_;
    Database database_ = open_database(folder_.file("x.db"));
    ImageStore images_{database_};
    FeedbackStore store_{database_};
    ImageId one_ = expect(images_.add(upload_picture(1)));
    ImageId two_ = expect(images_.add(file_picture(2)));
};

TEST_F(FeedbackPairs, ComeBackWhole) {
    NewFeedback drawn = pair("painted", two_);
    drawn.strokes = R"([{"x":1}])";
    drawn.seconds = 12.5;
    const auto id = expect(store_.add(drawn));
    NewFeedback strokes_only;
    strokes_only.kind = "painted";
    strokes_only.target = one_;
    strokes_only.strokes = "{}";
    expect(store_.add(strokes_only));

    const auto all = expect(store_.list("painted", std::nullopt, 10));
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[0].id, id);
    EXPECT_EQ(all[0].kind, "painted");
    EXPECT_EQ(all[0].target, two_);
    EXPECT_EQ(all[0].signature, drawn.signature);
    EXPECT_EQ(all[0].strokes, drawn.strokes);
    EXPECT_EQ(all[0].seconds, 12.5);
    EXPECT_EQ(all[0].created_at.size(), std::string("2000-01-01T00:00:00.000Z").size());
    EXPECT_THAT(all[1].signature, IsEmpty());
    EXPECT_FALSE(all[1].seconds.has_value());
}

TEST_F(FeedbackPairs, AreListedAndCountedByKindInSteps) {
    const auto a = expect(store_.add(pair("painted", one_)));
    const auto b = expect(store_.add(pair("scanned", one_)));
    const auto c = expect(store_.add(pair("painted", two_)));
    EXPECT_THAT(listed(std::nullopt), ElementsAre(a, b, c));
    EXPECT_THAT(listed("painted"), ElementsAre(a, c));
    EXPECT_THAT(listed("painted", std::nullopt, 1), ElementsAre(a));
    EXPECT_THAT(listed("painted", a, 1), ElementsAre(c));
    EXPECT_THAT(listed(std::nullopt, b), ElementsAre(c));
    EXPECT_THAT(listed("other"), IsEmpty());
    EXPECT_EQ(expect(store_.count("painted")), 2);
    EXPECT_EQ(expect(store_.count("other")), 0);
    EXPECT_EQ(expect(store_.count(std::nullopt)), 3);
}

TEST_F(FeedbackPairs, WaitWhileTheirTargetCannotBeSearchedAndGoWithItsRow) {
    const auto upload = expect(store_.add(pair("painted", one_)));
    const auto file = expect(store_.add(pair("painted", two_)));
    expect(images_.remove(two_));  // its row stays
    EXPECT_THAT(listed("painted"), ElementsAre(upload));
    EXPECT_EQ(expect(store_.count(std::nullopt)), 1);
    expect(images_.update(two_, file_picture(2)));
    EXPECT_THAT(listed(std::nullopt), ElementsAre(upload, file));
    expect(images_.remove(one_));
    expect(images_.purge(two_));
    EXPECT_EQ(sql_integer(database_.handle(), "SELECT count(*) FROM feedback"), 0);
}

TEST_F(FeedbackPairs, AreRemovedOnceAndTheirIdsNeverUsedAgain) {
    const auto id = expect(store_.add(pair("painted", one_)));
    expect(store_.remove(id));
    const auto again = store_.remove(id);
    ASSERT_FALSE(again);
    EXPECT_EQ(again.error().code, ErrorCode::kNotFound);
    EXPECT_EQ(again.error().message, "no feedback " + std::to_string(id));
    EXPECT_GT(expect(store_.add(pair("painted", one_))), id);
}

TEST_F(FeedbackPairs, ATargetThatIsNotSearchableIsNamed) {
    expect(images_.remove(two_));
    for (const ImageId target : {two_, ImageId{99}}) {
        const auto refused = store_.add(pair("painted", target));
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::kNotFound);
        EXPECT_EQ(refused.error().message, "no image " + std::to_string(to_int(target)));
        EXPECT_EQ(refused.error().param, "target");
    }
}

TEST_F(FeedbackPairs, BadValuesAreRefusedByName) {
    const std::pair<std::string, void (*)(NewFeedback&)> bad[] = {
        {"kind_is_a_word", [](NewFeedback& f) { f.kind.clear(); }},
        {"kind_is_a_word", [](NewFeedback& f) { f.kind.assign(65, 'k'); }},
        {"query_is_there", [](NewFeedback& f) { f.signature.clear(); }},
        {"strokes_are_json", [](NewFeedback& f) { f.strokes = "{"; }},
        {"seconds_are_a_time", [](NewFeedback& f) { f.seconds = -0.5; }},
        {"seconds_are_a_time",
         [](NewFeedback& f) { f.seconds = std::numeric_limits<double>::infinity(); }},
        {"nan seconds",
         [](NewFeedback& f) { f.seconds = std::numeric_limits<double>::quiet_NaN(); }},
    };
    for (const auto& [reason, spoil] : bad) {
        NewFeedback feedback = pair("painted", one_);
        spoil(feedback);
        const auto refused = store_.add(feedback);
        ASSERT_FALSE(refused) << reason;
        EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
        EXPECT_NE(refused.error().message.find(reason), std::string::npos)
            << refused.error().message;
    }
    EXPECT_EQ(expect(store_.count(std::nullopt)), 0);
}

}  // namespace
}  // namespace haarmony::schema
