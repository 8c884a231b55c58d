// What the operations on curves answer; what they refuse is in curves_refusal_test.cc.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "server/api/curves.h"
#include "tests/server/api/drawn_curves.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

constexpr double kClose = 1e-8;  // of numbers below 1000

class CurvesTest : public testing::Test {
  protected:
    json ask(const std::string& operation, const json& body) {
        return answer(interface_, "/curve/" + operation, body);
    }
    // Points of a curve.
    json at(const json& curve, const json& u) {
        json body{{"points", curve["points"]}, {"u", u}};
        if (curve.contains("closed")) body["closed"] = curve["closed"];
        return ask("evaluate", body)["points"];
    }

    Interface interface_;
    json curve_{{"points", random_points(35, 3, 1)}};  // level 5
};

TEST_F(CurvesTest, DecomposedInAnyFrameIsReconstructed) {
    for (const bool closed : {false, true}) {
        const json curve{{"points", random_points(closed ? 32 : 35, 3, 2)},
                         {"closed", closed}};
        for (const char* frame : {"fixed", "normalized", "unnormalized"}) {
            const json apart = ask("decompose", with(curve, {{"frame", frame}}));
            EXPECT_EQ(apart["level"], 5);
            EXPECT_EQ(apart["coarse"].size(), closed ? 1u : 4u);
            ASSERT_EQ(apart["details"].size(), 5u);
            for (std::size_t k = 0; k < 5; ++k)
                EXPECT_EQ(apart["details"][k].size(), std::size_t{1} << k);
            const json whole = ask("reconstruct",
                                   {{"coarse", apart["coarse"]},
                                    {"details", apart["details"]},
                                    {"closed", closed},
                                    {"frame", frame}});
            EXPECT_EQ(whole["level"], 5);
            EXPECT_EQ(whole.contains("closed"), closed);
            EXPECT_LT(difference(whole["points"], curve["points"]), kClose) << frame;
        }
    }
}

TEST_F(CurvesTest, FrameDefaultsToFixed) {
    const json plain = ask("decompose", curve_);
    EXPECT_EQ(plain, ask("decompose", with(curve_, {{"frame", "fixed"}})));
    EXPECT_NE(plain, ask("decompose", with(curve_, {{"frame", "normalized"}})));
}

TEST_F(CurvesTest, ReconstructedToALevelIsSmoothedToIt) {
    const json apart = ask("decompose", curve_);
    for (const double level : {0.0, 2.0, 3.25, 5.0}) {
        const json smooth = ask("smooth", with(curve_, {{"level", level}}));
        const json part = ask("reconstruct",
                              {{"coarse", apart["coarse"]},
                               {"details", apart["details"]},
                               {"level", level}});
        EXPECT_EQ(smooth["level"], std::ceil(level));
        EXPECT_EQ(part["level"], smooth["level"]);
        EXPECT_EQ(smooth["points"].size(), (std::size_t{1} << int(std::ceil(level))) + 3);
        EXPECT_LT(difference(part["points"], smooth["points"]), kClose) << level;
    }
}

TEST_F(CurvesTest, SmoothedBetweenTwoLevelsLiesBetweenThem) {
    const json u{0.0, 0.21, 0.5, 0.77, 1.0};
    const auto points = [&](double level) {
        return ask("evaluate", with(curve_, {{"level", level}, {"u", u}}))["points"];
    };
    const json low = points(2);
    const json high = points(3);
    json between = low;
    for (std::size_t i = 0; i < low.size(); ++i)
        for (std::size_t k = 0; k < low[i].size(); ++k)
            between[i][k] =
                0.75 * low[i][k].get<double>() + 0.25 * high[i][k].get<double>();
    EXPECT_LT(difference(points(2.25), between), kClose);
    const json smooth = ask("smooth", with(curve_, {{"level", 2.25}}));
    EXPECT_LT(difference(at(smooth, u), between), kClose);
}

