#include "engine/curve/built_in_character.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/curve/affected.h"
#include "engine/curve/character.h"

namespace haarmony::curve {
namespace {

TEST(BuiltInCharacter, HaveNamesInOrder) {
    std::vector<std::string> names;
    for (const BuiltInCharacter& character : built_in_characters()) {
        names.emplace_back(character.name);
    }
    EXPECT_GE(names.size(), 5U);
    EXPECT_TRUE(std::ranges::is_sorted(names));
    EXPECT_EQ(std::ranges::adjacent_find(names), names.end());
}

TEST(BuiltInCharacter, IsFoundByItsName) {
    for (const BuiltInCharacter& character : built_in_characters()) {
        EXPECT_EQ(built_in_character(character.name), &character);
    }
    EXPECT_EQ(built_in_character("Wiggly"), nullptr);
    EXPECT_EQ(built_in_character(""), nullptr);
}

TEST(BuiltInCharacter, IsAStrokeOnThePage) {
    for (const BuiltInCharacter& character : built_in_characters()) {
        const Points stroke = character.stroke();
        EXPECT_EQ(level_of(stroke.size(), Ends::kOpen), kBuiltInLevel) << character.name;
        EXPECT_EQ(stroke.dimension(), 2) << character.name;
        for (const double number : stroke.numbers()) {
            EXPECT_TRUE(number >= 0 && number <= 1000) << character.name << " " << number;
        }
        EXPECT_EQ(stroke, character.stroke()) << character.name;
    }
}

TEST(BuiltInCharacter, SmoothHasNoDetails) {
    const BuiltInCharacter* smooth = built_in_character("smooth");
    ASSERT_NE(smooth, nullptr);
    const MultiresCurve curve = decompose(smooth->stroke(), Ends::kOpen);
    for (const Points& detail : curve.details) EXPECT_LT(coordinate_size(detail), 1e-9);
}

// The square of the L2 norm of the details, level by level, as if wavelets of a level were
// orthogonal; good enough to say where a character is.
double energy(const MultiresCurve& curve, int from, int to) {
    double sum = 0;
    for (int level = from; level < to; ++level) {
        for (const double number : curve.details[level].numbers()) sum += number * number;
    }
    return sum;
}

TEST(BuiltInCharacter, IsInTheFineDetailsAndNotInTheSweep) {
    for (const BuiltInCharacter& character : built_in_characters()) {
        if (character.name == "smooth") continue;
        const MultiresCurve curve = decompose(character.stroke(), Ends::kOpen);
        const double fine = energy(curve, 3, kBuiltInLevel);
        EXPECT_GT(fine, 5) << character.name;  // of pixels of the page, root mean square
        EXPECT_LT(energy(curve, 0, 3), 0.2 * fine) << character.name;
    }
}

TEST(BuiltInCharacter, DiffersFromTheOthers) {
    for (const BuiltInCharacter& one : built_in_characters()) {
        for (const BuiltInCharacter& other : built_in_characters()) {
            if (&one == &other) continue;
            const Points a = one.stroke();
            const Points b = other.stroke();
            double most = 0;
            for (std::size_t i = 0; i < a.size(); ++i) {
                most = std::max(most, std::abs(a[i][1] - b[i][1]));
            }
            EXPECT_GT(most, 5) << one.name << " " << other.name;
        }
    }
}

}  // namespace
}  // namespace haarmony::curve
