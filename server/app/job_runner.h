// Does the long work of the daemon: takes the queued jobs one after the other, on a thread
// of its own, and keeps what they do in the database.
//
//   server/api/jobs -> [job_runner] -> job_context -> reindex_job, ...
//                           '--> schema/job_store
//
// A job that runs when the daemon stops, or dies, is taken up again at the next start.
//
// Errors  start(): as Connection::open. create(): kInvalidArgument for an unknown type. The
//         rest as JobStore. Where the database fails the runner logs it and tries again.
// Threads every member from any thread.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "engine/core/result.h"
#include "schema/job_store.h"
#include "server/app/connection.h"
#include "server/app/job_context.h"

namespace haarmony::server {

struct JobType {
    // Asks cancelled() often and returns when it says so. An error ends the job as failed.
    std::function<Result<void>(JobContext&)> run;
    // Whether run() goes on at the context's position; else what earlier runs counted is
    // forgotten, and only their position is there.
    bool resumes = false;
    // Hears of a job that has ended in whatever way, also one that never ran, after its row
    // says so: the place to throw away what was kept for it. From any thread.
    std::function<void(const schema::Job&)> ended = {};
};
using JobTypes = std::map<std::string, JobType, std::less<>>;

struct JobRunnerOptions {
    std::string database_path;
    std::chrono::milliseconds progress_interval{200};
    std::chrono::milliseconds retry_interval{500};  // after the database failed
};

// How fast a job is, in things seen a second.
struct JobPace {
    double rate = 0;
    std::optional<double> eta_s;  // unknown while the total is
};

class JobRunner {
  public:
    // The database must exist.
    [[nodiscard]] static Result<std::unique_ptr<JobRunner>> start(
        const JobRunnerOptions& options,
        JobTypes types);
    ~JobRunner();
    JobRunner(const JobRunner&) = delete;
    JobRunner& operator=(const JobRunner&) = delete;

    // `request` is a JSON object that the type understands.
    [[nodiscard]] Result<schema::Job> create(std::string_view type,
                                             std::string_view request);
    [[nodiscard]] Result<schema::Job> get(std::int64_t id);
    [[nodiscard]] Result<std::vector<schema::Job>> list(
        int limit,
        std::optional<std::int64_t> after);
    [[nodiscard]] Result<schema::Job> cancel(std::int64_t id);
    // When the last job of that type that is done had finished.
    [[nodiscard]] Result<std::optional<std::string>> last_done(std::string_view type);
    // Of the job that runs now, by what it has just told; nothing for any other.
    [[nodiscard]] std::optional<JobPace> pace(const schema::Job& job) const;

    // The running job ends soon and stays "running" in the database.
    void stop();

  private:
    using Clock = std::chrono::steady_clock;

    struct Running {
        std::int64_t id = 0;
        std::int64_t seen_before = 0;  // by earlier runs
        Clock::time_point since;
        bool cancelled = false;
    };

    JobRunner(const JobRunnerOptions& options,
              JobTypes types,
              std::unique_ptr<Connection> worker,
              std::unique_ptr<Connection> writer);

    void work();
    // False: no job waits.
    [[nodiscard]] Result<bool> run_next();
    void run(JobContext& context);
    void finish(JobContext& context, const Result<void>& outcome);
    void tell_ended(const schema::Job& job) const;
    // Tries until the database takes it, or the daemon stops.
    void insist(const std::function<Result<void>()>& write);
    [[nodiscard]] bool wait(std::chrono::milliseconds period);  // false: time to stop
    template <typename Work>
    auto read(Work&& work);

    const JobRunnerOptions options_;
    const JobTypes types_;
    std::unique_ptr<Connection> worker_;  // the thread's

    std::mutex writer_mutex_;  // guards writer_
    std::unique_ptr<Connection> writer_;
    ReadConnections readers_;

    mutable std::mutex mutex_;  // guards the four below
    std::condition_variable wake_;
    std::optional<Running> running_;
    bool queued_ = true;
    bool stopping_ = false;
    std::atomic<bool> stop_job_{false};  // written under mutex_

    std::thread thread_;
};

}  // namespace haarmony::server
