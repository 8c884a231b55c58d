#include "tests/eval/simulated_queries.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numeric>
#include <set>

#include "tests/eval/test/generated_pictures.h"

namespace haarmony::eval {
namespace {

double brightness(const std::vector<std::uint8_t>& bytes) {
    return std::accumulate(bytes.begin(), bytes.end(), 0.0) /
           static_cast<double>(bytes.size());
}

TEST(SimulatedScan, IsSmallAndDarkerAndKeepsItsShape) {
    const RgbPicture picture = gradient(240, 120);
    Random random(2);
    const RgbPicture scan = simulate_scan(picture, random);
    EXPECT_EQ(scan.width, 48);
    EXPECT_EQ(scan.height, 24);
    // 0.85 of a power above 1 of values below 1: less than 0.85 of the brightness.
    EXPECT_LT(brightness(scan.rgb), 0.85 * brightness(picture.rgb));
}

TEST(SimulatedScan, ASmallPictureIsNotEnlarged) {
    Random random(2);
    const RgbPicture scan = simulate_scan(gradient(20, 10), random);
    EXPECT_EQ(scan.width, 20);
    EXPECT_EQ(scan.height, 10);
}

TEST(SimulatedScan, NoiseIsTwoPerCent) {
    Random random(2);
    const RgbPicture scan = simulate_scan(flat(100, 100, 200, 200, 200), random);
    const double mean = brightness(scan.rgb);
    double square = 0;
    for (const std::uint8_t value : scan.rgb) square += (value - mean) * (value - mean);
    const double deviation = std::sqrt(square / static_cast<double>(scan.rgb.size()));
    EXPECT_NEAR(deviation, 0.02 * 255, 0.25);  // of 6,912 samples: five standard errors
}

TEST(SimulatedPainting, HasFiveLevelsAndAsManySquares) {
    Random random(3);
    const RgbPicture painting = simulate_painting(gradient(64, 64), 8, random);
    ASSERT_EQ(painting.width, 128);
    ASSERT_EQ(painting.height, 128);
    std::set<std::vector<std::uint8_t>> rows;
    for (int y = 0; y < painting.height; ++y) {
        const auto start =
            painting.rgb.begin() + static_cast<std::ptrdiff_t>(y) * 128 * 3;
        rows.insert(std::vector<std::uint8_t>(start, start + 128 * 3));
    }
    EXPECT_LE(rows.size(), 8U);
    const std::set<std::uint8_t> levels(painting.rgb.begin(), painting.rgb.end());
    const std::set<std::uint8_t> allowed{0, 64, 128, 191, 255};
    for (const std::uint8_t level : levels)
        EXPECT_TRUE(allowed.contains(level)) << +level;
    EXPECT_GT(levels.size(), 2U);
}

TEST(SimulatedPainting, MovesByAtMostThreePerCent) {
    // One bright column of squares: where it starts tells how far all was moved.
    RgbPicture picture = flat(64, 64, 0, 0, 0);
    for (int y = 0; y < 64; ++y) {
        for (int x = 32; x < 40; ++x) {
            for (int c = 0; c < 3; ++c)
                picture.rgb[(static_cast<std::size_t>(y) * 64 + x) * 3 + c] = 255;
        }
    }
    std::set<int> starts;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        Random random(seed);
        const RgbPicture painting = simulate_painting(picture, 8, random);
        int start = 0;
        while (painting.rgb[(64 * 128 + start) * 3] < 128) ++start;
        EXPECT_LE(std::abs(start - 64), 4) << seed;
        starts.insert(start);
    }
    EXPECT_GT(starts.size(), 4U);
}

TEST(SimulatedPainting, GridsAreEightToSixteen) {
    std::set<int> sides;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(seed);
        sides.insert(simulate_painting(gradient(32, 32), random).width / 16);
    }
    EXPECT_EQ(*sides.begin(), 8);
    EXPECT_EQ(*sides.rbegin(), 16);
}

TEST(SimulatedHalfPainting, OneHalfIsOpaqueAndTheOtherUnpainted) {
    std::set<std::pair<int, int>> corners;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        Random random(seed);
        const QueryPicture query = simulate_half_painting(gradient(32, 32), 8, random);
        ASSERT_EQ(query.channels, 4);
        int opaque_pixels = 0;
        for (std::size_t at = 3; at < query.pixels.size(); at += 4) {
            ASSERT_TRUE(query.pixels[at] == 0 || query.pixels[at] == 255);
            opaque_pixels += query.pixels[at] == 255;
        }
        EXPECT_EQ(opaque_pixels * 2, query.width * query.height);
        const ImageView view = query.view();
        corners.insert({view.row(0)[3] + 2 * view.row(0)[(query.width - 1) * 4 + 3],
                        view.row(query.height - 1)[3]});
    }
    EXPECT_EQ(corners.size(), 4U);  // left, right, upper and lower halves all occur
}

TEST(SimulatedQueries, EveryKindHasANameAndIsDeterminedByItsRandomNumbers) {
    const RgbPicture picture = generated_picture(1);
    std::set<std::string> names;
    for (const QueryKind kind :
         {QueryKind::kScanned, QueryKind::kPainted, QueryKind::kHalfPainted}) {
        names.insert(query_kind_name(kind));
        Random a(7);
        Random b(7);
        Random c(8);
        const QueryPicture first = simulate(kind, picture, a);
        EXPECT_EQ(first.pixels, simulate(kind, picture, b).pixels);
        EXPECT_NE(first.pixels, simulate(kind, picture, c).pixels);
    }
    EXPECT_EQ(names, (std::set<std::string>{"half painted", "painted", "scanned"}));
}

}  // namespace
}  // namespace haarmony::eval
