#include "ingest/bounded_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include "ingest/byte_budget.h"

namespace haarmony::ingest {
namespace {

TEST(BoundedQueue, GivesEveryItemOnceAndEachProducersInOrder) {
    constexpr int kProducers = 3;
    constexpr int kItems = 2000;
    BoundedQueue<std::pair<int, int>> queue(4);
    std::vector<std::thread> producers;
    std::atomic<int> left = kProducers;
    for (int p = 0; p < kProducers; ++p) {
        producers.emplace_back([&, p] {
            for (int i = 0; i < kItems; ++i) EXPECT_TRUE(queue.push({p, i}));
            if (--left == 0) queue.close();
        });
    }
    std::vector<int> next(kProducers, 0);
    while (const auto item = queue.pop()) EXPECT_EQ(next[item->first]++, item->second);
    for (std::thread& producer : producers) producer.join();
    EXPECT_EQ(next, std::vector<int>(kProducers, kItems));
    EXPECT_TRUE(queue.exhausted());
}

TEST(BoundedQueue, NeverHoldsMoreThanItsCapacity) {
    constexpr int kCapacity = 3;
    BoundedQueue<int> queue(kCapacity);
    std::atomic<int> pushed = 0;
    std::thread producer([&] {
        for (int i = 0; i < 500; ++i) {
            (void)queue.push(i);
            ++pushed;
        }
        queue.close();
    });
    int popped = 0;
    while (queue.pop()) {
        ++popped;
        // Whatever was pushed and is not popped was in the queue.
        EXPECT_LE(pushed - popped, kCapacity);
    }
    producer.join();
    EXPECT_EQ(popped, 500);
}

TEST(BoundedQueue, CloseWakesAProducerThatWaitsAndItsItemIsDropped) {
    BoundedQueue<int> queue(1);
    ASSERT_TRUE(queue.push(1));
    std::atomic<int> accepted = -1;
    std::thread producer([&] { accepted = queue.push(2) ? 1 : 0; });
    queue.close();
    producer.join();
    EXPECT_EQ(accepted, 0);
    EXPECT_FALSE(queue.exhausted());
    EXPECT_EQ(queue.pop(), 1);
    EXPECT_EQ(queue.pop(), std::nullopt);
    EXPECT_TRUE(queue.exhausted());
}

TEST(BoundedQueue, ADeadlineThatIsPastGivesWhatIsThereOrNothing) {
    BoundedQueue<std::unique_ptr<int>> queue(2);
    const auto past = BoundedQueue<int>::Clock::now();
    EXPECT_EQ(queue.pop_until(past), std::nullopt);
    EXPECT_FALSE(queue.exhausted());
    ASSERT_TRUE(queue.push(std::make_unique<int>(7)));
    const auto item = queue.pop_until(past);
    ASSERT_TRUE(item);
    EXPECT_EQ(**item, 7);
}

TEST(ByteBudget, IsNeverOverdrawnExceptByOneAlone) {
    constexpr std::int64_t kTotal = 100;
    ByteBudget budget(kTotal);
    std::atomic<std::int64_t> held = 0;
    std::atomic<int> holders = 0;
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) {
        threads.emplace_back([&, t] {
            for (int i = 0; i < 300; ++i) {
                const std::int64_t bytes = (i * 37 + t * 11) % 130;
                const ByteBudget::Share share = budget.take(bytes);
                const std::int64_t now = held += bytes;
                const int alone = ++holders;
                EXPECT_TRUE(now <= kTotal || alone == 1) << now;
                held -= bytes;
                --holders;
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(budget.in_use(), 0);
}

TEST(ByteBudget, ASmallShareDoesNotOvertakeALargeOne) {
    ByteBudget budget(100);
    auto first = std::make_unique<ByteBudget::Share>(budget.take(60));
    std::vector<char> order;
    std::mutex mutex;
    const auto take = [&](std::int64_t bytes, char name) {
        const ByteBudget::Share share = budget.take(bytes);
        const std::lock_guard lock(mutex);
        order.push_back(name);
    };
    std::thread large([&] { take(100, 'L'); });
    while (budget.waiting() != 1) std::this_thread::yield();
    // It would fit at once beside the first.
    std::thread small([&] { take(1, 's'); });
    while (budget.waiting() != 2) std::this_thread::yield();
    first.reset();
    large.join();
    small.join();
    EXPECT_EQ(order, (std::vector<char>{'L', 's'}));
}

}  // namespace
}  // namespace haarmony::ingest
