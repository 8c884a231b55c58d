#include "engine/image/merge_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

#include "engine/image/segment_layout.h"

namespace haarmony::image {
namespace {

std::vector<SegmentSize> full(const std::vector<int>& sizes) {
    std::vector<SegmentSize> segments;
    for (const int size : sizes) segments.push_back({size, size});
    return segments;
}

using Plan = std::vector<std::size_t>;

TEST(MergePlan, OfFewSegmentsOfASizeIsNothing) {
    EXPECT_EQ(plan_merge({}), Plan{});
    EXPECT_EQ(plan_merge(full({1024})), Plan{});
    EXPECT_EQ(plan_merge(full({1024, 1100, 1500})), Plan{});
    EXPECT_EQ(plan_merge(full({1024, 5000, 20000, 70000})), Plan{});
}

TEST(MergePlan, TakesAllOfTheSmallestClassThatIsDue) {
    EXPECT_EQ(plan_merge(full({1024, 30000, 1500, 1024, 1030})), (Plan{0, 3, 4, 2}));
    EXPECT_EQ(plan_merge(full({8, 8, 8, 8, 70, 70, 70, 70})), (Plan{0, 1, 2, 3}));
}

TEST(MergePlan, NeverMakesMoreThanASegmentHolds) {
    const auto with_others = [](std::vector<int> sizes) {
        sizes.insert(sizes.end(), 3, kMaxSegmentSlots);
        sizes.insert(sizes.end(), 3, kMaxSegmentSlots - 1);
        return full(sizes);
    };
    EXPECT_EQ(plan_merge(with_others({})), Plan{});
    EXPECT_EQ(plan_merge(with_others({32768, 32768, 32768, 32768})), (Plan{0, 1, 2, 3}));
    EXPECT_EQ(plan_merge(with_others({40000, 40000, 40000, 40000})), (Plan{0, 1, 2}));
}

TEST(MergePlan, NeverMakesMoreThanAQuarterOfAll) {
    EXPECT_EQ(plan_merge(full({40000, 40000, 40000, 40000})), Plan{});
    EXPECT_EQ(plan_merge(full({9000, 9000, 9000, 9000, 60000})), (Plan{0, 1}));
    EXPECT_EQ(plan_merge(full({9000, 9000, 9000, 9000, 108'000})), (Plan{0, 1, 2, 3}));
}

TEST(MergePlan, MakesOfFewPicturesWhatTheyAre) {
    EXPECT_EQ(plan_merge(full({2048, 2048, 2048, 2048})), (Plan{0, 1, 2, 3}));
    EXPECT_EQ(plan_merge(full({2048, 2048, 2048, 2049})), (Plan{0, 1, 2}));
}

TEST(MergePlan, RewritesASegmentThatLostHalf) {
    EXPECT_EQ(plan_merge(std::vector<SegmentSize>{{100, 100}, {100, 50}}), (Plan{1}));
    EXPECT_EQ(plan_merge(std::vector<SegmentSize>{{100, 100}, {100, 51}}), Plan{});
    EXPECT_EQ(plan_merge(std::vector<SegmentSize>{{3, 0}}), (Plan{0}));
}

// Sealing n pictures at a time, for a long time: every plan shrinks the list, the list
// stays short, and a picture is moved no more often than there are size classes.
TEST(MergePlan, KeepsTheListShortAndTheWorkLogarithmic) {
    std::mt19937 random(141);
    std::vector<SegmentSize> segments;
    std::int64_t pictures = 0;
    std::int64_t moved = 0;
    for (int i = 0; i < 3000; ++i) {
        const int size = 100 + static_cast<int>(random() % 1000);
        segments.push_back({size, size});
        pictures += size;
        for (Plan plan = plan_merge(segments); !plan.empty();
             plan = plan_merge(segments)) {
            SegmentSize merged;
            std::ranges::sort(plan, std::greater<>());
            for (const std::size_t at : plan) {
                merged.slots += segments[at].live;
                segments.erase(segments.begin() + std::ptrdiff_t(at));
            }
            merged.live = merged.slots;
            ASSERT_LE(merged.slots, kMaxSegmentSlots);
            ASSERT_GE(plan.size(), 2U);
            moved += merged.slots;
            segments.push_back(merged);
        }
    }
    // Full ones hold more than half of kMaxSegmentSlots; below them at most three of each class.
    EXPECT_LE(std::int64_t(segments.size()), 2 * pictures / kMaxSegmentSlots + 3 * 9);
    EXPECT_LE(moved, 9 * pictures);
}

}  // namespace
}  // namespace haarmony::image
