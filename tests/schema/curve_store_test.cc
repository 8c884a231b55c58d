#include "schema/curve_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/schema/pictures.h"
#include "tests/schema/raw_sql.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::schema {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Curves : public testing::Test {
  protected:
    [[nodiscard]] static StoredCurve curve(const std::string& name) {
        StoredCurve made;
        made.name = name;
        made.dimension = 2;
        made.numbers = {1, -0.0, 1.0 / 3, std::numeric_limits<double>::denorm_min()};
        return made;
    }

    // Behind the back of the constraints.
    void spoil(const std::string& assignment) {
        run_sql(database_.handle(),
                "PRAGMA ignore_check_constraints = 1; UPDATE curves SET " + assignment +
                    "; PRAGMA ignore_check_constraints = 0");
    }

    ScratchFolder folder_;
    Database database_ = open_database(folder_.file("x.db"));
    CurveStore store_{database_};
};

TEST_F(Curves, ComeBackBitForBit) {
    StoredCurve want = curve("waves");
    want.closed = true;
    expect(store_.put(CurveKind::kCharacter, want));
    const StoredCurve found = expect(store_.get(CurveKind::kCharacter, "waves"));
    EXPECT_EQ(found.name, "waves");
    EXPECT_TRUE(found.closed);
    EXPECT_EQ(found.dimension, 2);
    EXPECT_EQ(found.numbers, want.numbers);
    EXPECT_TRUE(std::signbit(found.numbers[1]));
    EXPECT_EQ(found.updated_at.size(), std::string("2000-01-01T00:00:00.000Z").size());
    // The order of the bytes is part of the format.
    EXPECT_EQ(sql_text(database_.handle(), "SELECT hex(numbers) FROM curves"),
              "000000000000F03F000000000000008055555555555"
              "5D53F0100000000000000");
}

TEST_F(Curves, OfTwoKindsMayHaveOneName) {
    expect(store_.put(CurveKind::kCharacter, curve("a")));
    StoredCurve stroke = curve("a");
    stroke.numbers = {7, 8};
    expect(store_.put(CurveKind::kStroke, stroke));
    EXPECT_EQ(expect(store_.get(CurveKind::kCharacter, "a")).numbers.size(), 4u);
    EXPECT_EQ(expect(store_.get(CurveKind::kStroke, "a")).numbers.size(), 2u);
    expect(store_.remove(CurveKind::kStroke, "a"));
    EXPECT_EQ(expect(store_.list(CurveKind::kCharacter)).size(), 1u);
    EXPECT_THAT(expect(store_.list(CurveKind::kStroke)), IsEmpty());
}

TEST_F(Curves, PutReplacesAndEveryRevisionIsNew) {
    expect(store_.put(CurveKind::kStroke, curve("a")));
    const auto first = expect(store_.get(CurveKind::kStroke, "a")).revision;
    StoredCurve now = curve("a");
    now.dimension = 1;
    now.numbers = {5};
    expect(store_.put(CurveKind::kStroke, now));
    const StoredCurve second = expect(store_.get(CurveKind::kStroke, "a"));
    EXPECT_EQ(second.numbers, std::vector<double>{5});
    EXPECT_GT(second.revision, first);
    expect(store_.remove(CurveKind::kStroke, "a"));
    expect(store_.put(CurveKind::kStroke, curve("a")));
    EXPECT_GT(expect(store_.get(CurveKind::kStroke, "a")).revision, second.revision);
}

TEST_F(Curves, AreListedByName) {
    for (const std::string& name : std::vector<std::string>{"b", "a-1", "c_"})
        expect(store_.put(CurveKind::kCharacter, curve(name)));
    std::vector<std::string> names;
    for (const StoredCurve& one : expect(store_.list(CurveKind::kCharacter)))
        names.push_back(one.name);
    EXPECT_THAT(names, ElementsAre("a-1", "b", "c_"));
}

TEST_F(Curves, ArePagedByName) {
    for (const std::string& name : std::vector<std::string>{"b", "a-1", "c_", "a"})
        expect(store_.put(CurveKind::kStroke, curve(name)));
    StoredCurve other = curve("aa");
    other.closed = true;
    other.dimension = 4;
    expect(store_.put(CurveKind::kCharacter, other));
    const auto names = [&](std::string_view after, int limit) {
        std::vector<std::string> found;
        for (const ListedCurve& one :
             expect(store_.page(CurveKind::kStroke, after, limit)))
            found.push_back(one.name);
        return found;
    };
    EXPECT_THAT(names("", 3), ElementsAre("a", "a-1", "b"));
    EXPECT_THAT(names("b", 3), ElementsAre("c_"));
    EXPECT_THAT(names("aa", 1), ElementsAre("b"));
    EXPECT_THAT(names("c_", 1), IsEmpty());
    EXPECT_THAT(names("", 0), IsEmpty());
    const ListedCurve found = expect(store_.page(CurveKind::kCharacter, "", 9)).front();
    EXPECT_EQ(found.name, "aa");
    EXPECT_TRUE(found.closed);
    EXPECT_EQ(found.dimension, 4);
    EXPECT_EQ(found.count, 1);
    EXPECT_EQ(found.updated_at,
              expect(store_.get(CurveKind::kCharacter, "aa")).updated_at);
}

