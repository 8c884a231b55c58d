#include "server/app/profile_training.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "engine/image/signature_codec.h"
#include "ingest/stored_profile.h"
#include "tests/schema/raw_sql.h"
#include "tests/server/app/collection.h"

namespace haarmony::server {
namespace {

constexpr int kPairs = 24;

class ProfileTrainingTest : public testing::Test {
  protected:
    ProfileTrainingTest() : connection_(beside(collection_)) {
        for (int i = 0; i < kPairs; ++i) {
            rows_.push_back(file_row(static_cast<unsigned>(i + 1), uri(i)));
            ids_.push_back(*connection_->images().add(rows_.back()));
        }
        options_.name = "mine";
    }

    static std::string uri(int i) { return "file:///" + std::to_string(i) + ".jpg"; }

    // Each picture remembered as the one `shift` places on.
    [[nodiscard]] std::vector<QueryPair> pairs(std::size_t shift = 0) const {
        std::vector<QueryPair> all(ids_.size());
        for (std::size_t i = 0; i < ids_.size(); ++i) {
            all[i].signature =
                *image::decode_signature(rows_[(i + shift) % ids_.size()].signature);
            all[i].target = ids_[i];
        }
        return all;
    }
    [[nodiscard]] Result<ProfileFit> fit(const std::vector<QueryPair>& pairs) {
        return fit_profile(*connection_, pairs, options_);
    }
    [[nodiscard]] Error refusal(const std::vector<QueryPair>& pairs) {
        const auto fitted = fit(pairs);
        return fitted ? Error{} : fitted.error();
    }
    void put(image::Profile profile) {
        profile.name = "mine";
        ASSERT_TRUE(connection_->profiles().put(ingest::to_stored(profile)));
    }
    void spoil(const std::string& sql) {
        const schema::RawConnection raw(collection_.path());
        schema::run_sql(raw.handle(), sql);
    }

