// How much memory a merge needs beside the collection, which stays as it is until the merge
// is done: counted, byte by byte.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <random>

#include "engine/image/index.h"
#include "engine/image/merge_plan.h"
#include "engine/image/segment_layout.h"
#include "tests/engine/image/random_signatures.h"
#include "tests/support/allocated_bytes.h"

namespace haarmony::image {
namespace {

namespace memory = haarmony::test;

// Tables that a builder has one entry in for each key, whatever the pictures.
constexpr std::int64_t kTables = std::int64_t{kKeyCount} * 32;

class MergeMemory : public testing::Test {
  protected:
    // A segment of its own of so many pictures.
    void seal(int pictures) {
        std::vector<Record> records;
        const SignatureShape shape{.max_count = 60, .max_index = 2000};
        for (int i = 0; i < pictures; ++i)
            records.push_back({ImageId{next_id_++}, random_signature(random_, shape)});
        index_.apply(records, {});
    }

    // What merge_once() needs at its worst, beside what there was before.
    std::int64_t merge() {
        const std::int64_t before = memory::allocated_bytes();
        memory::watch_allocated_bytes();
        EXPECT_TRUE(index_.merge_once());
        return memory::most_allocated_bytes() - before;
    }

    [[nodiscard]] IndexStats stats() const { return index_.snapshot()->stats(); }

    Index index_{{.index_m = 60, .tail_capacity = 1}};

  private:
    std::mt19937 random_{191};
    int next_id_ = 1;
};

TEST_F(MergeMemory, StaysWithinOneAndAHalfTimesTheCollection) {
    for (int i = 0; i < 18; ++i) seal(2'500);
    for (int merges = 0; merges < 4; ++merges) {
        const IndexStats before = stats();
        const std::int64_t beside = merge();
        ASSERT_LT(stats().segments, before.segments);
        EXPECT_LE(2 * beside, before.bytes) << "merge " << merges;
    }
}

// Of a small collection all pictures are on their way at once, as signed 16-bit indices; what
// else a picture needs is its place, its slot and its averages.
TEST_F(MergeMemory, IsTheResultAndThePicturesOnTheirWay) {
    constexpr std::int64_t kOnItsWay = 3 * 60 * 2 + 60;
    for (int i = 0; i < 4; ++i) seal(kSmallMerge / 4);
    const std::int64_t beside = merge();
    ASSERT_EQ(stats().segments, 1);
    const std::int64_t result = stats().bytes;
    EXPECT_GE(beside, result);
    EXPECT_LE(beside, result + stats().images * kOnItsWay + kTables);
}

TEST_F(MergeMemory, IsGivenBackWhenTheMergeIsDone) {
    for (int i = 0; i < 4; ++i) seal(2'000);
    const std::int64_t before = memory::allocated_bytes();
    const std::int64_t parts = stats().bytes;
    (void)merge();
    // Nodes of lists and pointers beside what is counted.
    constexpr std::int64_t kBookkeeping = 4096;
    EXPECT_NEAR(double(memory::allocated_bytes()),
                double(before - parts + stats().bytes),
                double(kBookkeeping));
}

TEST(AllocatedBytes, CountsWhatIsThereAndTheMostThereWas) {
    const std::int64_t before = memory::allocated_bytes();
    auto large = std::make_unique<std::array<char, 100'000>>();
    memory::watch_allocated_bytes();
    EXPECT_EQ(memory::allocated_bytes(), before + 100'000);
    {
        struct alignas(128) Aligned {
            std::array<char, 1280> bytes;
        };
        const auto aligned = std::make_unique<Aligned>();
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(aligned.get()) % 128, 0U);
        EXPECT_EQ(memory::allocated_bytes(), before + 101'280);
    }
    large.reset();
    EXPECT_EQ(memory::allocated_bytes(), before);
    EXPECT_EQ(memory::most_allocated_bytes(), before + 101'280);
}

}  // namespace
}  // namespace haarmony::image
