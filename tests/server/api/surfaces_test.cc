#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/server/api/drawn_curves.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

constexpr double kClose = 1e-8;  // of numbers below 1000

json random_grid(std::size_t u, std::size_t v, unsigned seed) {
    json grid = json::array();
    for (std::size_t a = 0; a < u; ++a)
        grid.push_back(random_points(v, 3, seed + static_cast<unsigned>(a)));
    return grid;
}

class SurfacesTest : public testing::Test {
  protected:
    json ask(const std::string& operation, const json& body) {
        return answer(interface_, "/surface/" + operation, body);
    }

    Interface interface_;
    json surface_{{"points", random_grid(11, 7, 1)}};  // levels 3 and 2
};

TEST_F(SurfacesTest, DecomposedIsReconstructed) {
    const json apart = ask("decompose", surface_);
    EXPECT_EQ(apart["levels"], (json{3, 2}));
    EXPECT_EQ(apart["coarse"].size(), 5u);
    EXPECT_EQ(apart["coarse"][0].size(), 4u);
    ASSERT_EQ(apart["details"].size(), 2u);
    EXPECT_EQ(apart["details"][1]["cd"].size(), 7u);
    EXPECT_EQ(apart["details"][1]["cd"][0].size(), 2u);
    EXPECT_EQ(apart["details"][1]["dc"].size(), 4u);
    EXPECT_EQ(apart["details"][1]["dc"][0].size(), 5u);
    EXPECT_EQ(apart["details"][1]["dd"].size(), 4u);
    const json whole = ask("reconstruct", apart);
    EXPECT_EQ(whole["levels"], (json{3, 2}));
    EXPECT_LT(difference(whole["points"], surface_["points"]), kClose);
    const json coarse = ask("reconstruct", with(apart, {{"level", {1, 0}}}));
    EXPECT_EQ(coarse["levels"], (json{1, 0}));
    EXPECT_EQ(coarse["points"], apart["coarse"]);
    EXPECT_EQ(ask("reconstruct", with(apart, {{"level", {2, 1}}}))["points"].size(), 7u);
}

TEST_F(SurfacesTest, AControlPointOfTheFinestLevelsMovesAlone) {
    const json edited =
        ask("edit",
            with(surface_,
                 {{"level", {3, 2}},
                  {"control", {{"index", {4, 5}}, {"delta", {1, 2, -3}}}}}));
    EXPECT_EQ(edited["changed"], 1);
    json expected = surface_["points"];
    for (std::size_t k = 0; k < 3; ++k)
        expected[4][5][k] =
            expected[4][5][k].get<double>() + std::vector<double>{1, 2, -3}[k];
    EXPECT_LT(difference(edited["points"], expected), kClose);
}

TEST_F(SurfacesTest, ACoarserEditMovesMoreAndKeepsTheDetails) {
    const json square{{"points", random_grid(7, 7, 5)}};
    const json edited = ask(
        "edit",
        with(
            square,
            {{"level", {1, 1}}, {"control", {{"index", {2, 2}}, {"delta", {0, 0, 9}}}}}));
    EXPECT_GT(edited["changed"], 1);
    const json before = ask("decompose", square);
    const json after = ask("decompose", {{"points", edited["points"]}});
    for (const char* name : {"cd", "dc", "dd"})
        EXPECT_LT(difference(before["details"][1][name], after["details"][1][name]),
                  kClose);
    const json real = ask("edit",
                          with(square,
                               {{"level", {1.5, 0.25}},
                                {"control", {{"index", {2, 2}}, {"delta", {0, 0, 9}}}}}));
    EXPECT_GT(real["changed"], 1);
}

using Wrong = std::pair<std::string, Refusal>;

TEST_F(SurfacesTest, WhatIsNoGridIsRefused) {
    const std::vector<Wrong> wrong{
        {R"({"points":null})", {400, "invalid_argument", "points"}},
        {R"({"points":7})", {400, "invalid_argument", "points"}},
        {R"({"points":[7]})", {400, "invalid_argument", "points[0]"}},
        {R"({"points":[]})", {422, "grid_size", "points"}},
        {R"({"points":[[[1]],[[1]],[[1]],[[1]]]})", {422, "grid_size", "points"}},
        {R"({"points":[[[1],[2]],[[1]]]})", {422, "uneven_grid", "points[1]"}},
        {R"({"points":[[[1]],[[1,2]]]})", {422, "mixed_dimensions", "points[1]"}},
        {R"({"points":[[[1],["x"]]]})", {400, "invalid_argument", "points[0][1][0]"}},
        {R"({"closed":true})", {400, "unknown_parameter", "closed"}}};
    for (const auto& [changes, refusal] : wrong) {
        json request = surface_;
        request.merge_patch(json::parse(changes));
        EXPECT_EQ(refusal_of(interface_.post_json("/surface/decompose", request)),
                  refusal)
            << changes;
    }
}

