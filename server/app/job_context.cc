#include "server/app/job_context.h"

#include <spdlog/spdlog.h>

#include <utility>

#include "server/app/log_value.h"

namespace haarmony::server {

JobContext::JobContext(Connection& connection,
                       schema::Job job,
                       const std::atomic<bool>& stop,
                       std::chrono::milliseconds interval)
    : connection_(connection), job_(std::move(job)), stop_(stop), interval_(interval) {}

void JobContext::add_error(std::string message) {
    if (job_.errors.size() < schema::kMaxJobErrors)
        job_.errors.push_back(std::move(message));
}

void JobContext::fail(std::string message) {
    ++job_.counts.failed;
    add_error(std::move(message));
}

void JobContext::note(std::string name, std::int64_t value) {
    notes_.emplace_back(std::move(name), value);
}

void JobContext::progress() {
    const Clock::time_point now = Clock::now();
    if (now < next_write_) return;
    next_write_ = now + interval_;
    if (const Result<void> written = write(); !written)
        spdlog::warn("event=job_progress_not_written id={} reason={}",
                     job_.id,
                     log_value(written.error().message));
}

Result<void> JobContext::write() {
    return connection_.jobs().progress(
        job_.id, job_.counts, job_.total, job_.position, job_.errors);
}

bool JobContext::cancelled() {
    if (stop_) interrupted_ = true;
    return interrupted_;
}

}  // namespace haarmony::server
