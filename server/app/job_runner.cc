#include "server/app/job_runner.h"

#include <spdlog/spdlog.h>
#include <sys/resource.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "server/app/log_value.h"

namespace haarmony::server {
namespace {

using schema::JobState;

constexpr int kNiceness = 10;  // as that of the listener's costly threads

double seconds_since(std::chrono::steady_clock::time_point start) {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    // Divided by below; no clock that counts so far is exact to less.
    return std::max(passed.count(), 1e-6);
}

// What the client is told; the log has the rest.
std::string shown(const Error& error) {
    return error.code == ErrorCode::kIo ? "an internal error; the server's log names it"
                                        : error.message;
}

std::string result_of(const JobContext& context, double seconds, std::int64_t seen) {
    nlohmann::json result{{"seconds", seconds},
                          {"rate", static_cast<double>(seen) / seconds}};
    for (const auto& [name, value] : context.notes()) result[name] = value;
    return result.dump();
}

}  // namespace

Result<std::unique_ptr<JobRunner>> JobRunner::start(const JobRunnerOptions& options,
                                                    JobTypes types) {
    const auto open = [&] {
        return Connection::open(options.database_path,
                                schema::Database::Mode::kReadWriteCreate);
    };
    auto worker = open();
    if (!worker) return std::move(worker).error();
    auto writer = open();
    if (!writer) return std::move(writer).error();
    const Result<std::int64_t> again = worker.value()->jobs().requeue_running();
    if (!again) return again.error();
    if (*again > 0) spdlog::info("event=jobs_taken_up_again count={}", *again);
    std::unique_ptr<JobRunner> runner(new JobRunner(
        options, std::move(types), std::move(worker).value(), std::move(writer).value()));
    runner->thread_ = std::thread([raw = runner.get()] {
        // Of this thread and of those that it starts: searches go before jobs.
        ::setpriority(PRIO_PROCESS, 0, ::getpriority(PRIO_PROCESS, 0) + kNiceness);
        raw->work();
    });
    return runner;
}

JobRunner::JobRunner(const JobRunnerOptions& options,
                     JobTypes types,
                     std::unique_ptr<Connection> worker,
                     std::unique_ptr<Connection> writer)
    : options_(options),
      types_(std::move(types)),
      worker_(std::move(worker)),
      writer_(std::move(writer)),
      readers_([path = options.database_path] {
          return Connection::open(path, schema::Database::Mode::kReadOnly);
      }) {}

JobRunner::~JobRunner() { stop(); }

void JobRunner::stop() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
        stop_job_ = true;
    }
    wake_.notify_all();
    if (thread_.joinable()) thread_.join();
}

template <typename Work>
auto JobRunner::read(Work&& work) {
    using Answer = decltype(work(std::declval<schema::JobStore&>()));
    auto connection = readers_.lend();
    if (!connection) return Answer(connection.error());
    return work((*connection)->jobs());
}

Result<schema::Job> JobRunner::create(std::string_view type, std::string_view request) {
    if (!types_.contains(type))
        return Error{ErrorCode::kInvalidArgument,
                     "there is no job type '" + std::string(type) + "'",
                     "type"};
    Result<schema::Job> job = [&] {
        const std::lock_guard lock(writer_mutex_);
        return writer_->jobs().create(type, request);
    }();
    if (!job) return job;
    {
        const std::lock_guard lock(mutex_);
        queued_ = true;
    }
    wake_.notify_all();
    return job;
}

Result<schema::Job> JobRunner::get(std::int64_t id) {
    return read([&](schema::JobStore& jobs) { return jobs.get(id); });
}

Result<std::vector<schema::Job>> JobRunner::list(int limit,
                                                 std::optional<std::int64_t> after) {
    return read([&](schema::JobStore& jobs) { return jobs.list(limit, after); });
}

Result<schema::Job> JobRunner::cancel(std::int64_t id) {
    Result<schema::Job> job = [&] {
        const std::lock_guard lock(writer_mutex_);
        return writer_->jobs().cancel(id);
    }();
    if (!job) return job;
    if (job->state == JobState::kCancelled) tell_ended(*job);
    if (job->state != JobState::kRunning) return job;
    // run_next() sets running_ before the job is "running" in the table.
    const std::lock_guard lock(mutex_);
    if (running_ && running_->id == id) {
        running_->cancelled = true;
        stop_job_ = true;
    }
    return job;
}

Result<std::optional<std::string>> JobRunner::last_done(std::string_view type) {
    const Result<std::vector<schema::Job>> jobs =
        list(2 * schema::kMaxFinishedJobs, std::nullopt);
    if (!jobs) return jobs.error();
    std::optional<std::string> last;
    // RFC 3339 in UTC sorts as text.
    for (const schema::Job& job : jobs.value())
        if (job.type == type && job.state == JobState::kDone &&
            (!last || job.finished_at > *last))
            last = job.finished_at;
    return last;
}