TEST_F(SurfacesTest, WhatIsNoDecompositionIsRefused) {
    const json apart = ask("decompose", surface_);
    const std::vector<std::pair<json, Refusal>> wrong{
        {{{"coarse", nullptr}}, {400, "invalid_argument", "coarse"}},
        {{{"details", nullptr}}, {400, "invalid_argument", "details"}},
        {{{"coarse", random_grid(5, 5, 1)}}, {422, "grid_size", "coarse"}},
        {{{"coarse", random_grid(5, 6, 1)}}, {422, "grid_size", "coarse"}},
        {{{"details", 3}}, {400, "invalid_argument", "details"}},
        {{{"details", {7}}}, {400, "invalid_argument", "details[0]"}},
        {{{"details", {{{"cd", json::array()}}}}}, {422, "grid_size", "details[0].cd"}},
        {{{"details", {json::object()}}}, {400, "invalid_argument", "details[0].cd"}},
        {{{"details", {{{"xy", 1}}}}}, {400, "unknown_parameter", "details[0].xy"}},
        {{{"details", json(20, json::object())}}, {422, "level_out_of_range", "details"}},
        {{{"levels", {3, 3}}}, {422, "level_out_of_range", "levels"}},
        {{{"levels", {3}}}, {400, "invalid_argument", "levels"}},
        {{{"level", {3, 3}}}, {422, "level_out_of_range", "level"}},
        {{{"level", {0, -1}}}, {422, "level_out_of_range", "level"}},
        {{{"level", {4, 3}}}, {422, "level_out_of_range", "level"}},
        {{{"level", {1.5, 0.5}}}, {422, "level_out_of_range", "level"}},
        {{{"level", 1}}, {400, "invalid_argument", "level"}},
        {{{"points", 1}}, {400, "unknown_parameter", "points"}}};
    for (const auto& [changes, refusal] : wrong) {
        json request = apart;
        request.merge_patch(changes);
        EXPECT_EQ(refusal_of(interface_.post_json("/surface/reconstruct", request)),
                  refusal)
            << changes;
    }
    json flat = apart;
    for (json& point : flat["details"][0]["dd"][0]) point = {1, 2};
    for (json& row : flat["details"][0]["dd"])
        for (json& point : row) point = {1, 2};
    EXPECT_EQ(refusal_of(interface_.post_json("/surface/reconstruct", flat)),
              (Refusal{422, "mixed_dimensions", "details[0].dd"}));
}

TEST_F(SurfacesTest, WhatIsNoEditIsRefused) {
    const json edit =
        with(surface_,
             {{"level", {1, 1}}, {"control", {{"index", {2, 2}}, {"delta", {0, 0, 9}}}}});
    const std::vector<Wrong> wrong{
        {R"({"level":null})", {400, "invalid_argument", "level"}},
        {R"({"level":[1]})", {400, "invalid_argument", "level"}},
        {R"({"level":[3.5,1]})", {422, "level_out_of_range", "level[0]"}},
        {R"({"level":[3,2.5]})", {422, "level_out_of_range", "level[1]"}},
        {R"({"control":null})", {400, "invalid_argument", "control"}},
        {R"({"control":7})", {400, "invalid_argument", "control"}},
        {R"({"control":{"index":null}})", {400, "invalid_argument", "control.index"}},
        {R"({"control":{"index":[1]}})", {400, "invalid_argument", "control.index"}},
        {R"({"control":{"index":[5,0]}})", {422, "out_of_range", "control.index[0]"}},
        {R"({"control":{"index":[0,-1]}})", {422, "out_of_range", "control.index[1]"}},
        {R"({"control":{"index":[0.5,0]}})", {422, "out_of_range", "control.index[0]"}},
        {R"({"control":{"delta":null}})", {400, "invalid_argument", "control.delta"}},
        {R"({"control":{"delta":[1]}})", {422, "mixed_dimensions", "control.delta"}},
        {R"({"control":{"u":1}})", {400, "unknown_parameter", "control.u"}}};
    for (const auto& [changes, refusal] : wrong) {
        json request = edit;
        request.merge_patch(json::parse(changes));
        EXPECT_EQ(refusal_of(interface_.post_json("/surface/edit", request)), refusal)
            << changes;
    }
}

}  // namespace
}  // namespace haarmony::server
