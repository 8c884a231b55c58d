// Long-running jobs in the database, so that they survive a restart of the daemon.
//
//   create -> queued --start--> running --finish--> done, failed or cancelled
//                ^ |               |
//                | '-cancel        '-cancel: asked for, until the job finishes
//                '---- requeue_running ----'
//
// Errors   kNotFound for an unknown id; kConflict for a step that the job's state forbids,
//          naming it; kInvalidArgument for a value that the table refuses (a type that is not
//          1 to 64 characters, a request or result that is no JSON object, a negative count);
//          kUnavailable and kIo as in image_store.h.
// Threads  as Database; never inside ImageStore::transaction().
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "schema/database.h"

namespace haarmony::schema {

enum class JobState { kQueued, kRunning, kDone, kFailed, kCancelled };

// The word that stands in the table: "queued", "running", "done", "failed", "cancelled".
[[nodiscard]] std::string_view word_of(JobState state);

struct JobCounts {
    std::int64_t seen = 0;
    std::int64_t added = 0;
    std::int64_t updated = 0;
    std::int64_t skipped = 0;
    std::int64_t failed = 0;
    bool operator==(const JobCounts&) const = default;
};

// The first so many errors of a job are kept.
inline constexpr std::size_t kMaxJobErrors = 20;

// So many finished jobs are kept, those that finished last.
inline constexpr int kMaxFinishedJobs = 1000;

struct Job {
    std::int64_t id = 0;  // >= 1, never used again
    std::string type;
    std::string request;  // a JSON object, as it came
    JobState state = JobState::kQueued;
    JobCounts counts;
    std::int64_t total = -1;  // how many there are to see; -1: not known
    std::string position;     // where to go on after a restart; the job's own business
    std::string result;       // a JSON object; "{}" until it has finished
    std::vector<std::string> errors;
    bool cancel_requested = false;
    std::string created_at;   // RFC 3339, UTC
    std::string started_at;   // the last start; empty before
    std::string finished_at;  // empty before
};

class JobStore {
  public:
    explicit JobStore(Database& database) : cache_(database.handle()) {}

    [[nodiscard]] Result<Job> create(std::string_view type, std::string_view request);
    [[nodiscard]] Result<Job> get(std::int64_t id);
    // The newest first, at most `limit` (>= 1), only ids below `after`.
    [[nodiscard]] Result<std::vector<Job>> list(int limit,
                                                std::optional<std::int64_t> after);
    // The one that has waited longest.
    [[nodiscard]] Result<std::optional<Job>> next_queued();

    // A queued job is running.
    [[nodiscard]] Result<void> start(std::int64_t id);
    // What a running job has done so far; replaces what was there.
    [[nodiscard]] Result<void> progress(std::int64_t id,
                                        const JobCounts& counts,
                                        std::int64_t total,
                                        std::string_view position,
                                        std::span<const std::string> errors);
    // Requires: `state` is kDone, kFailed or kCancelled. `errors` replace what was there.
    [[nodiscard]] Result<void> finish(std::int64_t id,
                                      JobState state,
                                      std::string_view result,
                                      std::span<const std::string> errors);

    // A queued job is cancelled at once; of a running one it is asked for. Returns the job
    // as it is now; kConflict for a finished one.
    [[nodiscard]] Result<Job> cancel(std::int64_t id);
    [[nodiscard]] Result<bool> cancel_requested(std::int64_t id);

    // When the daemon starts: what ran when it died waits again, with its counts, errors
    // and position; where a cancellation had been asked for, it is cancelled. How many wait
    // again.
    [[nodiscard]] Result<std::int64_t> requeue_running();

  private:
    StatementCache cache_;
};

}  // namespace haarmony::schema