TEST_F(CurvesTest, PinnedEndsStay) {
    const json free = ask("smooth", with(curve_, {{"level", 1}}))["points"];
    const json pinned =
        ask("smooth", with(curve_, {{"level", 1}, {"pin_ends", true}}))["points"];
    EXPECT_LT(difference(pinned.front(), curve_["points"].front()), kClose);
    EXPECT_LT(difference(pinned.back(), curve_["points"].back()), kClose);
    EXPECT_GT(difference(free.front(), curve_["points"].front()), 1);
}

TEST_F(CurvesTest, AControlPointMovesByDelta) {
    const json edit{{"level", 2}, {"control", {{"index", 3}, {"delta", {10, -20, 5}}}}};
    const json edited = ask("edit", with(curve_, edit));
    EXPECT_EQ(edited["level"], 5);
    EXPECT_EQ(edited["edit_level"], 2);
    EXPECT_LT(difference(edited["moved"], {10, -20, 5}), kClose);
    const json before = ask("smooth", with(curve_, {{"level", 2}}))["points"];
    const json after =
        ask("smooth", {{"points", edited["points"]}, {"level", 2}})["points"];
    for (std::size_t i = 0; i < before.size(); ++i) {
        const double expected = i == 3 ? 20 : 0;
        EXPECT_NEAR(difference(before[i], after[i]), expected, kClose) << i;
    }
}

TEST_F(CurvesTest, NothingMovesOutsideOfWhatIsAffected) {
    const json edit{{"level", 4}, {"control", {{"index", 6}, {"delta", {50, 0, 0}}}}};
    const json edited = ask("edit", with(curve_, edit));
    const double from = edited["affected"][0];
    const double to = edited["affected"][1];
    ASSERT_LT(0, from);
    ASSERT_LT(from, to);
    ASSERT_LT(to, 1);
    for (const double u : {0.0, from / 2, from, to, (1 + to) / 2, 1.0})
        EXPECT_LT(difference(at(edited, {u}), at(curve_, {u})), 1e-6) << u;
    EXPECT_GT(difference(at(edited, {(from + to) / 2}), at(curve_, {(from + to) / 2})),
              1);
}

TEST_F(CurvesTest, ADraggedPointMovesByDelta) {
    const json delta{30, 40, 0};
    for (const char* drag : {"smooth", "full"}) {
        const json edited = ask("edit",
                                with(curve_,
                                     {{"level", 2.5},
                                      {"drag", drag},
                                      {"point", {{"u", 0.4}, {"delta", delta}}}}));
        const bool full = std::string(drag) == "full";
        const auto dragged = [&](const json& curve) {
            return full ? at(curve, {0.4})
                        : ask("evaluate",
                              {{"points", curve["points"]},
                               {"level", 2.5},
                               {"u", {0.4}}})["points"];
        };
        json wanted = dragged(curve_);
        for (std::size_t k = 0; k < 3; ++k)
            wanted[0][k] = wanted[0][k].get<double>() + delta[k].get<double>();
        EXPECT_LT(difference(dragged(edited), wanted), kClose) << drag;
        json moved = at(curve_, {0.4})[0];
        for (std::size_t k = 0; k < 3; ++k)
            moved[k] = moved[k].get<double>() + edited["moved"][k].get<double>();
        EXPECT_LT(difference(at(edited, {0.4})[0], moved), kClose) << drag;
    }
}

TEST_F(CurvesTest, NearIsOfTheCurveThatIsDragged) {
    const json arch{
        {"points", {{0, 0}, {0, 40}, {30, 90}, {60, 90}, {90, 90}, {120, 40}, {120, 0}}}};
    const json whole = at(arch, {0.25})[0];
    const json smooth =
        ask("evaluate", with(arch, {{"level", 1}, {"u", {0.75}}}))["points"][0];
    const auto pulled = [&](const json& point, const char* drag) {
        return ask(
            "edit",
            with(arch, {{"level", 1}, {"drag", drag}, {"point", point}}))["points"];
    };
    const json delta{3, 4};
    EXPECT_LT(difference(pulled({{"near", whole}, {"delta", delta}}, "full"),
                         pulled({{"u", 0.25}, {"delta", delta}}, "full")),
              1e-6);
    EXPECT_LT(difference(pulled({{"near", smooth}, {"delta", delta}}, "smooth"),
                         pulled({{"u", 0.75}, {"delta", delta}}, "smooth")),
              1e-6);
}

