#include "schema/profile_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "tests/schema/pictures.h"
#include "tests/schema/raw_sql.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::schema {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class Profiles : public testing::Test {
  protected:
    [[nodiscard]] static StoredProfile profile(const std::string& name) {
        StoredProfile made;
        made.name = name;
        made.color_space = "yiq";
        made.decomposition = "standard";
        made.m = 60;
        made.bin_rule = "min";
        std::int32_t weight = -7;
        for (auto& channel : made.weights) {
            for (std::int32_t& bin : channel) bin = weight += 1'000'003;
        }
        made.weights[0][0] = std::numeric_limits<std::int32_t>::min();
        made.weights[2][5] = std::numeric_limits<std::int32_t>::max();
        return made;
    }

    ScratchFolder folder_;
    Database database_ = open_database(folder_.file("x.db"));
    ProfileStore store_{database_};
};

TEST_F(Profiles, ComeBackWhole) {
    StoredProfile want = profile("scanned");
    want.calibration = {-1.25, 1.0 / 3};
    expect(store_.put(want));
    const StoredProfile found = expect(store_.get("scanned"));
    EXPECT_EQ(found.name, want.name);
    EXPECT_EQ(found.color_space, want.color_space);
    EXPECT_EQ(found.decomposition, want.decomposition);
    EXPECT_EQ(found.m, want.m);
    EXPECT_EQ(found.bin_rule, want.bin_rule);
    EXPECT_EQ(found.weights, want.weights);
    EXPECT_EQ(found.calibration, want.calibration);
    EXPECT_EQ(found.updated_at.size(), std::string("2000-01-01T00:00:00.000Z").size());
    // Channels by bins: the order of the integers is part of the format.
    EXPECT_EQ(sql_integer(database_.handle(),
                          "SELECT json_extract(weights, '$[1][4]') FROM profiles"),
              want.weights[1][4]);
}

TEST_F(Profiles, PutReplacesAndEveryRevisionIsNew) {
    expect(store_.put(profile("a")));
    const auto first = expect(store_.get("a")).revision;
    StoredProfile now = profile("a");
    now.m = 20;
    now.calibration = {0, 1};
    expect(store_.put(now));
    EXPECT_EQ(expect(store_.get("a")).m, 20);
    now.calibration.reset();
    expect(store_.put(now));
    EXPECT_FALSE(expect(store_.get("a")).calibration.has_value());
    const auto third = expect(store_.get("a")).revision;
    EXPECT_GT(third, first);
    expect(store_.remove("a"));
    expect(store_.put(profile("a")));
    EXPECT_GT(expect(store_.get("a")).revision, third);
    EXPECT_EQ(expect(store_.list()).size(), 1u);
}

TEST_F(Profiles, AreListedByName) {
    EXPECT_THAT(expect(store_.list()), IsEmpty());
    for (const std::string& name :
         std::vector<std::string>{"scanned", "a-1", "painted", std::string(64, 'z')}) {
        expect(store_.put(profile(name)));
    }
    std::vector<std::string> names;
    for (const StoredProfile& one : expect(store_.list())) names.push_back(one.name);
    EXPECT_THAT(names, ElementsAre("a-1", "painted", "scanned", std::string(64, 'z')));
}

TEST_F(Profiles, AnUnknownNameIsNamed) {
    for (const Error& error :
         {store_.get("none").error(), store_.remove("none").error()}) {
        EXPECT_EQ(error.code, ErrorCode::kNotFound);
        EXPECT_EQ(error.message, "no profile \"none\"");
        EXPECT_EQ(error.param, "name");
    }
}

struct BadProfile {
    const char* reason;
    void (*spoil)(StoredProfile&);
};

class BadProfiles : public Profiles, public testing::WithParamInterface<BadProfile> {};

