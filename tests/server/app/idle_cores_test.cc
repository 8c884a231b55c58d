#include "server/app/idle_cores.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>
#include <vector>

namespace haarmony::server {
namespace {

TEST(IdleCores, ASearchOnOneCoreHasNoOthers) {
    IdleCores cores(1);
    EXPECT_EQ(IdleCores::Share(cores).executor(), nullptr);
}

TEST(IdleCores, SearchesShareUntilThereIsOneForEveryTwoCores) {
    IdleCores cores(4);
    const IdleCores::Share first(cores);
    EXPECT_NE(first.executor(), nullptr);
    auto second = std::make_unique<IdleCores::Share>(cores);
    EXPECT_NE(second->executor(), nullptr);
    EXPECT_EQ(IdleCores::Share(cores).executor(), nullptr);
    // One that ended makes room for the next.
    second.reset();
    EXPECT_NE(IdleCores::Share(cores).executor(), nullptr);
}

TEST(IdleCores, CountIsRightAfterManySearchesAtTheSameTime) {
    IdleCores cores(2);
    std::vector<std::thread> searches;
    for (int i = 0; i < 4; ++i)
        searches.emplace_back([&] {
            for (int round = 0; round < 1000; ++round)
                const IdleCores::Share share(cores);
        });
    for (std::thread& search : searches) search.join();
    const IdleCores::Share alone(cores);
    EXPECT_NE(alone.executor(), nullptr);
    EXPECT_EQ(IdleCores::Share(cores).executor(), nullptr);
}

TEST(IdleCores, ExecutorHasTheOtherCores) {
    IdleCores cores(2);
    const IdleCores::Share share(cores);
    ASSERT_NE(share.executor(), nullptr);
    // Two calls that wait for each other: one thread alone would wait for ever.
    std::atomic<int> there = 0;
    share.executor()->parallel_for(2, [&](std::size_t) {
        ++there;
        while (there < 2) std::this_thread::yield();
    });
    EXPECT_EQ(there, 2);
}

}  // namespace
}  // namespace haarmony::server
