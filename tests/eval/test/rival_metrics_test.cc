#include "tests/eval/rival_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/eval/test/generated_pictures.h"

namespace haarmony::eval {
namespace {

// The definitions of section 4.5.2 on pictures of 128 x 128, in doubles.
double definition(Rival rival, const RgbPicture& a, const RgbPicture& b) {
    const auto value = [](const RgbPicture& p, int x, int y, int c) {
        return double{1} * p.rgb[(static_cast<std::size_t>(y) * 128 + x) * 3 + c];
    };
    double sum = 0;
    if (rival == Rival::kHistogram) {
        for (int bin = 0; bin < 216; ++bin) {
            int difference = 0;
            for (int i = 0; i < 128 * 128; ++i) {
                for (const auto& [picture, sign] :
                     {std::pair(&a, 1), std::pair(&b, -1)}) {
                    const auto sixth = [&](int c) {
                        return static_cast<int>(picture->rgb[i * 3 + c] / 256.0 * 6);
                    };
                    if (sixth(0) * 36 + sixth(1) * 6 + sixth(2) == bin)
                        difference += sign;
                }
            }
            sum += std::abs(difference);
        }
        return sum;
    }
    const bool full = rival == Rival::kL1Full || rival == Rival::kL2Full;
    const bool squared = rival == Rival::kL2Full || rival == Rival::kL2Cells;
    const int cell = full ? 1 : 16;
    for (int y = 0; y < 128; y += cell) {
        for (int x = 0; x < 128; x += cell) {
            for (int c = 0; c < 3; ++c) {
                double difference = 0;
                for (int i = 0; i < cell * cell; ++i) {
                    difference += value(a, x + i % cell, y + i / cell, c) -
                                  value(b, x + i % cell, y + i / cell, c);
                }
                sum += squared ? difference * difference : std::abs(difference);
            }
        }
    }
    return sum;
}

RgbPicture square(int number) { return resize(generated_picture(number), 128, 128); }

TEST(RivalMetrics, AreTheirDefinitions) {
    const RgbPicture a = square(0);
    const RgbPicture b = square(4);
    for (const Rival rival : kRivals) {
        const std::uint64_t measured =
            distance(rival, describe_rivals(a.view()), describe_rivals(b.view()));
        EXPECT_EQ(static_cast<double>(measured), definition(rival, a, b))
            << rival_name(rival).metric << ' ' << rival_name(rival).resolution;
        EXPECT_GT(measured, 0U);
    }
}

TEST(RivalMetrics, BlackAndWhiteAreAsFarApartAsItGets) {
    const auto black = describe_rivals(flat(3, 2, 0, 0, 0).view());
    const auto white = describe_rivals(flat(5, 9, 255, 255, 255).view());
    EXPECT_EQ(distance(Rival::kL1Full, black, white), 128ULL * 128 * 3 * 255);
    EXPECT_EQ(distance(Rival::kL2Full, black, white), 128ULL * 128 * 3 * 255 * 255);
    EXPECT_EQ(distance(Rival::kL1Cells, black, white), 128ULL * 128 * 3 * 255);
    EXPECT_EQ(distance(Rival::kL2Cells, black, white), 192ULL * 256 * 256 * 255 * 255);
    EXPECT_EQ(distance(Rival::kHistogram, black, white), 2ULL * 128 * 128);
}

TEST(RivalMetrics, AnyPictureIsAtNoDistanceFromItself) {
    const auto features = describe_rivals(generated_picture(2).view());
    for (const Rival rival : kRivals) EXPECT_EQ(distance(rival, features, features), 0U);
}

TEST(RivalMetrics, AreNamedAsTheTablesNameThem) {
    std::set<std::string> names;
    for (const Rival rival : kRivals)
        names.insert(rival_name(rival).metric + ' ' + rival_name(rival).resolution);
    EXPECT_EQ(names,
              (std::set<std::string>{
                  "L1 128x128", "L1 8x8", "L2 128x128", "L2 8x8", "histogram 6x6x6"}));
}

}  // namespace
}  // namespace haarmony::eval