TEST_F(CurvesTest, APortionFindsTheLevel) {
    const json point{{"u", 0.5}, {"delta", {1, 1, 0}}};
    const double length = ask("evaluate", with(curve_, {{"u", {0}}}))["length"];
    const auto level = [&](const json& portion) {
        return ask("edit", with(with(curve_, portion), {{"point", point}}))["edit_level"]
            .get<double>();
    };
    EXPECT_EQ(level({{"portion", 2 * length}}), 0);
    EXPECT_EQ(level({{"portion", 1e-9}}), 5);
    const double half = level({{"portion", length / 2}});
    EXPECT_GT(half, 0);
    EXPECT_LT(half, 5);
    EXPECT_NEAR(level({{"portion", 0.5}, {"portion_unit", "fraction"}}), half, 1e-3);
    EXPECT_GT(level({{"portion", length / 8}}), half);
    const json edited = ask("edit",
                            with(curve_,
                                 {{"portion", 0.25},
                                  {"portion_unit", "fraction"},
                                  {"control", {{"index", 4}, {"delta", {1, 1, 0}}}}}));
    EXPECT_GT(edited["edit_level"], 0);
}

TEST_F(CurvesTest, ACurveWithoutLengthIsEditedAtLevelZero) {
    const json dot{{"points", {{5, 5}, {5, 5}, {5, 5}, {5, 5}, {5, 5}}}};
    const json edited = ask("edit",
                            with(dot,
                                 {{"portion", 0.5},
                                  {"portion_unit", "fraction"},
                                  {"point", {{"u", 0.5}, {"delta", {1, 0}}}}}));
    EXPECT_EQ(edited["edit_level"], 0);
    EXPECT_LT(difference(at(edited, {0.5}), {{6, 5}}), kClose);
}

TEST_F(CurvesTest, CharacterIsTheDetailsOfTheOther) {
    const json other{{"points", random_points(67, 3, 5)}};
    for (const char* frame : {"fixed", "normalized", "unnormalized"}) {
        const json apart = ask("decompose", with(other, {{"frame", frame}}));
        const json given = ask(
            "character",
            with(curve_, {{"character", other}, {"from_level", 2}, {"frame", frame}}));
        EXPECT_EQ(given["level"], 6);
        const json result =
            ask("decompose", {{"points", given["points"]}, {"frame", frame}});
        const json sweep = ask("decompose", with(curve_, {{"frame", frame}}));
        EXPECT_LT(difference(result["coarse"], sweep["coarse"]), 1e-7) << frame;
        for (std::size_t k = 0; k < 6; ++k)
            EXPECT_LT(
                difference(result["details"][k], (k < 2 ? sweep : apart)["details"][k]),
                1e-6)
                << frame << k;
        // The same from coarse and details.
        const json parts{{"coarse", apart["coarse"]}, {"details", apart["details"]}};
        EXPECT_EQ(ask("character",
                      with(curve_,
                           {{"character", parts}, {"from_level", 2}, {"frame", frame}})),
                  given);
    }
}

TEST_F(CurvesTest, StrengthZeroIsTheSweepAlone) {
    const json other{{"points", random_points(35, 3, 6)}};
    const json bare =
        ask("character",
            with(curve_, {{"character", other}, {"from_level", 3}, {"strength", 0}}));
    const json u{0.1, 0.6};
    EXPECT_LT(
        difference(at(bare, u),
                   ask("evaluate", with(curve_, {{"level", 3}, {"u", u}}))["points"]),
        kClose);
}

