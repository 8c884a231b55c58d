#include "engine/image/explain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "engine/image/metric.h"
#include "tests/engine/image/pictures.h"
#include "tests/engine/image/random_signatures.h"

namespace haarmony::image {
namespace {

TEST(Explain, ItsPartsAddUpToTheMetric) {
    std::mt19937 random(201);
    const SignatureShape shape{.max_index = 150, .average_steps = 5};
    for (int round = 0; round < 50; ++round) {
        const Signature query = random_signature(random, shape);
        const Signature target = random_signature(random, shape);
        for (const char* name : {"painted", "scanned"}) {
            const Profile profile = *built_in_profile(name);
            for (const int m : {1, 7, 60, 100}) {
                const Explanation explanation = explain(query, target, profile, m);
                Score total = 0;
                for (const ExplainedChannel& channel : explanation) {
                    total += channel.distance();
                }
                EXPECT_EQ(total, metric(query, target, profile, m)) << name << " " << m;
            }
        }
    }
}

TEST(Explain, EveryCoefficientOfTheQueryIsMatchedOrMissed) {
    const Signature query = make_signature(scene(60, 40, 5).view());
    const Signature target = make_signature(scene(60, 40, 6).view());
    const Profile profile = *built_in_profile("painted");
    const Explanation explanation = explain(query, target, profile, 40);
    int matched = 0;
    for (int c = 0; c < kChannels; ++c) {
        std::vector<std::int16_t> all = explanation[c].matched;
        all.insert(all.end(), explanation[c].missed.begin(), explanation[c].missed.end());
        const auto asked = query.channels[c].largest(40);
        EXPECT_TRUE(std::ranges::is_permutation(all, asked));
        const auto has = target.channels[c].largest(40);
        for (const std::int16_t index : explanation[c].matched) {
            EXPECT_EQ(std::ranges::count(has, index), 1);
        }
        for (const std::int16_t index : explanation[c].missed) {
            EXPECT_EQ(std::ranges::count(has, index), 0);
        }
        EXPECT_EQ(explanation[c].bins[0].matched + explanation[c].bins[0].missed, 0);
        matched += int(explanation[c].matched.size());
    }
    EXPECT_GT(matched, 0);
}

TEST(DrawMatches, NothingMatchedIsMidGrey) {
    const std::vector<std::uint8_t> drawing = draw_matches({}, {});
    ASSERT_EQ(drawing.size(), std::size_t{kDrawingWidth} * kSide);
    EXPECT_EQ(std::ranges::count(drawing, 128), std::ssize(drawing));
}

// The coarsest wavelet across the columns: the left half of its panel above mid-grey, the
// right half below; the other panels empty.
TEST(DrawMatches, AHorizontalStepIsTwoHalves) {
    Signature query;
    query.channels[1].indices[0] = 1;
    query.channels[1].count = 1;
    const Explanation explanation =
        explain(query, query, *built_in_profile("painted"), 1);
    const std::vector<std::uint8_t> drawing = draw_matches(query, explanation);
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kDrawingWidth; ++x) {
            const int value = drawing[std::size_t(y) * kDrawingWidth + x];
            if (x < kSide || x >= 2 * kSide) {
                ASSERT_EQ(value, 128);
            } else if (x < kSide + kSide / 2) {
                ASSERT_GT(value, 150);
            } else {
                ASSERT_LT(value, 106);
            }
        }
    }
}

}  // namespace
}  // namespace haarmony::image
