// What a job works with while it runs: what was asked for, what it has done so far, and
// whether it should stop.
//
//   job_runner -> [job_context] -> reindex_job, find_duplicates_job, ingest_job
//
// A job tells its progress as often as it likes; it is written now and then. Counts, errors
// and position are written together, so that a job that goes on after a crash repeats a
// moment's work, counted once.
//
// Errors  none: a progress that cannot be written is logged, and written later.
// Threads the job's; stop_flag() may be read from any.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "schema/job_store.h"
#include "server/app/connection.h"

namespace haarmony::server {

class JobContext {
  public:
    // Requires: all of them outlive it.
    JobContext(Connection& connection,
               schema::Job job,
               const std::atomic<bool>& stop,
               std::chrono::milliseconds interval);

    [[nodiscard]] const std::string& request() const { return job_.request; }
    // Reads and writes; nobody else uses it while the job runs.
    [[nodiscard]] Connection& connection() { return connection_; }

    // Where an earlier run ended; empty for the first.
    [[nodiscard]] const std::string& position() const { return job_.position; }
    void set_position(std::string position) { job_.position = std::move(position); }

    [[nodiscard]] schema::JobCounts& counts() { return job_.counts; }
    void set_total(std::int64_t total) { job_.total = total; }
    // Keeps the message, if it is one of the first. Does not count.
    void add_error(std::string message);
    // One more of which nothing came.
    void fail(std::string message);
    // A member of the result.
    void note(std::string name, std::int64_t value);

    // Writes what has been done unless it was written a moment ago.
    // Requires: no transaction is open on the connection.
    void progress();
    [[nodiscard]] Result<void> write();

    // Whether to end now: the job was cancelled, or the daemon stops. It remembers that it
    // said so: what ends after that has not finished.
    [[nodiscard]] bool cancelled();
    [[nodiscard]] const std::atomic<bool>& stop_flag() const { return stop_; }
    [[nodiscard]] bool was_interrupted() const { return interrupted_; }

    [[nodiscard]] const schema::Job& job() const { return job_; }
    [[nodiscard]] const std::vector<std::pair<std::string, std::int64_t>>& notes() const {
        return notes_;
    }

  private:
    using Clock = std::chrono::steady_clock;

    Connection& connection_;
    schema::Job job_;
    const std::atomic<bool>& stop_;
    const std::chrono::milliseconds interval_;
    std::vector<std::pair<std::string, std::int64_t>> notes_;
    Clock::time_point next_write_{};
    bool interrupted_ = false;
};

}  // namespace haarmony::server
