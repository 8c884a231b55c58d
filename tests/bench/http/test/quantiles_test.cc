#include "tests/bench/http/quantiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace haarmony::bench {
namespace {

TEST(Quantiles, OfOneValueAreThatValue) {
    const Quantiles q = quantiles_of({7});
    EXPECT_EQ(q.p50, 7);
    EXPECT_EQ(q.p90, 7);
    EXPECT_EQ(q.p99, 7);
    EXPECT_EQ(q.max, 7);
}

// By the definition: the smallest value with that share of all at or below it.
TEST(Quantiles, AreTheNearestRanksWhateverTheOrder) {
    std::mt19937 random(3);
    for (const int count : {2, 3, 10, 99, 100, 101, 1000}) {
        std::vector<double> values;
        for (int i = 0; i < count; ++i)
            values.push_back(static_cast<double>(random() % 50));
        const auto smallest = [&](int percent) {
            double best = *std::ranges::max_element(values);
            for (const double value : values) {
                const auto covered =
                    std::ranges::count_if(values, [&](double v) { return v <= value; });
                if (covered * 100 >= std::int64_t{percent} * count)
                    best = std::min(best, value);
            }
            return best;
        };
        const Quantiles q = quantiles_of(values);
        EXPECT_EQ(q.p50, smallest(50)) << count;
        EXPECT_EQ(q.p90, smallest(90)) << count;
        EXPECT_EQ(q.p99, smallest(99)) << count;
        EXPECT_EQ(q.max, smallest(100)) << count;
    }
}

}  // namespace
}  // namespace haarmony::bench
