#include "ingest/gallery/lsystem.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace haarmony::gallery {
namespace {

TEST(LSystem, LindenmayersAlgaeGrowAsFibonacciNumbers) {
    const Grammar algae{"A", {{'A', {"AB"}}, {'B', {"A"}}}};
    Random random(1);
    std::size_t previous = 1;
    std::size_t current = 2;
    EXPECT_EQ(rewrite(algae, 0, 10'000, random), "A");
    for (int generation = 1; generation < 16; ++generation) {
        EXPECT_EQ(rewrite(algae, generation, 10'000, random).size(), current);
        const std::size_t next = previous + current;
        previous = current;
        current = next;
    }
    EXPECT_EQ(rewrite(algae, 4, 10'000, random), "ABAABABA");
}

TEST(LSystem, GrowthStopsAtTheLimit) {
    const Grammar doubling{"F", {{'F', {"FF"}}}};
    Random random(1);
    EXPECT_EQ(rewrite(doubling, 60, 100, random).size(), 64U);
}

TEST(LSystem, EverySuccessorIsChosenSometimes) {
    const Grammar either{std::string(200, 'X'), {{'X', {"a", "b", "c"}}}};
    Random random(2);
    const std::string symbols = rewrite(either, 1, 1000, random);
    for (const char symbol : {'a', 'b', 'c'})
        EXPECT_GT(std::count(symbols.begin(), symbols.end(), symbol), 30) << symbol;
}

TEST(LSystem, TheTurtleWalksASquareBackToItsStart) {
    Random random(3);
    const Plant plant = grow("F+F+F+F", {.angle = M_PI / 2}, random);
    ASSERT_EQ(plant.twigs.size(), 4U);
    EXPECT_NEAR(plant.twigs[0].to.y, -1, 1e-7) << "the first step goes up";
    EXPECT_NEAR(plant.twigs[1].to.x, 1, 1e-7) << "+ turns clockwise";
    EXPECT_LT(length(plant.twigs[3].to), 1e-6);
}

TEST(LSystem, BracketsReturnToWhereTheyOpened) {
    Random random(4);
    const Plant plant = grow("F[+F[-F]L]F*", {.angle = 0.5, .shrink = 0.5}, random);
    ASSERT_EQ(plant.twigs.size(), 4U);
    EXPECT_EQ(plant.twigs[1].depth, 1);
    EXPECT_EQ(plant.twigs[2].depth, 2);
    EXPECT_EQ(plant.twigs[3].depth, 0);
    EXPECT_LT(length(plant.twigs[3].from - plant.twigs[0].to), 1e-12);
    EXPECT_NEAR(length(plant.twigs[2].to - plant.twigs[2].from), 0.25, 1e-8);
    ASSERT_EQ(plant.buds.size(), 2U);
    EXPECT_FALSE(plant.buds[0].blossom);
    EXPECT_TRUE(plant.buds[1].blossom);
    EXPECT_LT(length(plant.buds[1].at - Point{0, -2}), 1e-7);
}

TEST(LSystem, AnUnmatchedBracketIsPassedOver) {
    Random random(5);
    EXPECT_EQ(grow("F]F", {}, random).twigs.size(), 2U);
}

TEST(LSystem, FittedPlantsFillTheirBox) {
    Random random(6);
    const Plant plant = grow("FF[+F+F][-F]F", {.angle = 0.9}, random);
    const Plant placed = fitted(plant, {1, 2}, 0.8, 0.5);
    double top = 2;
    double widest = 0;
    for (const Twig& twig : placed.twigs) {
        top = std::min(top, twig.to.y);
        widest = std::max(widest, std::fabs(twig.to.x - 1));
    }
    EXPECT_LT(length(placed.twigs[0].from - Point{1, 2}), 1e-12);
    EXPECT_GE(top, 2 - 0.5 - 1e-9);
    EXPECT_LE(widest, 0.4 + 1e-9);
    const bool reaches = std::fabs(top - 1.5) < 1e-9 || std::fabs(widest - 0.4) < 1e-9;
    EXPECT_TRUE(reaches) << "neither side of the box is reached";
}

}  // namespace
}  // namespace haarmony::gallery
