#include "schema/job_store.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "schema/sqlite_error.h"
#include "schema/write_scope.h"

namespace haarmony::schema {
namespace {

constexpr std::array<std::string_view, 5> kStateWords = {"queued",
                                                         "running",
                                                         "done",
                                                         "failed",
                                                         "cancelled"};

// The table allows no other words than these.
JobState state_of(std::string_view word) {
    const auto found = std::find(kStateWords.begin(), kStateWords.end(), word);
    assert(found != kStateWords.end());
    return static_cast<JobState>(found - kStateWords.begin());
}

bool is_finished(JobState state) {
    return state != JobState::kQueued && state != JobState::kRunning;
}

// A job with several errors is several rows, with none one row without a message.
constexpr std::string_view kColumns =
    "SELECT jobs.id, type, request, state, cancel_requested, seen, added, updated,"
    " skipped, failed, total, position, result, created_at, started_at, finished_at,"
    " message FROM jobs LEFT JOIN job_errors ON job_errors.job_id = jobs.id";
constexpr int kMessage = 16;

Job job_of(const Statement& row) {
    Job job;
    job.id = row.integer(0);
    job.type = row.text(1);
    job.request = row.text(2);
    job.state = state_of(row.text(3));
    job.cancel_requested = row.integer(4) != 0;
    job.counts = {
        row.integer(5), row.integer(6), row.integer(7), row.integer(8), row.integer(9)};
    job.total = row.integer(10);
    job.position = row.text(11);
    job.result = row.text(12);
    job.created_at = row.text(13);
    job.started_at = row.text(14);
    job.finished_at = row.text(15);
    return job;
}

// Requires: the rows of a job follow one another, in the order of its errors.
Result<std::vector<Job>> collect(Statement& statement) {
    std::vector<Job> jobs;
    for (;;) {
        const Result<bool> row = statement.step();
        if (!row) return row.error();
        if (!*row) return jobs;
        if (jobs.empty() || jobs.back().id != statement.integer(0)) {
            jobs.push_back(job_of(statement));
        }
        if (!statement.is_null(kMessage)) {
            jobs.back().errors.emplace_back(statement.text(kMessage));
        }
    }
}

constexpr std::string_view kCreate =
    "INSERT INTO jobs (type, request, state, cancel_requested, seen, added, updated,"
    " skipped, failed, total, position, result, created_at, started_at, finished_at)"
    " VALUES (?1, ?2, 'queued', 0, 0, 0, 0, 0, 0, -1, '', '{}',"
    " strftime('%Y-%m-%dT%H:%M:%fZ', 'now'), '', '') RETURNING id";

constexpr std::string_view kStart =
    "UPDATE jobs SET state = 'running',"
    " started_at = strftime('%Y-%m-%dT%H:%M:%fZ', 'now') WHERE id = ?1";

constexpr std::string_view kProgress =
    "UPDATE jobs SET seen = ?2, added = ?3, updated = ?4, skipped = ?5, failed = ?6,"
    " total = ?7, position = ?8 WHERE id = ?1";

constexpr std::string_view kFinish =
    "UPDATE jobs SET state = ?2, result = ?3, cancel_requested = 0,"
    " finished_at = strftime('%Y-%m-%dT%H:%M:%fZ', 'now') WHERE id = ?1";

constexpr std::string_view kAskToCancel =
    "UPDATE jobs SET cancel_requested = 1 WHERE id = ?1";

// By the time of finishing: a long job that ends now is not the first to go.
constexpr std::string_view kPrune =
    "DELETE FROM jobs WHERE id IN (SELECT id FROM jobs WHERE finished_at <> ''"
    " ORDER BY finished_at DESC, id DESC LIMIT -1 OFFSET ?1)";

constexpr std::string_view kCancelAsked =
    "UPDATE jobs SET state = 'cancelled', cancel_requested = 0,"
    " finished_at = strftime('%Y-%m-%dT%H:%M:%fZ', 'now')"
    " WHERE state = 'running' AND cancel_requested = 1";

constexpr std::string_view kRequeue =
    "UPDATE jobs SET state = 'queued' WHERE state = 'running' RETURNING id";

std::string job_name(std::int64_t id) { return "job " + std::to_string(id); }

Error no_such_job(std::int64_t id) {
    return Error{ErrorCode::kNotFound, "no " + job_name(id), "id"};
}

Error wrong_state(std::int64_t id, JobState state, std::string_view needed) {
    return Error{ErrorCode::kConflict,
                 job_name(id) + " is " + std::string(word_of(state)) + ", not " +
                     std::string(needed)};
}

Result<Job> read_job(StatementCache& cache, std::int64_t id) {
    static const std::string sql =
        std::string(kColumns) + " WHERE jobs.id = ?1 ORDER BY number";
    auto statement = cache.borrow(sql);
    if (!statement) return std::move(statement).error();
    (*statement)->bind(1, id);
    Result<std::vector<Job>> jobs = collect(**statement);
    if (!jobs) return std::move(jobs).error();
    if (jobs->empty()) return no_such_job(id);
    return std::move(jobs->front());
}

Result<JobState> state_of_job(StatementCache& cache, std::int64_t id) {
    auto statement = cache.borrow("SELECT state FROM jobs WHERE id = ?1");
    if (!statement) return std::move(statement).error();
    (*statement)->bind(1, id);
    const Result<bool> row = (*statement)->step();
    if (!row) return row.error();
    if (!*row) return no_such_job(id);
    return state_of((*statement)->text(0));
}

Result<void> need_state(StatementCache& cache, std::int64_t id, JobState needed) {
    const Result<JobState> state = state_of_job(cache, id);
    if (!state) return state.error();
    if (*state != needed) return wrong_state(id, *state, word_of(needed));
    return {};
}

Result<void> store_errors(StatementCache& cache,
                          std::int64_t id,
                          std::span<const std::string> errors) {
    Result<void> cleared = cache.run("DELETE FROM job_errors WHERE job_id = ?1", id);
    if (!cleared) return cleared;
    auto statement = cache.borrow(
        "INSERT INTO job_errors (job_id, number, message) VALUES (?1, ?2, ?3)");
    if (!statement) return std::move(statement).error();
    const std::size_t count = std::min(errors.size(), kMaxJobErrors);
    for (std::size_t number = 0; number < count; ++number) {
        (*statement)->reset();
        (*statement)->bind(1, id);
        (*statement)->bind(2, static_cast<std::int64_t>(number));
        (*statement)->bind(3, errors[number]);
        Result<void> stored = (*statement)->run();
        if (!stored) return stored;
    }
    return {};
}

Result<void> store_end(StatementCache& cache,
                       std::int64_t id,
                       JobState state,
                       std::string_view result) {
    {
        auto statement = cache.borrow(kFinish);
        if (!statement) return std::move(statement).error();
        (*statement)->bind(1, id);
        (*statement)->bind(2, word_of(state));
        (*statement)->bind(3, result);
        Result<void> stored = (*statement)->run();
        if (!stored) return stored;
    }
    return cache.run(kPrune, kMaxFinishedJobs);
}

Result<std::int64_t> requeue(StatementCache& cache) {
    auto statement = cache.borrow(kRequeue);
    if (!statement) return std::move(statement).error();
    std::int64_t count = 0;
    for (;;) {
        const Result<bool> row = (*statement)->step();
        if (!row) return row.error();
        if (!*row) return count;
        ++count;
    }
}

}  // namespace

std::string_view word_of(JobState state) {
    return kStateWords[static_cast<std::size_t>(state)];
}

Result<Job> JobStore::create(std::string_view type, std::string_view request) {
    const auto failed = [&](Error error) {
        return while_doing("cannot create a job \"" + std::string(type) + '"',
                           std::move(error));
    };
    Result<WriteScope> scope = WriteScope::begin(cache_, WriteScope::Kind::kTransaction);
    if (!scope) return failed(std::move(scope).error());
    std::int64_t id = 0;
    {
        auto statement = cache_.borrow(kCreate);
        if (!statement) return failed(std::move(statement).error());
        (*statement)->bind(1, type);
        (*statement)->bind(2, request);
        const auto created = (*statement)->run_returning();
        if (!created) return failed(created.error());
        id = created->value();
    }
    Result<Job> job = read_job(cache_, id);
    if (!job) return failed(std::move(job).error());
    Result<void> committed = scope->commit();
    if (!committed) return failed(std::move(committed).error());
    return job;
}

Result<Job> JobStore::get(std::int64_t id) {
    Result<Job> job = read_job(cache_, id);
    if (job || job.error().code == ErrorCode::kNotFound) return job;
    return while_doing("cannot read " + job_name(id), std::move(job).error());
}

Result<std::vector<Job>> JobStore::list(int limit, std::optional<std::int64_t> after) {
    assert(limit >= 1);
    static const std::string sql =
        std::string(kColumns) +
        " WHERE jobs.id IN (SELECT id FROM jobs WHERE ?1 IS NULL OR id < ?1"
        " ORDER BY id DESC LIMIT ?2) ORDER BY jobs.id DESC, number";
    const auto failed = [](Error error) {
        return while_doing("cannot list the jobs", std::move(error));
    };
    auto statement = cache_.borrow(sql);
    if (!statement) return failed(std::move(statement).error());
    if (after) (*statement)->bind(1, *after);
    (*statement)->bind(2, limit);
    Result<std::vector<Job>> jobs = collect(**statement);
    if (!jobs) return failed(std::move(jobs).error());
    return jobs;
}

Result<std::optional<Job>> JobStore::next_queued() {
    static const std::string sql =
        std::string(kColumns) +
        " WHERE jobs.id = (SELECT min(id) FROM jobs WHERE state = 'queued')"
        " ORDER BY number";
    const auto failed = [](Error error) {
        return while_doing("cannot find the next job", std::move(error));
    };
    auto statement = cache_.borrow(sql);
    if (!statement) return failed(std::move(statement).error());
    Result<std::vector<Job>> jobs = collect(**statement);
    if (!jobs) return failed(std::move(jobs).error());
    if (jobs->empty()) return std::optional<Job>();
    return std::optional<Job>(std::move(jobs->front()));
}

Result<void> JobStore::start(std::int64_t id) {
    const auto failed = [&](Error error) {
        return while_doing("cannot start " + job_name(id), std::move(error));
    };
    Result<WriteScope> scope = WriteScope::begin(cache_, WriteScope::Kind::kTransaction);
    if (!scope) return failed(std::move(scope).error());
    Result<void> done = need_state(cache_, id, JobState::kQueued);
    if (done) done = cache_.run(kStart, id);
    if (done) done = scope->commit();
    if (!done) return failed(std::move(done).error());
    return {};
}

Result<void> JobStore::progress(std::int64_t id,
                                const JobCounts& counts,
                                std::int64_t total,
                                std::string_view position,
                                std::span<const std::string> errors) {
    const auto failed = [&](Error error) {
        return while_doing("cannot store the progress of " + job_name(id),
                           std::move(error));
    };
    Result<WriteScope> scope = WriteScope::begin(cache_, WriteScope::Kind::kTransaction);
    if (!scope) return failed(std::move(scope).error());
    Result<void> done = need_state(cache_, id, JobState::kRunning);
    if (!done) return failed(std::move(done).error());
    {
        auto statement = cache_.borrow(kProgress);
        if (!statement) return failed(std::move(statement).error());
        (*statement)->bind(1, id);
        (*statement)->bind(2, counts.seen);
        (*statement)->bind(3, counts.added);
        (*statement)->bind(4, counts.updated);
        (*statement)->bind(5, counts.skipped);
        (*statement)->bind(6, counts.failed);
        (*statement)->bind(7, total);
        (*statement)->bind(8, position);
        done = (*statement)->run();
    }
    if (done) done = store_errors(cache_, id, errors);
    if (done) done = scope->commit();
    if (!done) return failed(std::move(done).error());
    return {};
}

Result<void> JobStore::finish(std::int64_t id,
                              JobState state,
                              std::string_view result,
                              std::span<const std::string> errors) {
    assert(is_finished(state));
    const auto failed = [&](Error error) {
        return while_doing("cannot finish " + job_name(id), std::move(error));
    };
    Result<WriteScope> scope = WriteScope::begin(cache_, WriteScope::Kind::kTransaction);
    if (!scope) return failed(std::move(scope).error());
    Result<void> done = need_state(cache_, id, JobState::kRunning);
    if (done) done = store_errors(cache_, id, errors);
    if (done) done = store_end(cache_, id, state, result);
    if (done) done = scope->commit();
    if (!done) return failed(std::move(done).error());
    return {};
}

Result<Job> JobStore::cancel(std::int64_t id) {
    const auto failed = [&](Error error) {
        return while_doing("cannot cancel " + job_name(id), std::move(error));
    };
    Result<WriteScope> scope = WriteScope::begin(cache_, WriteScope::Kind::kTransaction);
    if (!scope) return failed(std::move(scope).error());
    const Result<JobState> state = state_of_job(cache_, id);
    if (!state) return failed(state.error());
    if (is_finished(*state)) return failed(wrong_state(id, *state, "queued or running"));
    Result<void> done = *state == JobState::kQueued
                            ? store_end(cache_, id, JobState::kCancelled, "{}")
                            : cache_.run(kAskToCancel, id);
    if (!done) return failed(std::move(done).error());
    Result<Job> job = read_job(cache_, id);
    if (!job) return failed(std::move(job).error());
    done = scope->commit();
    if (!done) return failed(std::move(done).error());
    return job;
}

Result<bool> JobStore::cancel_requested(std::int64_t id) {
    const auto failed = [&](Error error) {
        return while_doing("cannot read " + job_name(id), std::move(error));
    };
    auto statement = cache_.borrow("SELECT cancel_requested FROM jobs WHERE id = ?1");
    if (!statement) return failed(std::move(statement).error());
    (*statement)->bind(1, id);
    const Result<bool> row = (*statement)->step();
    if (!row) return failed(row.error());
    if (!*row) return no_such_job(id);
    return (*statement)->integer(0) != 0;
}

Result<std::int64_t> JobStore::requeue_running() {
    const auto failed = [](Error error) {
        return while_doing("cannot queue the jobs that were running", std::move(error));
    };
    Result<WriteScope> scope = WriteScope::begin(cache_, WriteScope::Kind::kTransaction);
    if (!scope) return failed(std::move(scope).error());
    Result<void> done = cache_.run(kCancelAsked);
    if (done) done = cache_.run(kPrune, kMaxFinishedJobs);
    if (!done) return failed(std::move(done).error());
    Result<std::int64_t> count = requeue(cache_);
    if (!count) return failed(count.error());
    done = scope->commit();
    if (!done) return failed(std::move(done).error());
    return count;
}

}  // namespace haarmony::schema