std::optional<JobPace> JobRunner::pace(const schema::Job& job) const {
    const std::lock_guard lock(mutex_);
    if (job.state != JobState::kRunning || !running_ || running_->id != job.id) return {};
    JobPace pace;
    pace.rate = static_cast<double>(job.counts.seen - running_->seen_before) /
                seconds_since(running_->since);
    if (job.total >= 0 && pace.rate > 0)
        pace.eta_s =
            static_cast<double>(std::max<std::int64_t>(0, job.total - job.counts.seen)) /
            pace.rate;
    return pace;
}

void JobRunner::work() {
    bool failing = false;
    for (;;) {
        const Result<bool> ran = run_next();
        if (!ran && !failing)
            spdlog::error("event=jobs_failed reason={}", log_value(ran.error().message));
        failing = !ran;
        if (failing) {
            if (!wait(options_.retry_interval)) return;
            continue;
        }
        std::unique_lock lock(mutex_);
        if (!*ran) wake_.wait(lock, [this] { return stopping_ || queued_; });
        if (stopping_) return;
    }
}

bool JobRunner::wait(std::chrono::milliseconds period) {
    std::unique_lock lock(mutex_);
    return !wake_.wait_for(lock, period, [this] { return stopping_; });
}

Result<bool> JobRunner::run_next() {
    {
        // Before the look at the table: what is queued after it wakes the thread again.
        const std::lock_guard lock(mutex_);
        queued_ = false;
    }
    schema::JobStore& jobs = worker_->jobs();
    Result<std::optional<schema::Job>> next = jobs.next_queued();
    if (!next) return std::move(next).error();
    if (!*next) return false;
    schema::Job job = **std::move(next);
    const auto type = types_.find(job.type);
    if (type == types_.end() || !type->second.resumes) {
        job.counts = {};
        job.errors.clear();
    }
    {
        const std::lock_guard lock(mutex_);
        if (stopping_) return false;
        running_ = Running{job.id, job.counts.seen, Clock::now()};
        stop_job_ = false;
    }
    const Result<void> started = jobs.start(job.id);
    if (started) {
        JobContext context(
            *worker_, std::move(job), stop_job_, options_.progress_interval);
        run(context);
    }
    {
        const std::lock_guard lock(mutex_);
        running_.reset();
    }
    // Cancelled since it was read.
    if (!started && started.error().code != ErrorCode::kConflict) return started.error();
    return true;
}

void JobRunner::run(JobContext& context) {
    const schema::Job& job = context.job();
    spdlog::info("event=job_started id={} type={} position={}",
                 job.id,
                 log_value(job.type),
                 log_value(job.position));
    const auto type = types_.find(job.type);
    if (type == types_.end()) {
        finish(context,
               Error{ErrorCode::kInvalidArgument,
                     "there is no job type '" + job.type + "'",
                     "type"});
        return;
    }
    finish(context, type->second.run(context));
}

void JobRunner::finish(JobContext& context, const Result<void>& outcome) {
    const schema::Job& job = context.job();
    const Running running = [this] {
        const std::lock_guard lock(mutex_);
        return *running_;
    }();
    std::vector<std::string> errors = job.errors;
    JobState state = JobState::kDone;
    if (!outcome) {
        state = JobState::kFailed;
        // What ended it is always told.
        if (errors.size() == schema::kMaxJobErrors) errors.pop_back();
        errors.push_back(shown(outcome.error()));
        spdlog::error("event=job_failed id={} type={} reason={}",
                      job.id,
                      log_value(job.type),
                      log_value(outcome.error().message));
    } else if (context.was_interrupted()) {
        state = running.cancelled ? JobState::kCancelled : JobState::kRunning;
    }
    const double seconds = seconds_since(running.since);
    insist([&] { return context.write(); });
    if (state != JobState::kRunning) {
        const std::string result =
            result_of(context, seconds, job.counts.seen - running.seen_before);
        insist([&] { return worker_->jobs().finish(job.id, state, result, errors); });
        tell_ended(job);
    }
    spdlog::info("event={} id={} type={} state={} seen={} failed={} seconds={:.3f}",
                 state == JobState::kRunning ? "job_interrupted" : "job_finished",
                 job.id,
                 log_value(job.type),
                 schema::word_of(state),
                 job.counts.seen,
                 job.counts.failed,
                 seconds);
}

void JobRunner::tell_ended(const schema::Job& job) const {
    const auto type = types_.find(job.type);
    if (type != types_.end() && type->second.ended) type->second.ended(job);
}

void JobRunner::insist(const std::function<Result<void>()>& write) {
    for (bool failing = false;; failing = true) {
        const Result<void> written = write();
        if (written) return;
        if (!failing)
            spdlog::error("event=jobs_failed reason={}",
                          log_value(written.error().message));
        const bool passes = written.error().code == ErrorCode::kIo ||
                            written.error().code == ErrorCode::kUnavailable;
        if (!passes || !wait(options_.retry_interval)) return;
    }
}

}  // namespace haarmony::server
