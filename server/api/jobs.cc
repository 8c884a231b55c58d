#include "server/api/jobs.h"

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "server/api/image_id.h"
#include "server/api/inputs.h"
#include "server/api/job_json.h"
#include "server/api/job_request.h"
#include "server/api/list_page.h"
#include "server/http/json.h"

namespace haarmony::server {
namespace {

using nlohmann::json;
using schema::JobState;

http::Response fresh(int status, const json& body) {
    http::Response response = http::json_response(status, body);
    response.headers["Cache-Control"] = "no-store";
    return response;
}

Outcome<std::int64_t> job_id_of(const http::Request& request) {
    auto id = image_id_of(request);
    if (!id) return id.problem();
    return to_int(*id);
}

// One job as a stream of events. Pulled by one thread at a time (http::ChunkSource).
class JobEvents {
  public:
    JobEvents(JobRunner& runner, std::int64_t id) : runner_(runner), id_(id) {}

    std::optional<std::string> next() {
        if (ended_) return {};
        const Result<schema::Job> job = runner_.get(id_);
        // Too old to be kept while somebody was looking, or the database fails: the client
        // asks again and hears the reason.
        if (!job) return {};
        const bool finished =
            job->state != JobState::kQueued && job->state != JobState::kRunning;
        ended_ = finished;
        json object = job_json(job.value(), runner_);
        // These two change with every look at the clock.
        json compared = object;
        compared.erase("rate");
        compared.erase("eta_s");
        if (!finished && compared == last_) return silence();
        last_ = std::move(compared);
        silent_since_ = Clock::now();
        const std::string text =
            object.dump(-1, ' ', false, json::error_handler_t::replace);
        return std::string(finished ? "event: end" : "event: progress") +
               "\ndata: " + text + "\n\n";
    }

  private:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::seconds kHeartbeat{15};

    // Proxies drop connections on which nothing is said.
    std::string silence() {
        if (Clock::now() - silent_since_ < kHeartbeat) return {};
        silent_since_ = Clock::now();
        return ": still here\n\n";
    }

    JobRunner& runner_;
    const std::int64_t id_;
    json last_;
    Clock::time_point silent_since_ = Clock::now();
    bool ended_ = false;
};

}  // namespace

Reply post_job(const Context& context, const http::Request& request) {
    auto inputs = Inputs::of_request(request);
    if (!inputs) return inputs.problem();
    const JobRequest wanted = read_job_request(context, *inputs);
    if (const auto problem = inputs->refused()) return *problem;
    const auto job = context.jobs.create(wanted.type, wanted.request);
    if (!job) return job.error();
    http::Response response = fresh(202, job_json(job.value(), context.jobs));
    response.headers["Location"] = job_address(job->id);
    return response;
}

Reply list_jobs(const Context& context, const http::Request& request) {
    auto inputs = Inputs::of_query(request);
    if (!inputs) return inputs.problem();
    const ListPlace place = ListPlace::read(*inputs);
    if (const auto problem = inputs->refused()) return *problem;
    const auto jobs = context.jobs.list(place.fetched(), place.cursor);
    if (!jobs) return jobs.error();
    return fresh(200, list_page(*jobs, place, [&](const schema::Job& job) {
                     return job_json(job, context.jobs);
                 }));
}

Reply get_job(const Context& context, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    auto id = job_id_of(request);
    if (!id) return id.problem();
    const auto job = context.jobs.get(*id);
    if (!job) return job.error();
    return fresh(200, job_json(job.value(), context.jobs));
}

Reply get_job_events(const Context& context, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    auto id = job_id_of(request);
    if (!id) return id.problem();
    if (const auto job = context.jobs.get(*id); !job) return job.error();
    http::Response response;
    response.headers["Content-Type"] = "text/event-stream";
    response.headers["Cache-Control"] = "no-store";
    const auto events = std::make_shared<JobEvents>(context.jobs, *id);
    response.body = http::ChunkSource([events] { return events->next(); });
    return response;
}

Reply delete_job(const Context& context, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    auto id = job_id_of(request);
    if (!id) return id.problem();
    const auto job = context.jobs.cancel(*id);
    if (!job) return job.error();
    return fresh(200, job_json(job.value(), context.jobs));
}

}  // namespace haarmony::server
