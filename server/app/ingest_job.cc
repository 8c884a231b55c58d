#include "server/app/ingest_job.h"

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "ingest/catalogue.h"
#include "ingest/file_uri.h"
#include "ingest/key_frames.h"
#include "ingest/pipeline.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

class JobObserver final : public ingest::Observer {
  public:
    explicit JobObserver(JobContext& job) : job_(job) {}

    void failed(const std::string& path, const std::string& reason) override {
        job_.add_error((path.starts_with('/') ? ingest::file_uri(path) : path) + ": " +
                       reason);
    }
    void progress(const ingest::Tally& tally, std::int64_t total) override {
        job_.set_total(total);
        job_.counts() = {
            tally.seen, tally.added, tally.updated, tally.skipped, tally.failed};
        job_.progress();
    }

  private:
    JobContext& job_;
};

struct Request {
    std::vector<std::string> paths;
    bool videos = false;
    std::size_t most_key_frames = ingest::kMostKeyFrames;
};

// With the real paths: a link may lead elsewhere than when the job was queued.
Result<Request> read_request(const std::string& text, const MediaRoots& media_roots) {
    const Error unknown{ErrorCode::kInvalidArgument,
                        "the request " + text + " is not understood"};
    const json members = json::parse(text, nullptr, false);
    if (!members.is_object() || !members.contains("paths") ||
        !members["paths"].is_array())
        return unknown;
    Request request;
    for (const json& path : members["paths"]) {
        if (!path.is_string()) return unknown;
        Result<std::string> real = media_roots.locate_path(path.get<std::string>());
        if (!real) return std::move(real).error();
        request.paths.push_back(std::move(real).value());
    }
    if (members.contains("videos")) {
        if (!members["videos"].is_boolean()) return unknown;
        request.videos = members["videos"];
    }
    if (members.contains("max_key_frames")) {
        if (!members["max_key_frames"].is_number_unsigned() ||
            members["max_key_frames"] == 0)
            return unknown;
        request.most_key_frames = members["max_key_frames"];
    }
    return request;
}

Result<void> run(JobContext& job, const IngestJobOptions& options) {
    auto request = read_request(job.request(), options.media_roots);
    if (!request) return std::move(request).error();
    auto catalogue = ingest::StoredCatalogue::open(options.database_path);
    if (!catalogue) return std::move(catalogue).error();
    auto kinds = catalogue.value()->kinds_in_use();
    if (!kinds) return std::move(kinds).error();

    ingest::PipelineOptions pipeline;
    pipeline.paths = std::move(request->paths);
    pipeline.walk.films = request->videos;
    pipeline.walk.own_files = ingest::database_files(options.database_path);
    // A link could lead out of the media root, and with it a thumbnail into the open.
    pipeline.walk.file_links = false;
    pipeline.jobs = options.threads;
    pipeline.count_ahead = true;
    JobObserver observer(job);
    ingest::Report report = ingest::run(
        pipeline,
        *catalogue.value(),
        ingest::picture_steps(std::move(kinds).value(), request->most_key_frames),
        observer,
        job.stop_flag());
    observer.progress(report.tally, report.tally.seen);
    if (!report.outcome) return std::move(report.outcome).error();
    if (report.stopped && job.cancelled()) return {};
    if (report.paths_reached == 0)
        return Error{ErrorCode::kNotFound, "none of the paths could be read"};
    return {};
}

}  // namespace

JobType ingest_job(const IngestJobOptions& options) {
    return {[options](JobContext& job) { return run(job, options); }};
}

}  // namespace haarmony::server
