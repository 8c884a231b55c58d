// Curves with corners: every operation keeps them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/server/api/drawn_curves.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

constexpr double kTolerance = 0.5;

// Up a hill and down again, to a tip in the middle.
json tip(int steps) {
    json samples = json::array();
    for (int i = 0; i <= steps; ++i) {
        const double t = 2.0 * i / steps - 1;
        samples.push_back({100 * t, 100 * (1 - std::abs(t)) + 5 * std::cos(9 * t) - 5});
    }
    return samples;
}

class CorneredCurvesTest : public testing::Test {
  protected:
    json ask(const std::string& operation, const json& body) {
        return answer(interface_, "/curve/" + operation, body);
    }
    // The largest distance from the tip's own place.
    static double tip_of(const json& pieces) {
        const json& end = pieces[0]["points"].back();
        EXPECT_EQ(end, pieces[1]["points"].front());
        return difference(end, {0, 100});
    }

    Interface interface_;
    json stroke_{{"samples", tip(200)},
                 {"corners", {0.5}},
                 {"fit_tolerance", kTolerance}};
    json curve_{{"points", random_points(19, 2, 1)}, {"corners", {0.5}}};
};

TEST_F(CorneredCurvesTest, AStrokeIsFittedInPieces) {
    const json declared = ask(
        "fit", {{"samples", tip(200)}, {"corners", {0.5}}, {"tolerance", kTolerance}});
    ASSERT_EQ(declared["pieces"].size(), 2u);
    EXPECT_LT(tip_of(declared["pieces"]), 1e-9);
    EXPECT_LE(declared["fit"]["max_error"], kTolerance);
    EXPECT_LE(declared["rounding_error"], kTolerance);
    EXPECT_EQ(declared["pieces"][0]["from"], 0);
    EXPECT_EQ(declared["pieces"][1]["to"], 1);
    const json detected = ask(
        "fit", {{"samples", tip(200)}, {"corners", "detect"}, {"tolerance", kTolerance}});
    ASSERT_EQ(detected["corners"].size(), 1u);
    EXPECT_LT(tip_of(detected["pieces"]), 3);
    const json level =
        ask("fit", {{"samples", tip(200)}, {"corners", {0.5}}, {"level", 3}});
    for (const json& piece : level["pieces"]) EXPECT_EQ(piece["level"], 3);
}

TEST_F(CorneredCurvesTest, SmoothingLeavesTheTip) {
    const json smooth = ask("smooth", with(stroke_, {{"level", 0}}));
    EXPECT_LT(tip_of(smooth["pieces"]), 1e-9);
    for (const json& piece : smooth["pieces"]) EXPECT_EQ(piece["points"].size(), 4u);
    const json u{0.5};
    const json at =
        ask("evaluate", with(stroke_, {{"level", 0}, {"u", smooth["corners"]}}));
    EXPECT_LT(difference(at["points"], {{0, 100}}), 1e-9);
}

TEST_F(CorneredCurvesTest, AControlCurveIsSplitWhereItIs) {
    const json apart = ask("decompose", curve_);
    EXPECT_FALSE(apart.contains("fit"));
    ASSERT_EQ(apart["pieces"].size(), 2u);
    EXPECT_EQ(apart["pieces"][0]["level"], 3);
    const json u{0.0, 0.3, 0.5, 0.8, 1.0};
    json plain = curve_;
    plain.erase("corners");
    const json whole = ask("evaluate", with(plain, {{"u", u}}));
    const json pieces = ask("evaluate", with(curve_, {{"u", u}}));
    for (const char* member : {"points", "tangents", "normals"})
        EXPECT_LT(difference(whole[member], pieces[member]), 1e-6) << member;
    EXPECT_LT(difference(whole["curvature"], pieces["curvature"]), 1e-8);
    EXPECT_NEAR(whole["length"], pieces["length"], 1e-2);
    // The ends are corners without being named.
    EXPECT_EQ(ask("decompose", with(curve_, {{"corners", {0, 0.5, 1}}})), apart);
}

TEST_F(CorneredCurvesTest, APieceIsEditedAndItsNeighbourFollowsAtTheirCorner) {
    const json corner = ask("fit", stroke_)["corners"][0];
    const json edit{{"level", 1}, {"point", {{"u", corner}, {"delta", {0, 30}}}}};
    const json edited = ask("edit", with(stroke_, edit));
    const json before = ask("fit", stroke_);
    const json& tip = edited["pieces"][1]["points"].front();
    EXPECT_EQ(edited["pieces"][0]["points"].back(), tip);
    EXPECT_NEAR(tip[1], 130, 1e-6);
    EXPECT_LT(edited["affected"][0], 0.5);
    EXPECT_GT(edited["affected"][1], 0.5);
    // Inside of a piece the other one stays.
    const json inside =
        ask("edit",
            with(stroke_,
                 {{"level", 2}, {"point", {{"near", {-50, 50}}, {"delta", {5, 5}}}}}));
    EXPECT_LE(inside["affected"][0], 0.25);
    EXPECT_EQ(inside["pieces"][1]["points"].back(), before["pieces"][1]["points"].back());
}