    Collection collection_;
    std::unique_ptr<Connection> connection_;
    std::vector<schema::NewImage> rows_;
    std::vector<ImageId> ids_;
    ProfileFitOptions options_;
};

TEST_F(ProfileTrainingTest, FitsAmongThePicturesOfTheCollection) {
    const auto fitted = fit(pairs());
    ASSERT_TRUE(fitted) << fitted.error().message;
    EXPECT_EQ(fitted->report.profile.name, "mine");
    EXPECT_EQ(fitted->report.held_back.candidates, kPairs + 1);
    EXPECT_EQ(fitted->left_out, 0U);
    EXPECT_FALSE(fitted->existing);
    EXPECT_FALSE(fitted->worse);
    EXPECT_FALSE(connection_->profiles().get("mine"));
    const auto stored = store_fit(*connection_, *fitted, options_);
    ASSERT_TRUE(stored);
    EXPECT_TRUE(*stored);
    EXPECT_EQ(connection_->profiles().get("mine")->weights,
              fitted->report.profile.weights);
}

TEST_F(ProfileTrainingTest, NoMoreMismatchesThanTheBoundAreRead) {
    const auto filled = connection_->images().transaction([&]() -> Result<void> {
        for (std::size_t i = ids_.size(); i <= kMaxMismatches; ++i) {
            schema::NewImage row = rows_[i % rows_.size()];
            row.uri = uri(static_cast<int>(i));
            row.thumbnail = {};
            if (const auto id = connection_->images().add(row); !id) return id.error();
        }
        return {};
    });
    ASSERT_TRUE(filled) << filled.error().message;
    ASSERT_EQ(connection_->images().counts()->indexed,
              static_cast<std::int64_t>(kMaxMismatches) + 1);
    const auto fitted = fit(pairs());
    ASSERT_TRUE(fitted) << fitted.error().message;
    EXPECT_EQ(fitted->report.held_back.candidates,
              static_cast<std::int64_t>(kMaxMismatches) + 1);
}

TEST_F(ProfileTrainingTest, IsTheSameUnderOneSeed) {
    const auto first = fit(pairs(5));
    const auto again = fit(pairs(5));
    options_.seed = 2;
    const auto other = fit(pairs(5));
    ASSERT_TRUE(first && again && other);
    EXPECT_EQ(first->report.profile.weights, again->report.profile.weights);
    EXPECT_EQ(first->report.held_back.after, again->report.held_back.after);
    EXPECT_NE(first->report.held_back.pairs, other->report.held_back.pairs);
}

TEST_F(ProfileTrainingTest, TheExistingProfileIsRankedOverTheSamePairs) {
    put(*image::built_in_profile("scanned"));
    const auto against_scanned = fit(pairs(3));
    ASSERT_TRUE(against_scanned);
    ASSERT_TRUE(against_scanned->existing);
    options_.base = "scanned";
    const auto from_scanned = fit(pairs(3));
    ASSERT_TRUE(from_scanned);
    EXPECT_EQ(*against_scanned->existing, from_scanned->report.held_back.before_summary);
}

TEST_F(ProfileTrainingTest, AnExistingProfileOfAnotherKindIsNotReplacedUnasked) {
    image::Profile lab = *image::built_in_profile("painted");
    lab.kind.color_space = image::ColorSpace::kLab;
    put(lab);
    const auto fitted = fit(pairs());
    ASSERT_TRUE(fitted);
    EXPECT_TRUE(fitted->report.better);
    EXPECT_FALSE(fitted->existing);
    EXPECT_TRUE(fitted->worse);
    EXPECT_FALSE(*store_fit(*connection_, *fitted, options_));
    EXPECT_EQ(connection_->profiles().get("mine")->color_space, "lab");
    options_.replace_worse = true;
    EXPECT_TRUE(*store_fit(*connection_, *fitted, options_));
    EXPECT_EQ(connection_->profiles().get("mine")->color_space, "yiq");
}

TEST_F(ProfileTrainingTest, AnExistingProfileThatIsNotUnderstoodIsNotReplacedUnasked) {
    put(*image::built_in_profile("painted"));
    spoil("UPDATE profiles SET bin_rule = 'cubic'");
    const auto fitted = fit(pairs());
    ASSERT_TRUE(fitted);
    EXPECT_TRUE(fitted->worse);
    EXPECT_FALSE(*store_fit(*connection_, *fitted, options_));
}

TEST_F(ProfileTrainingTest, AProfileThatWasChangedMeanwhileIsNotReplacedUnasked) {
    const auto fitted = fit(pairs());
    ASSERT_TRUE(fitted);
    put(*image::built_in_profile("scanned"));
    const auto refused = store_fit(*connection_, *fitted, options_);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kConflict);
    EXPECT_EQ(refused.error().param, "name");
    EXPECT_EQ(connection_->profiles().get("mine")->m, 40);
    options_.replace_worse = true;
    EXPECT_TRUE(*store_fit(*connection_, *fitted, options_));
    EXPECT_EQ(connection_->profiles().get("mine")->m, 60);
}

TEST_F(ProfileTrainingTest, BuiltInNamesAreRefused) {
    options_.name = "scanned";
    const Error error = refusal(pairs());
    EXPECT_EQ(error.code, ErrorCode::kConflict);
    EXPECT_EQ(error.param, "name");
}

TEST_F(ProfileTrainingTest, AnUnknownBaseIsNamed) {
    options_.base = "nobody";
    const Error error = refusal(pairs());
    EXPECT_EQ(error.code, ErrorCode::kInvalidArgument);
    EXPECT_EQ(error.param, "base");
    EXPECT_NE(error.message.find("nobody"), std::string::npos);
}

TEST_F(ProfileTrainingTest, ABaseThatIsNotUnderstoodIsNamed) {
    put(*image::built_in_profile("painted"));
    spoil("UPDATE profiles SET bin_rule = 'cubic'");
    options_.base = "mine";
    EXPECT_NE(refusal(pairs()).message.find("cubic"), std::string::npos);
}

TEST_F(ProfileTrainingTest, TooManyPairsAreRefused) {
    std::vector<QueryPair> many(kMaxTrainingPairs + 1, pairs().front());
    const Error error = refusal(many);
    EXPECT_EQ(error.param, "pairs");
    EXPECT_NE(error.message.find("5001 pairs: at most 5000"), std::string::npos);
}

TEST_F(ProfileTrainingTest, PairsThatTeachNothingAreNamedOrLeftOut) {
    std::vector<QueryPair> all = pairs();
    all[1].signature->low_information = true;
    all[2].signature->kind.color_space = image::ColorSpace::kLuv;
    all[3].target = ImageId{999};
    const auto named = [&](std::size_t index, ErrorCode code, const std::string& says) {
        std::vector<QueryPair> one = pairs();
        one[index] = all[index];
        const Error error = refusal(one);
        EXPECT_EQ(error.code, code) << error.message;
        EXPECT_EQ(error.param, "pairs[" + std::to_string(index) + "]");
        const std::string pair = "pair " + std::to_string(index + 1) + ": ";
        EXPECT_EQ(error.message.find(pair), 0U) << error.message;
        EXPECT_NE(error.message.find(says), std::string::npos) << error.message;
    };
    named(1, ErrorCode::kInvalidArgument, "no information");
    named(2, ErrorCode::kInvalidArgument, "luv-standard");
    named(3, ErrorCode::kNotFound, "999");

    options_.unusable = Unusable::kLeftOut;
    const auto fitted = fit(all);
    ASSERT_TRUE(fitted) << fitted.error().message;
    EXPECT_EQ(fitted->left_out, 3U);
    all.resize(22);
    EXPECT_NE(refusal(all).message.find(
                  "19 pairs of 22 can be learned from: at least 20 are needed"),
              std::string::npos);
}

TEST_F(ProfileTrainingTest, ASignatureWithoutCoefficientsTeachesNothing) {
    std::vector<QueryPair> all = pairs();
    for (auto& channel : all[4].signature->channels) channel.count = 0;
    EXPECT_EQ(refusal(all).param, "pairs[4]");
}

TEST_F(ProfileTrainingTest, OnlyOnePictureHasNoMismatches) {
    std::vector<QueryPair> all = pairs();
    for (QueryPair& pair : all) pair.target = ids_[0];
    spoil("DELETE FROM images WHERE id <> " + std::to_string(to_int(ids_[0])));
    const Error error = refusal(all);
    EXPECT_EQ(error.code, ErrorCode::kInvalidArgument);
    EXPECT_EQ(error.param, "mismatches");
}

TEST_F(ProfileTrainingTest, FailuresOfTheDatabaseAreNoPairsFault) {
    options_.unusable = Unusable::kLeftOut;
    spoil("ALTER TABLE images RENAME TO gone");
    EXPECT_EQ(refusal(pairs()).code, ErrorCode::kIo);
}

}  // namespace
}  // namespace haarmony::server
