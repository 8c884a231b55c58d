#include "tests/eval/brute_force.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/image/signature.h"
#include "tests/eval/rival_metrics.h"
#include "tests/eval/test/generated_pictures.h"

namespace haarmony::eval {
namespace {

constexpr int kPictures = 30;
constexpr std::size_t kCellPixels = 256;

struct Described {
    CompactFeatures compact;
    RivalFeatures rivals;
};

const std::vector<Described>& pictures() {
    static const std::vector<Described> described = [] {
        std::vector<Described> all;
        for (int i = 0; i < kPictures; ++i) {
            const RgbPicture square =
                resize(generated_picture(i), image::kSide, image::kSide);
            all.push_back({compact_features(square), describe_rivals(square.view())});
        }
        return all;
    }();
    return described;
}

TEST(BruteForce, CellsAreTheRivalsSumsAsMeans) {
    for (const Described& picture : pictures()) {
        for (std::size_t i = 0; i < picture.compact.cells.size(); ++i) {
            EXPECT_EQ(picture.compact.cells[i],
                      std::lround(picture.rivals.cells[i] / double(kCellPixels)));
        }
        EXPECT_TRUE(
            std::ranges::equal(picture.compact.histogram, picture.rivals.histogram));
    }
}

TEST(BruteForce, HistogramOrderIsTheRivalsOwn) {
    std::vector<HistogramCounts> histograms;
    for (const Described& picture : pictures())
        histograms.push_back(picture.compact.histogram);
    for (const std::size_t q : {0U, 7U, 23U}) {
        std::vector<std::pair<std::uint64_t, std::size_t>> expected;
        for (std::size_t i = 0; i < pictures().size(); ++i) {
            expected.emplace_back(
                distance(Rival::kHistogram, pictures()[q].rivals, pictures()[i].rivals),
                i);
        }
        std::ranges::sort(expected);
        const auto nearest = closest_histogram(histograms[q], histograms, 20);
        ASSERT_EQ(nearest.size(), 20U);
        for (std::size_t i = 0; i < nearest.size(); ++i) {
            EXPECT_EQ(nearest[i].distance, expected[i].first) << q << ' ' << i;
            EXPECT_EQ(nearest[i].place, expected[i].second) << q << ' ' << i;
        }
    }
}

// Enough pictures for several batches, and one that is not full.
TEST(BruteForce, FindsTheSmallestDistances) {
    std::vector<CellBytes> cells;
    for (int i = 0; i < 600; ++i) {
        cells.push_back(pictures()[i % kPictures].compact.cells);
        cells.back()[i % cells.back().size()] = static_cast<std::uint8_t>(i * 7);
    }
    const CellBytes query = pictures()[4].compact.cells;
    std::vector<NearPlace> by_l1;
    std::vector<NearPlace> by_l2;
    for (std::uint32_t i = 0; i < cells.size(); ++i) {
        double l1 = 0;
        double l2 = 0;
        for (std::size_t k = 0; k < query.size(); ++k) {
            const double difference = double(query[k]) - double(cells[i][k]);
            l1 += std::fabs(difference);
            l2 += difference * difference;
        }
        by_l1.push_back({static_cast<std::uint32_t>(l1), i});
        by_l2.push_back({static_cast<std::uint32_t>(l2), i});
    }
    std::ranges::sort(by_l1);
    std::ranges::sort(by_l2);
    by_l1.resize(20);
    by_l2.resize(20);
    EXPECT_EQ(closest_l1(query, cells, 20), by_l1);
    EXPECT_EQ(closest_l2(query, cells, 20), by_l2);
}

TEST(BruteForce, LargestDistancesDoNotOverflow) {
    CellBytes black{};
    CellBytes white{};
    white.fill(255);
    const std::vector<CellBytes> pictures_of = {white};
    EXPECT_EQ(closest_l1(black, pictures_of, 1).front().distance, 192U * 255);
    EXPECT_EQ(closest_l2(black, pictures_of, 1).front().distance, 192U * 255 * 255);
    HistogramCounts one{};
    HistogramCounts other{};
    one.front() = image::kCoefficientCount;
    other.back() = image::kCoefficientCount;
    const std::vector<HistogramCounts> histograms = {other};
    EXPECT_EQ(closest_histogram(one, histograms, 1).front().distance,
              2U * image::kCoefficientCount);
}

}  // namespace
}  // namespace haarmony::eval