TEST_F(CorneredCurvesTest, AnIndexCountsThroughThePieces) {
    const json before = ask("smooth", with(curve_, {{"level", 3}}));
    const json edited =
        ask("edit",
            with(curve_,
                 {{"level", 3}, {"control", {{"index", 11 + 4}, {"delta", {7, 0}}}}}));
    EXPECT_LT(difference(edited["pieces"][0]["points"], before["pieces"][0]["points"]),
              1e-9);
    json expected = before["pieces"][1]["points"];
    expected[4][0] = expected[4][0].get<double>() + 7;
    EXPECT_LT(difference(edited["pieces"][1]["points"], expected), 1e-9);
    EXPECT_GT(edited["affected"][0], 0.5);
    const json portion = ask("edit",
                             with(curve_,
                                  {{"portion", 0.25},
                                   {"portion_unit", "fraction"},
                                   {"control", {{"index", 2}, {"delta", {7, 0}}}}}));
    EXPECT_GT(portion["edit_level"], 0);
    EXPECT_EQ(refusal_of(interface_.post_json(
                  "/curve/edit",
                  with(curve_,
                       {{"level", 3}, {"control", {{"index", 22}, {"delta", {7, 0}}}}}))),
              (Refusal{422, "out_of_range", "control.index"}));
}

TEST_F(CorneredCurvesTest, PiecesTakeACharacter) {
    const json given =
        ask("character",
            with(stroke_, {{"character", {{"points", random_points(35, 2, 4)}}}}));
    ASSERT_EQ(given["pieces"].size(), 2u);
    for (const json& piece : given["pieces"]) EXPECT_EQ(piece["level"], 5);
    EXPECT_EQ(given["pieces"][0]["points"].back(), given["pieces"][1]["points"].front());
}

TEST_F(CorneredCurvesTest, AnApproximationMayTurnAtTheTip) {
    const auto nearest_start = [](const json& segments, const json& place) {
        double least = 1e9;
        for (const json& segment : segments)
            least = std::min(least, difference(segment[0], place));
        return least;
    };
    for (const std::string mode : {"dyadic", "c0", "g1"}) {
        const json wanted{{"tolerance", 2}, {"mode", mode}};
        const json found = ask("approximate", with(stroke_, wanted));
        // In dyadic mode segments need not meet, nor go through any point.
        EXPECT_LT(nearest_start(found["segments"], {0, 100}), mode == "dyadic" ? 2 : 1e-9)
            << mode;
        EXPECT_LE(found["max_error"], found["bound"]) << mode;
        EXPECT_LE(found["bound"], 2) << mode;
        EXPECT_EQ(found["corners"].size(), 1u) << mode;
        json round = stroke_;
        round.erase("corners");
        EXPECT_FALSE(ask("approximate", with(round, wanted)).contains("corners"));

        const json declared = ask("approximate", with(curve_, wanted));
        const json tip = ask("evaluate", with(curve_, {{"u", {0.5}}}))["points"][0];
        EXPECT_LT(nearest_start(declared["segments"], tip), mode == "dyadic" ? 2 : 1e-9)
            << mode;
        EXPECT_EQ(declared["corners"], (json{0.5})) << mode;
        EXPECT_FALSE(declared.contains("fit")) << mode;

        const json detected =
            ask("approximate",
                with(curve_, {{"tolerance", 2}, {"mode", mode}, {"corners", "detect"}}));
        EXPECT_LE(detected["bound"], 2) << mode;
        EXPECT_FALSE(detected["corners"].empty()) << mode;
    }
}

TEST_F(CorneredCurvesTest, AClosedCurveHasACornerAtItsStart) {
    const json closed{
        {"points", random_points(16, 2, 8)}, {"closed", true}, {"corners", {0.25, 1}}};
    const json smooth = ask("smooth", with(closed, {{"level", 1}}));
    EXPECT_EQ(smooth["corners"], (json{0, 0.25}));
    EXPECT_EQ(smooth["closed"], true);
    EXPECT_EQ(smooth["pieces"][1]["points"].back(),
              smooth["pieces"][0]["points"].front());
    const json edited =
        ask("edit",
            with(closed, {{"level", 1}, {"point", {{"u", 0.9}, {"delta", {20, 20}}}}}));
    for (const json& u : edited["affected"]) {
        EXPECT_GE(u, 0);
        EXPECT_LE(u, 1);
    }
}

TEST_F(CorneredCurvesTest, ImpossibleLevelsAndNumbersAreRefused) {
    const auto refusal = [&](const std::string& operation, const json& members) {
        return refusal_of(
            interface_.post_json("/curve/" + operation, with(curve_, members)));
    };
    EXPECT_EQ(refusal("smooth", {{"level", 4.5}}),
              (Refusal{422, "level_out_of_range", "level"}));
    EXPECT_EQ(refusal("evaluate", {{"level", 4.5}, {"count", 2}}),
              (Refusal{422, "level_out_of_range", "level"}));
    EXPECT_EQ(
        refusal("character", {{"from_level", 5}, {"character", {{"d", "M0 0L9 9"}}}}),
        (Refusal{422, "level_out_of_range", "from_level"}));
    EXPECT_EQ(refusal("edit", {{"level", 5}, {"point", {{"u", 0.1}, {"delta", {1, 1}}}}}),
              (Refusal{422, "level_out_of_range", "level"}));
    EXPECT_EQ(refusal("edit", {{"level", 1}, {"point", {{"u", 0.1}, {"delta", {1}}}}}),
              (Refusal{422, "mixed_dimensions", "point.delta"}));
}

}  // namespace
}  // namespace haarmony::server