TEST_P(BadProfiles, AreRefusedByNameAndLeaveTheFormerOne) {
    expect(store_.put(profile("kept")));
    StoredProfile bad = profile("kept");
    bad.m = 1;
    GetParam().spoil(bad);
    const auto refused = store_.put(bad);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
    EXPECT_NE(refused.error().message.find(GetParam().reason), std::string::npos)
        << refused.error().message;
    EXPECT_NE(refused.error().message.find('"' + bad.name + '"'), std::string::npos);
    EXPECT_EQ(expect(store_.list()).size(), 1u);
    EXPECT_EQ(expect(store_.get("kept")).m, 60);
}

INSTANTIATE_TEST_SUITE_P(
    Each,
    BadProfiles,
    testing::Values(
        BadProfile{"name_is_a_word", [](StoredProfile& p) { p.name.clear(); }},
        BadProfile{"name_is_a_word", [](StoredProfile& p) { p.name = "Upper"; }},
        BadProfile{"name_is_a_word", [](StoredProfile& p) { p.name = "a b"; }},
        BadProfile{"name_is_a_word", [](StoredProfile& p) { p.name = "\xc3\xa9"; }},
        BadProfile{"name_is_a_word", [](StoredProfile& p) { p.name.assign(65, 'a'); }},
        BadProfile{"m_is_a_count", [](StoredProfile& p) { p.m = 0; }},
        BadProfile{"color_space_is_a_word",
                   [](StoredProfile& p) { p.color_space.clear(); }},
        BadProfile{"decomposition_is_a_word",
                   [](StoredProfile& p) { p.decomposition.assign(65, 'x'); }},
        BadProfile{"bin_rule_is_a_word", [](StoredProfile& p) { p.bin_rule.clear(); }},
        BadProfile{"calibration_is_finite",
                   [](StoredProfile& p) {
                       p.calibration = {kInfinity, 1};
                   }},
        BadProfile{"calibration_is_finite",
                   [](StoredProfile& p) {
                       p.calibration = {0, -kInfinity};
                   }},
        BadProfile{"not finite", [](StoredProfile& p) {
                       p.calibration = {std::numeric_limits<double>::quiet_NaN(), 1};
                   }}));

TEST_F(Profiles, TheTableTakesNoWeightsOfAnotherShape) {
    expect(store_.put(profile("a")));
    for (const std::string weights : {"",
                                      "[",
                                      "{}",
                                      "[[1,2,3,4,5,6]]",
                                      "[1,2,3]",
                                      "[[1,2,3,4,5,6],[1,2,3,4,5,6],[1,2,3,4,5]]"}) {
        EXPECT_THROW(run_sql(database_.handle(),
                             "UPDATE profiles SET weights = '" + weights + '\''),
                     std::runtime_error)
            << weights;
    }
    EXPECT_THROW(run_sql(database_.handle(), "UPDATE profiles SET scale = 1"),
                 std::runtime_error);
}

TEST_F(Profiles, WeightsThatAreNoIntegersAreAnErrorThatShowsThem) {
    expect(store_.put(profile("a")));
    for (const std::string last : {"1.5", "true", "\"6\"", "2147483648", "[6]", "null"}) {
        const std::string weights =
            "[[1,2,3,4,5,6],[1,2,3,4,5,6],[1,2,3,4,5," + last + "]]";
        run_sql(database_.handle(), "UPDATE profiles SET weights = '" + weights + '\'');
        for (const Error& error : {store_.get("a").error(), store_.list().error()}) {
            EXPECT_EQ(error.code, ErrorCode::kIo);
            EXPECT_NE(error.message.find(weights), std::string::npos) << error.message;
            EXPECT_NE(error.message.find("\"a\""), std::string::npos);
        }
    }
    // White space is the writer's choice.
    run_sql(database_.handle(),
            "UPDATE profiles SET weights ="
            " ' [ [1, 2,3,4,5,6] ,[1,2,3,4,5,6],\n[1,2,3,4,5,-6 ] ]\t'");
    EXPECT_EQ(expect(store_.get("a")).weights[2][5], -6);
}

}  // namespace
}  // namespace haarmony::schema
