// Jobs in tests: waiting for their ends, and types that wait for the test.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "schema/job_store.h"
#include "server/app/job_runner.h"
#include "tests/server/app/collection.h"

namespace haarmony::server {

// The job as it is once it has finished; a job in another state where it does not.
[[nodiscard]] inline schema::Job finished(JobRunner& runner, std::int64_t id) {
    schema::Job last;
    (void)becomes_true([&] {
        const auto job = runner.get(id);
        if (job) last = job.value();
        return job && job->state != schema::JobState::kQueued &&
               job->state != schema::JobState::kRunning;
    });
    return last;
}

// Queues one and waits for its end.
[[nodiscard]] inline schema::Job done(JobRunner& runner,
                                      const std::string& type,
                                      const std::string& request) {
    const auto job = runner.create(type, request);
    return job ? finished(runner, job->id) : schema::Job{};
}

// A job that stays in the middle until the test lets it go.
class Gate {
  public:
    // On the job's thread; returns early when the job is cancelled.
    void pass(JobContext& job) {
        entered_ = true;
        while (!open_ && !job.cancelled()) std::this_thread::yield();
    }
    // The same, deaf to cancellations.
    void pass() {
        entered_ = true;
        while (!open_) std::this_thread::yield();
    }
    [[nodiscard]] bool entered() const {
        return becomes_true([this] { return entered_.load(); });
    }
    void open() { open_ = true; }

  private:
    std::atomic<bool> entered_{false};
    std::atomic<bool> open_{false};
};

}  // namespace haarmony::server
