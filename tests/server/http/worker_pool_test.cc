#include "server/http/worker_pool.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <future>
#include <latch>
#include <memory>
#include <thread>
#include <vector>

namespace haarmony::http {
namespace {

// Keeps the only thread of a pool busy until it is let go.
class Blocker {
  public:
    explicit Blocker(WorkerPool& pool) {
        EXPECT_TRUE(pool.submit([this] {
            started_.count_down();
            release_.wait();
        }));
        started_.wait();
    }
    void let_go() { release_.count_down(); }

  private:
    std::latch started_{1};
    std::latch release_{1};
};

TEST(WorkerPool, JobsOfOneThreadRunInTheirOrder) {
    std::vector<int> seen;
    std::latch done(100);
    WorkerPool pool(1, 100, 0);
    for (int i = 0; i < 100; ++i) {
        ASSERT_TRUE(pool.submit([&, i] {
            seen.push_back(i);
            done.count_down();
        }));
    }
    done.wait();
    for (int i = 0; i < 100; ++i) EXPECT_EQ(seen[static_cast<std::size_t>(i)], i);
}

TEST(WorkerPool, FullQueueRefuses) {
    WorkerPool pool(1, 2, 0);
    Blocker blocker(pool);
    std::atomic<int> ran = 0;
    EXPECT_TRUE(pool.submit([&] { ++ran; }));
    EXPECT_TRUE(pool.submit([&] { ++ran; }));
    EXPECT_EQ(pool.queued(), 2U);
    EXPECT_FALSE(pool.submit([&] { ran = 100; }));
    std::latch done(1);
    blocker.let_go();
    while (!pool.submit([&] { done.count_down(); })) std::this_thread::yield();
    done.wait();
    EXPECT_EQ(ran, 2);
}

TEST(WorkerPool, CancelledJobIsDestroyedWithoutRunning) {
    WorkerPool pool(1, 2, 0);
    Blocker blocker(pool);
    auto held = std::make_shared<int>(0);
    const std::weak_ptr<int> watch = held;
    const auto ticket = pool.submit([held = std::move(held)] { *held = 1; });
    ASSERT_TRUE(ticket);
    EXPECT_TRUE(pool.cancel(*ticket));
    EXPECT_TRUE(watch.expired());
    EXPECT_FALSE(pool.cancel(*ticket));
    EXPECT_EQ(pool.queued(), 0U);
    blocker.let_go();
}

TEST(WorkerPool, RunningJobCannotBeCancelled) {
    WorkerPool pool(1, 2, 0);
    std::latch started(1);
    std::latch release(1);
    const auto ticket = pool.submit([&] {
        started.count_down();
        release.wait();
    });
    started.wait();
    EXPECT_FALSE(pool.cancel(*ticket));
    release.count_down();
}

TEST(WorkerPool, StopWaitsForWhatRunsAndDropsWhatWaits) {
    std::atomic<bool> finished = false;
    std::atomic<bool> dropped_ran = false;
    WorkerPool pool(1, 2, 0);
    std::latch started(1);
    std::latch release(1);
    ASSERT_TRUE(pool.submit([&] {
        started.count_down();
        release.wait();
        finished = true;
    }));
    started.wait();
    auto held = std::make_shared<int>(0);
    const std::weak_ptr<int> watch = held;
    ASSERT_TRUE(pool.submit([&, held = std::move(held)] { dropped_ran = true; }));
    std::thread stopper([&] { pool.stop(); });
    while (!watch.expired()) std::this_thread::yield();
    EXPECT_FALSE(finished);
    release.count_down();
    stopper.join();
    EXPECT_TRUE(finished);
    EXPECT_FALSE(dropped_ran);
    EXPECT_FALSE(pool.submit([] {}));
}

TEST(WorkerPool, DestructorOfADroppedJobMayUseThePool) {
    WorkerPool pool(1, 4, 0);
    Blocker blocker(pool);
    const auto other = pool.submit([] {});
    const std::shared_ptr<void> chained(nullptr, [&](void*) { pool.cancel(*other); });
    const auto ticket = pool.submit([chained] {});
    EXPECT_TRUE(pool.cancel(*ticket));
    blocker.let_go();
}

TEST(WorkerPool, JobThatRunsHereCountsAsOneOfThePool) {
    WorkerPool pool(1, 2, 0);
    const auto here = std::this_thread::get_id();
    std::thread::id ran_on;
    std::latch done(1);
    EXPECT_TRUE(pool.run_here([&] {
        ran_on = std::this_thread::get_id();
        // The only place is taken, by this job.
        EXPECT_TRUE(pool.submit([&] { done.count_down(); }));
        EXPECT_EQ(pool.queued(), 1U);
        EXPECT_FALSE(pool.run_here([] { FAIL() << "beside the one that runs"; }));
        EXPECT_EQ(pool.queued(), 1U);
    }));
    EXPECT_EQ(ran_on, here);
    // Its place is free for the one that waits.
    done.wait();
    EXPECT_EQ(pool.queued(), 0U);
}

TEST(WorkerPool, NothingRunsHereWhileAllPlacesAreTakenOrAfterStop) {
    WorkerPool pool(2, 2, 0);
    Blocker first(pool);
    EXPECT_TRUE(pool.run_here([] {}));
    Blocker second(pool);
    const auto fail = [] { FAIL() << "ran"; };
    EXPECT_FALSE(pool.run_here(fail));
    first.let_go();
    second.let_go();
    pool.stop();
    EXPECT_FALSE(pool.run_here(fail));
}

TEST(WorkerPool, StopWaitsForWhatRunsHere) {
    WorkerPool pool(1, 1, 0);
    std::latch started(1);
    std::latch release(1);
    std::atomic<bool> finished = false;
    std::thread here([&] {
        EXPECT_TRUE(pool.run_here([&] {
            started.count_down();
            release.wait();
            finished = true;
        }));
    });
    started.wait();
    auto held = std::make_shared<int>(0);
    const std::weak_ptr<int> watch = held;
    ASSERT_TRUE(pool.submit([held = std::move(held)] {}));
    std::thread stopper([&] {
        pool.stop();
        EXPECT_TRUE(finished);
    });
    while (!watch.expired()) std::this_thread::yield();
    EXPECT_FALSE(finished);
    release.count_down();
    stopper.join();
    here.join();
}

TEST(WorkerPool, NiceThreadsGiveWayToTheOthers) {
    const int ours = ::getpriority(PRIO_PROCESS, 0);
    for (const int niceness : {0, 1}) {
        WorkerPool pool(1, 1, niceness);
        std::promise<int> theirs;
        ASSERT_TRUE(
            pool.submit([&] { theirs.set_value(::getpriority(PRIO_PROCESS, 0)); }));
        EXPECT_EQ(theirs.get_future().get(), std::min(ours + niceness, 19));
    }
    EXPECT_EQ(::getpriority(PRIO_PROCESS, 0), ours);
}

TEST(WorkerPool, EveryJobOfManySubmittersRunsOnce) {
    std::vector<std::atomic<int>> counts(4'000);
    {
        WorkerPool pool(4, 4'000, 0);
        std::latch done(4'000);
        std::vector<std::thread> submitters;
        for (int s = 0; s < 4; ++s) {
            submitters.emplace_back([&, s] {
                for (int i = 0; i < 1'000; ++i) {
                    EXPECT_TRUE(pool.submit([&, slot = s * 1'000 + i] {
                        ++counts[static_cast<std::size_t>(slot)];
                        done.count_down();
                    }));
                }
            });
        }
        for (std::thread& submitter : submitters) submitter.join();
        done.wait();
    }
    for (const auto& count : counts) EXPECT_EQ(count, 1);
}

}  // namespace
}  // namespace haarmony::http
