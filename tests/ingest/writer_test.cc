#include "ingest/writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/ingest/memory_catalogue.h"
#include "tests/ingest/pretended_pictures.h"

namespace haarmony::ingest {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

FileReading described(int number) {
    schema::NewImage image;
    image.uri = "file:///" + std::to_string(number);
    image.stamp = {1, 2, std::to_string(number)};
    return {"/" + std::to_string(number), image.uri, Described{image}};
}

class WriterTest : public testing::Test {
  protected:
    MemoryCatalogue catalogue_;
    RecordingObserver observer_;
    Writer writer_{catalogue_, observer_, false};
    Batch::TimePoint now_{};
};

TEST_F(WriterTest, CommitsWhenTheBatchIsFull) {
    for (std::size_t i = 0; i < 2 * kBatchRows + 1; ++i) {
        ASSERT_TRUE(writer_.take(described(static_cast<int>(i)), now_));
    }
    EXPECT_THAT(catalogue_.operations_per_transaction,
                ElementsAre(kBatchRows, kBatchRows));
    EXPECT_EQ(writer_.tally().seen, 2 * static_cast<int>(kBatchRows));
    ASSERT_TRUE(writer_.write());
    EXPECT_THAT(catalogue_.operations_per_transaction,
                ElementsAre(kBatchRows, kBatchRows, 1));
}

TEST_F(WriterTest, CommitsWhenTheOldestReadingHasWaitedLongEnough) {
    ASSERT_TRUE(writer_.write_if_due(now_ + 1h));
    EXPECT_THAT(catalogue_.operations_per_transaction, IsEmpty());
    ASSERT_TRUE(writer_.take(described(1), now_));
    EXPECT_EQ(writer_.batch().deadline(), now_ + kBatchWindow);
    // What comes later does not put the first one off.
    ASSERT_TRUE(writer_.take(described(2), now_ + kBatchWindow - 1ms));
    EXPECT_EQ(writer_.batch().deadline(), now_ + kBatchWindow);
    EXPECT_THAT(catalogue_.operations_per_transaction, IsEmpty());
    ASSERT_TRUE(writer_.write_if_due(now_ + kBatchWindow));
    EXPECT_THAT(catalogue_.operations_per_transaction, ElementsAre(2));
    EXPECT_TRUE(writer_.batch().empty());
}

TEST_F(WriterTest, TheWindowLeavesTimeForTheCommitItself) {
    EXPECT_LE(kBatchWindow, 200ms);
}

TEST_F(WriterTest, NothingOfAFailedBatchIsWrittenCountedOrReported) {
    ASSERT_TRUE(writer_.take(described(1), now_));
    ASSERT_TRUE(writer_.write());
    catalogue_.failing_transaction = 2;
    ASSERT_TRUE(writer_.take(described(2), now_));
    ASSERT_TRUE(writer_.take({"/3", "file:///3", Undecodable{{1, 2, "3"}, "bad"}}, now_));
    const Result<void> written = writer_.write();
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().message, "forced failure of a transaction");
    EXPECT_EQ(catalogue_.rows().size(), 1u);
    EXPECT_EQ(writer_.tally(), (Tally{.seen = 1, .added = 1}));
    EXPECT_THAT(observer_.failures, IsEmpty());
}

}  // namespace
}  // namespace haarmony::ingest
