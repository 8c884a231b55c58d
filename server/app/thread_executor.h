// Threads of the daemon for the parallel work of the engine.
//
// Threads  parallel_for() from any thread, several at the same time; the caller works, too,
//          so that nothing waits for a thread to be free.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "engine/core/executor.h"

namespace haarmony::server {

class ThreadExecutor final : public Executor {
  public:
    // So many threads beside the callers. Requires: >= 0.
    explicit ThreadExecutor(int threads);
    // Requires: no call of parallel_for() goes on.
    ~ThreadExecutor() override;
    ThreadExecutor(const ThreadExecutor&) = delete;
    ThreadExecutor& operator=(const ThreadExecutor&) = delete;

    void parallel_for(std::size_t count,
                      const std::function<void(std::size_t)>& work) override;

  private:
    struct Batch {
        Batch(const std::function<void(std::size_t)>& each, std::size_t calls)
            : work(each), count(calls) {}
        const std::function<void(std::size_t)>& work;
        const std::size_t count;
        std::atomic<std::size_t> next{0};
        std::atomic<std::size_t> done{0};
    };

    void serve();
    void take_part(Batch& batch);

    std::mutex mutex_;  // guards batches_ and stopping_
    std::condition_variable wake_;
    std::condition_variable finished_;
    std::deque<std::shared_ptr<Batch>> batches_;  // with calls that nobody has taken
    bool stopping_ = false;
    std::vector<std::thread> threads_;
};

}  // namespace haarmony::server