TEST_F(CurvesTest, AStrokeIsFittedWithinItsTolerance) {
    json samples = json::array();
    for (int i = 0; i <= 300; ++i) {
        const double t = i / 300.0;
        samples.push_back({600 * t, 100 * std::sin(12 * t), 1 + t});
    }
    const json loose = ask("fit", {{"samples", samples}, {"tolerance", 20}});
    const json tight = ask("fit", {{"samples", samples}, {"tolerance", 0.5}});
    EXPECT_LE(loose["fit"]["max_error"], 20);
    EXPECT_LE(tight["fit"]["max_error"], 0.5);
    EXPECT_LT(loose["level"], tight["level"]);
    EXPECT_EQ(tight["fit"]["level"], tight["level"]);
    EXPECT_LE(tight["fit"]["rms_error"], tight["fit"]["max_error"]);
    EXPECT_EQ(ask("fit", {{"samples", samples}, {"level", 3}})["points"].size(), 11u);
    EXPECT_EQ(
        ask("fit",
            {{"samples", samples}, {"level", 3.0}, {"spacing", "centripetal"}})["level"],
        3);
    // Every operation takes a stroke, and says how it fitted it.
    const json smooth = ask("smooth", {{"samples", samples}, {"level", 1}});
    EXPECT_EQ(smooth["points"].size(), 5u);
    const double extent = std::hypot(600, 200);
    EXPECT_LE(smooth["fit"]["max_error"].get<double>(), 1e-3 * extent);
    EXPECT_FALSE(ask("smooth", with(curve_, {{"level", 1}})).contains("fit"));
}

TEST_F(CurvesTest, PointsOfNoLevelAreSamples) {
    const json fitted =
        ask("decompose", {{"points", random_points(34, 2, 7)}, {"fit_tolerance", 400}});
    EXPECT_LE(fitted["fit"]["max_error"], 400);
    EXPECT_EQ(fitted["fit"]["level"], fitted["level"]);
}

TEST_F(CurvesTest, APathIsFitted) {
    const json circle{{"d", "M10 60a50 50 0 1 1 100 0 50 50 0 1 1-100 0zM0 0L5 5"}};
    const json fitted = ask("fit", with(circle, {{"tolerance", 0.1}}));
    EXPECT_TRUE(fitted["closed"]);
    for (const auto& point : at(fitted, {0.0, 0.2, 0.45, 0.7}))
        EXPECT_NEAR(std::hypot(point[0].get<double>() - 60, point[1].get<double>() - 60),
                    50,
                    0.15);
    const json line = ask("fit", with(circle, {{"subpath", 1}}));
    EXPECT_EQ(line["level"], 0);
    EXPECT_LT(difference(at(line, {0, 1}), {{0, 0}, {5, 5}}), 1e-6);
    const json cut = ask("fit", with(circle, {{"closed", false}, {"tolerance", 0.1}}));
    EXPECT_FALSE(cut.contains("closed"));
    EXPECT_LT(difference(at(cut, {0, 1}), {{10, 60}, {10, 60}}), 0.2);
}

TEST_F(CurvesTest, EvaluationIsOfACircleWhatItIs) {
    json samples = json::array();
    for (int i = 0; i < 400; ++i) {
        const double angle = 2 * std::numbers::pi * i / 400;
        samples.push_back({100 * std::cos(angle), 100 * std::sin(angle)});
    }
    const json found = ask(
        "evaluate",
        {{"samples", samples}, {"closed", true}, {"fit_tolerance", 1e-3}, {"count", 16}});
    ASSERT_EQ(found["points"].size(), 16u);
    EXPECT_NEAR(found["length"], 200 * std::numbers::pi, 0.01);
    for (std::size_t i = 0; i < 16; ++i) {
        EXPECT_DOUBLE_EQ(found["u"][i], double(i) / 16);
        const double x = found["points"][i][0];
        const double y = found["points"][i][1];
        EXPECT_NEAR(std::hypot(x, y), 100, 0.01);
        EXPECT_NEAR(found["curvature"][i], 0.01, 1e-3);
        // To the left of a circle that turns left is its middle.
        EXPECT_NEAR(found["normals"][i][0], -x / 100, 1e-3);
        EXPECT_NEAR(found["normals"][i][1], -y / 100, 1e-3);
        EXPECT_NEAR(std::hypot(found["tangents"][i][0].get<double>(),
                               found["tangents"][i][1].get<double>()),
                    200 * std::numbers::pi,
                    5);
    }
}

