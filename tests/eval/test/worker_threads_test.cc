#include "tests/eval/worker_threads.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <vector>

namespace haarmony::eval {
namespace {

TEST(WorkerThreads, DoEachPieceOnce) {
    for (const int threads : {1, 2, 5}) {
        WorkerThreads executor(threads);
        std::vector<std::atomic<int>> done(1000);
        executor.parallel_for(done.size(), [&](std::size_t i) { ++done[i]; });
        for (const auto& times : done) ASSERT_EQ(times, 1);
    }
}

TEST(WorkerThreads, NothingToDoIsDone) {
    WorkerThreads executor(3);
    executor.parallel_for(0, [](std::size_t) { FAIL(); });
}

TEST(WorkerThreads, WorkMayDivideItself) {
    WorkerThreads executor(2);
    std::atomic<int> done{0};
    executor.parallel_for(
        4, [&](std::size_t) { executor.parallel_for(8, [&](std::size_t) { ++done; }); });
    EXPECT_EQ(done, 32);
}

}  // namespace
}  // namespace haarmony::eval
