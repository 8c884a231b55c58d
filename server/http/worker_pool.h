// A fixed number of threads with a bounded queue: when it is full, work is refused rather
// than piled up.
//
// Threads  every member from any thread; stop() and run_here() not from a job.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace haarmony::http {

class WorkerPool {
  public:
    using Job = std::function<void()>;
    using Ticket = std::uint64_t;

    // At least one thread and one place in the queue, whatever is asked for. `niceness` is
    // added to the priority of its threads and of what they start: 0 for none, 19 at most.
    WorkerPool(int threads, int queue_limit, int niceness);
    ~WorkerPool();
    WorkerPool(const WorkerPool&) = delete;
    WorkerPool& operator=(const WorkerPool&) = delete;

    // Jobs start in the order of their submission and must not throw. Nothing if
    // `queue_limit` jobs wait already, or after discard().
    [[nodiscard]] std::optional<Ticket> submit(Job job);

    // Runs the job on the calling thread, which counts as one of the pool's meanwhile: no
    // thread has to be woken for it. False, and nothing done, if as many jobs run as the
    // pool has threads, if others wait already, or after discard().
    [[nodiscard]] bool run_here(const Job& job);

    // Destroys the job without running it. False if it has started already.
    bool cancel(Ticket ticket);

    // Takes no more and destroys what is queued. A job learns that it is never going to run
    // by the destructors of what it holds.
    void discard();
    // discard(), then waits for what runs.
    void stop();

    [[nodiscard]] std::size_t queued() const;

  private:
    void work(int niceness);
    void finish_one(std::unique_lock<std::mutex>& lock);

    const int most_running_;
    const std::size_t queue_limit_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::map<Ticket, Job> queue_;  // guarded by mutex_; the oldest first
    Ticket next_ = 0;              // guarded by mutex_
    int running_ = 0;              // guarded by mutex_; jobs, here and on the threads
    bool stopping_ = false;        // guarded by mutex_
    std::vector<std::thread> threads_;
};

}  // namespace haarmony::http
