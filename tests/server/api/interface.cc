#include "tests/server/api/interface.h"

#include <ostream>
#include <stdexcept>
#include <utility>

#include "server/api/routes.h"
#include "server/app/job_types.h"
#include "server/http/conditional.h"
#include "server/http/target.h"
#include "tests/schema/raw_sql.h"

namespace haarmony::server {

using nlohmann::json;

Interface::Interface(std::vector<std::string> media_roots, bool allow_url_fetch)
    : allow_url_fetch_(allow_url_fetch) {
    collection.open();
    auto roots = MediaRoots::open(media_roots);
    if (!roots) throw std::runtime_error(roots.error().message);
    media_roots_ = std::move(roots).value();
    const IndexFollower& index = collection.service->index();
    const std::string path = collection.path();
    auto groups = DuplicateGroups::open(path);
    if (!groups) throw std::runtime_error(groups.error().message);
    duplicates = std::move(groups).value();
    auto opened = CurveService::open(path);
    if (!opened) throw std::runtime_error(opened.error().message);
    curves = std::move(opened).value();
    clusters = std::make_unique<ClusterOverview>(path, index, 1);
    VideoServiceOptions showing;
    showing.database_path = path;
    auto shown = VideoService::open(showing);
    if (!shown) throw std::runtime_error(shown.error().message);
    videos = std::move(shown).value();
    frames = std::make_unique<FrameSearch>(path, index.index_m());
    JobRunnerOptions running;
    running.database_path = path;
    running.progress_interval = std::chrono::milliseconds(0);
    auto started = JobRunner::start(running,
                                    job_types(index,
                                              collection.service->snapshots(),
                                              *videos,
                                              {path, media_roots_, 1},
                                              {}));
    if (!started) throw std::runtime_error(started.error().message);
    replace_jobs(std::move(started).value());
}

void Interface::replace_jobs(std::unique_ptr<JobRunner> runner) {
    jobs = std::move(runner);
    context_ = std::make_unique<Context>(Context{*collection.service,
                                                 *jobs,
                                                 *duplicates,
                                                 *clusters,
                                                 *curves,
                                                 *videos,
                                                 *frames,
                                                 media_roots_,
                                                 allow_url_fetch_});
    router_ = std::make_unique<http::Router>();
    add_routes(*context_, *router_);
}

void Interface::sql(const std::string& statement) {
    const schema::RawConnection raw(collection.path());
    schema::run_sql(raw.handle(), "PRAGMA busy_timeout = 5000");
    schema::run_sql(raw.handle(), statement);
}

http::Response Interface::send(const std::string& method,
                               const std::string& target,
                               const http::Headers& headers,
                               const std::string& body) {
    auto parsed = http::parse_target(target);
    if (!parsed) throw std::runtime_error(parsed.error().message);
    http::Request request;
    request.method = method;
    request.path = parsed->path;
    request.query = parsed->query;
    request.headers = headers;
    request.body = body;
    request.request_id = "test";
    http::Response response = router_->dispatch(request);
    http::apply_conditions(request, response);
    return response;
}

std::string body_of(const http::Response& response) {
    const auto* text = std::get_if<std::string>(&response.body);
    return text == nullptr ? std::string() : *text;
}

json json_of(const http::Response& response) {
    json value = json::parse(body_of(response), nullptr, false);
    return value.is_discarded() ? json() : value;
}

std::string header_of(const http::Response& response, const std::string& name) {
    const auto found = response.headers.find(name);
    return found == response.headers.end() ? std::string() : found->second;
}

std::string form_of(const std::vector<FormPart>& parts) {
    std::string body;
    for (const FormPart& part : parts) {
        body += "--frontier\r\nContent-Disposition: form-data; name=\"" + part.name + '"';
        if (!part.file_name.empty()) body += "; filename=\"" + part.file_name + '"';
        body += "\r\n\r\n" + part.body + "\r\n";
    }
    return body + "--frontier--\r\n";
}

Refusal refusal_of(const http::Response& response) {
    const json problem = json_of(response);
    if (!problem.is_object()) return {response.status, "", ""};
    return {response.status, problem.value("code", ""), problem.value("param", "")};
}

std::ostream& operator<<(std::ostream& out, const Refusal& refusal) {
    return out << refusal.status << ' ' << refusal.code << " (" << refusal.param << ')';
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bits;
    for (const char c : bytes)
        for (int bit = 7; bit >= 0; --bit)
            bits.push_back((c >> bit & 1) != 0 ? '1' : '0');
    while (bits.size() % 6 != 0) bits.push_back('0');
    std::string text;
    for (std::size_t i = 0; i < bits.size(); i += 6)
        text.push_back(kDigits[std::stoul(bits.substr(i, 6), nullptr, 2)]);
    while (text.size() % 4 != 0) text.push_back('=');
    return text;
}

}  // namespace haarmony::server
