#include "server/app/thread_executor.h"

#include <gtest/gtest.h>

#include <atomic>
#include <set>
#include <thread>
#include <vector>

namespace haarmony::server {
namespace {

TEST(ThreadExecutor, CallsEachNumberOnceWhateverTheThreads) {
    for (const int threads : {0, 1, 3}) {
        ThreadExecutor executor(threads);
        for (const std::size_t count : {0U, 1U, 2U, 1000U}) {
            std::vector<std::atomic<int>> calls(count);
            executor.parallel_for(count, [&](std::size_t i) { ++calls[i]; });
            for (std::size_t i = 0; i < count; ++i)
                EXPECT_EQ(calls[i], 1) << threads << " threads, " << i << " of " << count;
        }
    }
}

TEST(ThreadExecutor, CallersDoNotDisturbEachOther) {
    ThreadExecutor executor(2);
    std::vector<std::int64_t> sums(4);
    std::vector<std::thread> callers;
    for (std::size_t caller = 0; caller < sums.size(); ++caller)
        callers.emplace_back([&, caller] {
            for (int round = 0; round < 50; ++round) {
                std::atomic<std::int64_t> sum{0};
                executor.parallel_for(
                    100, [&](std::size_t i) { sum += static_cast<std::int64_t>(i); });
                sums[caller] += sum;
            }
        });
    for (std::thread& caller : callers) caller.join();
    for (const std::int64_t sum : sums) EXPECT_EQ(sum, 50 * 99 * 100 / 2);
}

TEST(ThreadExecutor, WorkGoesOnAtTheSameTime) {
    ThreadExecutor executor(1);
    // Two calls that wait for each other: one thread alone would wait for ever.
    std::atomic<int> there{0};
    executor.parallel_for(2, [&](std::size_t) {
        ++there;
        while (there < 2) std::this_thread::yield();
    });
    EXPECT_EQ(there, 2);
}

TEST(ThreadExecutor, WorkMayDivideItself) {
    ThreadExecutor executor(1);
    std::atomic<int> done{0};
    executor.parallel_for(
        4, [&](std::size_t) { executor.parallel_for(8, [&](std::size_t) { ++done; }); });
    EXPECT_EQ(done, 32);
}

}  // namespace
}  // namespace haarmony::server