TEST_F(Curves, VersionChangesWithEveryPutAndRemoveOfTheKind) {
    std::vector<CurvesVersion> versions;
    const auto note = [&] {
        versions.push_back(expect(store_.version(CurveKind::kStroke)));
    };
    note();
    expect(store_.put(CurveKind::kStroke, curve("a")));
    note();
    expect(store_.put(CurveKind::kStroke, curve("a")));
    note();
    expect(store_.put(CurveKind::kStroke, curve("b")));
    note();
    expect(store_.remove(CurveKind::kStroke, "a"));
    note();
    for (std::size_t i = 0; i < versions.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) EXPECT_NE(versions[i], versions[k]);
    expect(store_.put(CurveKind::kCharacter, curve("a")));
    EXPECT_EQ(expect(store_.version(CurveKind::kStroke)), versions.back());
}

TEST_F(Curves, AnUnknownNameIsNamed) {
    for (const Error& error : {store_.get(CurveKind::kStroke, "none").error(),
                               store_.remove(CurveKind::kStroke, "none").error()}) {
        EXPECT_EQ(error.code, ErrorCode::kNotFound);
        EXPECT_EQ(error.message, "no stroke \"none\"");
        EXPECT_EQ(error.param, "name");
    }
}

struct BadCurve {
    const char* reason;
    void (*spoil)(StoredCurve&);
};

class BadCurves : public Curves, public testing::WithParamInterface<BadCurve> {};

TEST_P(BadCurves, AreRefusedByNameAndLeaveTheFormerOne) {
    expect(store_.put(CurveKind::kCharacter, curve("kept")));
    StoredCurve bad = curve("kept");
    bad.numbers = {9, 9};
    GetParam().spoil(bad);
    const auto refused = store_.put(CurveKind::kCharacter, bad);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
    EXPECT_THAT(refused.error().message, HasSubstr(GetParam().reason));
    EXPECT_THAT(refused.error().message, HasSubstr('"' + bad.name + '"'));
    EXPECT_EQ(expect(store_.get(CurveKind::kCharacter, "kept")).numbers.size(), 4u);
}

INSTANTIATE_TEST_SUITE_P(
    Each,
    BadCurves,
    testing::Values(
        BadCurve{"name_is_a_word", [](StoredCurve& curve) { curve.name = "Kept"; }},
        BadCurve{"dimension_is_a_count", [](StoredCurve& curve) { curve.dimension = 9; }},
        BadCurve{"numbers_are_rows", [](StoredCurve& curve) { curve.numbers.clear(); }},
        BadCurve{"numbers_are_rows",
                 [](StoredCurve& curve) { curve.numbers.push_back(1); }}));

TEST_F(Curves, ADamagedRowIsAnErrorThatNamesIt) {
    for (const char* damage :
         {"numbers = x'00'", "numbers = x''", "dimension = 0", "dimension = 9"}) {
        expect(store_.put(CurveKind::kStroke, curve("bad")));
        spoil(damage);
        for (const Error& error : {store_.get(CurveKind::kStroke, "bad").error(),
                                   store_.page(CurveKind::kStroke, "", 1).error(),
                                   store_.list(CurveKind::kStroke).error()}) {
            EXPECT_EQ(error.code, ErrorCode::kIo) << damage;
            EXPECT_THAT(error.message, HasSubstr("stroke \"bad\"")) << damage;
        }
    }
}

TEST_F(Curves, ALostTableIsAnErrorOfEveryMember) {
    run_sql(database_.handle(), "DROP TABLE curves");
    EXPECT_EQ(store_.put(CurveKind::kStroke, curve("a")).error().code, ErrorCode::kIo);
    EXPECT_EQ(store_.get(CurveKind::kStroke, "a").error().code, ErrorCode::kIo);
    EXPECT_EQ(store_.list(CurveKind::kStroke).error().code, ErrorCode::kIo);
    EXPECT_EQ(store_.page(CurveKind::kStroke, "", 1).error().code, ErrorCode::kIo);
    EXPECT_EQ(store_.remove(CurveKind::kStroke, "a").error().code, ErrorCode::kIo);
    EXPECT_EQ(store_.version(CurveKind::kStroke).error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace haarmony::schema
