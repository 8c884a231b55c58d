#include "server/api/job_json.h"

#include <nlohmann/json.hpp>
#include <optional>

namespace haarmony::server {
namespace {

using nlohmann::json;

json text_or_null(const std::string& text) { return text.empty() ? json() : json(text); }

// The table holds nothing but JSON objects.
json parsed(const std::string& text) { return json::parse(text, nullptr, false); }

}  // namespace

json job_json(const schema::Job& job, const JobRunner& runner) {
    const schema::JobCounts& counts = job.counts;
    json result = parsed(job.result);
    json rate = result.contains("rate") ? result["rate"] : json();
    json eta_s;
    if (const std::optional<JobPace> pace = runner.pace(job)) {
        rate = pace->rate;
        if (pace->eta_s) eta_s = *pace->eta_s;
    }
    json video;
    if (result.contains("video")) video = result["video"];
    json object{{"id", job.id},
                {"type", job.type},
                {"state", schema::word_of(job.state)},
                {"request", parsed(job.request)},
                {"counts",
                 {{"seen", counts.seen},
                  {"added", counts.added},
                  {"updated", counts.updated},
                  {"skipped", counts.skipped},
                  {"failed", counts.failed}}},
                {"total", job.total < 0 ? json() : json(job.total)},
                {"rate", std::move(rate)},
                {"eta_s", std::move(eta_s)},
                {"errors", job.errors},
                {"result", std::move(result)},
                {"cancel_requested", job.cancel_requested},
                {"created_at", text_or_null(job.created_at)},
                {"started_at", text_or_null(job.started_at)},
                {"finished_at", text_or_null(job.finished_at)}};
    if (!video.is_null()) object["video"] = std::move(video);
    return object;
}

std::string job_address(std::int64_t id) { return "/jobs/" + std::to_string(id); }

}  // namespace haarmony::server