TEST_F(CurvesTest, WhereACurveStandsStillThereIsNoCurvature) {
    const json dot{{"points", {{1, 2}, {1, 2}, {1, 2}, {1, 2}}}};
    const json found = ask("evaluate", with(dot, {{"count", 2}}));
    EXPECT_EQ(found["u"], (json{0, 1}));
    EXPECT_EQ(found["curvature"], (json{nullptr, nullptr}));
    EXPECT_EQ(found["normals"][0], (json{0, 1}));
    EXPECT_EQ(found["length"], 0);
    // It sets out along the second derivative.
    const json late{{"points", {{0, 0}, {0, 0}, {0, 9}, {5, 9}}}, {"u", {0}}};
    EXPECT_LT(difference(ask("evaluate", late)["normals"][0], {-1, 0}), kClose);
}

TEST_F(CurvesTest, OneNumberAPointIsACurveToo) {
    const json curve{{"points", random_points(11, 1, 9)}};
    EXPECT_EQ(ask("smooth", with(curve, {{"level", 1.5}}))["points"].size(), 7u);
    EXPECT_EQ(ask("evaluate", with(curve, {{"u", {0.5}}}))["tangents"][0].size(), 1u);
    EXPECT_EQ(ask("decompose", with(curve, {{"frame", "normalized"}}))["level"], 3);
    EXPECT_LE(
        ask("approximate", with(curve, {{"tolerance", 50}, {"mode", "c0"}}))["bound"],
        50);
}

TEST_F(CurvesTest, ApproximationKeepsItsPromise) {
    for (const char* mode : {"dyadic", "c0", "g1"}) {
        const json found =
            ask("approximate", with(curve_, {{"tolerance", 40}, {"mode", mode}}));
        EXPECT_EQ(found["possible"], 32);
        EXPECT_EQ(found["segments"].size(), found["count"]);
        EXPECT_EQ(found["segments"][0].size(), 4u);
        EXPECT_LE(found["max_error"], found["bound"]);
        EXPECT_LE(found["bound"], 40);
    }
    const json g1 = ask("approximate", with(curve_, {{"tolerance", 40}}));
    EXPECT_EQ(g1["mode"], "g1");
}

TEST_F(CurvesTest, ApproximationComesInOtherFormats) {
    const auto document = [&](const char* format) {
        return interface_.post_json(
            "/curve/approximate", with(curve_, {{"tolerance", 20}, {"format", format}}));
    };
    const http::Response svg = document("svg");
    EXPECT_EQ(header_of(svg, "Content-Type"), "image/svg+xml");
    EXPECT_NE(body_of(svg).find("<path"), std::string::npos);
    const http::Response postscript = document("postscript");
    EXPECT_EQ(header_of(postscript, "Content-Type"), "application/postscript");
    EXPECT_TRUE(body_of(postscript).starts_with("%!PS"));
    const http::Response geojson = document("geojson");
    EXPECT_EQ(header_of(geojson, "Content-Type"), "application/geo+json");
    EXPECT_EQ(json_of(geojson)["type"], "Feature");
    EXPECT_LE(json_of(geojson)["properties"]["bound"], 20);
}

TEST_F(CurvesTest, LongBodiesAreCostly) {
    http::Request request;
    EXPECT_EQ(cost_of_curve(request), http::Cost::kCheap);
    request.body.assign(1'000'000, ' ');
    EXPECT_EQ(cost_of_curve(request), http::Cost::kCostly);
}

}  // namespace
}  // namespace haarmony::server
