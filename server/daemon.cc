#include "server/daemon.h"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "server/api/api_keys.h"
#include "server/api/context.h"
#include "server/api/routes.h"
#include "server/app/cluster_overview.h"
#include "server/app/curve_service.h"
#include "server/app/duplicate_groups.h"
#include "server/app/frame_search.h"
#include "server/app/image_service.h"
#include "server/app/job_runner.h"
#include "server/app/job_types.h"
#include "server/app/media_roots.h"
#include "server/app/video_service.h"
#include "server/http/listener.h"
#include "server/http/probe.h"
#include "server/log.h"
#include "server/page.h"

namespace haarmony::server {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kProbeTimeout{5};

// SIGTERM and SIGINT wait for sigwait() in every thread that is started while this lives;
// after it a second Ctrl-C ends the process at once.
class StopSignals {
  public:
    StopSignals() {
        sigemptyset(&set_);
        sigaddset(&set_, SIGTERM);
        sigaddset(&set_, SIGINT);
        pthread_sigmask(SIG_BLOCK, &set_, &before_);
        std::signal(SIGPIPE, SIG_IGN);
    }
    ~StopSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

    void wait() const {
        int signal = 0;
        sigwait(&set_, &signal);
    }

  private:
    sigset_t set_{};
    sigset_t before_{};
};

Result<std::optional<ApiKeys>> read_keys(const std::optional<std::string>& path) {
    if (!path) return std::optional<ApiKeys>();
    std::ifstream file(*path, std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(file), {});
    if (!file)
        return Error{ErrorCode::kInvalidArgument,
                     "--api-key-file " + *path + " cannot be read"};
    Result<ApiKeys> keys = ApiKeys::parse(text);
    if (!keys)
        return Error{ErrorCode::kInvalidArgument,
                     "--api-key-file " + *path + ": " + keys.error().message};
    return std::optional<ApiKeys>(std::move(keys).value());
}

fs::path this_executable() {
    std::error_code error;
    return fs::read_symlink("/proc/self/exe", error);
}

http::Hooks hooks_for(const std::optional<ApiKeys>& keys) {
    http::Hooks hooks;
    hooks.finished = log_request;
    hooks.failed = log_failure;
    if (!keys) return hooks;
    hooks.admit = [&keys](
                      const http::Request& request,
                      const http::RouteOptions& route) -> std::optional<http::Response> {
        if (route.open) return {};
        const std::optional<http::Problem> problem = keys->admit(request);
        if (!problem) return {};
        return http::to_response(*problem, request);
    };
    return hooks;
}

http::ListenerOptions listener_options(const Config& config) {
    http::ListenerOptions options;
    options.host = config.host;
    options.port = config.port;
    options.cheap_threads = std::max(2, config.threads);
    options.costly_threads = config.threads;
    return options;
}

// In plain words, whatever the log's level: who started the daemon reads it.
int leave(int exit_code, const Error& error) {
    std::cerr << "haarmonyd: " << error.message << '\n';
    return exit_code;
}

}  // namespace

int run_daemon(const Config& config) {
    open_log(config.log_level);
    const auto keys = read_keys(config.api_key_file);
    if (!keys) return leave(kExitUsage, keys.error());
    auto media_roots = MediaRoots::open(config.media_roots);
    if (!media_roots) return leave(kExitUsage, media_roots.error());
    auto page = open_page(config.web, this_executable());
    if (!page) return leave(kExitUsage, page.error());

    auto signals = std::make_optional<StopSignals>();
    ImageServiceOptions service;
    service.database_path = config.database;
    service.index_m = config.index_m;
    service.search_cores = std::max(1, config.threads);
    auto images = ImageService::open(service);
    if (!images) return leave(kExitCouldNotRun, images.error());

    VideoServiceOptions showing;
    showing.database_path = config.database;
    auto videos = VideoService::open(showing);
    if (!videos) return leave(kExitCouldNotRun, videos.error());

    IngestJobOptions ingest;
    ingest.database_path = config.database;
    ingest.media_roots = media_roots.value();
    ingest.threads = config.threads;
    JobRunnerOptions running;
    running.database_path = config.database;
    auto jobs = JobRunner::start(running,
                                 job_types(images.value()->index(),
                                           images.value()->snapshots(),
                                           *videos.value(),
                                           ingest,
                                           service.decode));
    if (!jobs) return leave(kExitCouldNotRun, jobs.error());
    auto duplicates = DuplicateGroups::open(config.database);
    if (!duplicates) return leave(kExitCouldNotRun, duplicates.error());
    auto curves = CurveService::open(config.database);
    if (!curves) return leave(kExitCouldNotRun, curves.error());
    ClusterOverview clusters(
        config.database, images.value()->index(), config.threads - 1);

    FrameSearch frames(config.database, config.index_m);

    const Context context{*images.value(),
                          *jobs.value(),
                          *duplicates.value(),
                          clusters,
                          *curves.value(),
                          *videos.value(),
                          frames,
                          std::move(media_roots).value(),
                          config.allow_url_fetch,
                          config.max_body,
                          config.max_video_body};
    http::Router router;
    add_routes(context, router);
    http::RouteOptions page_route;
    page_route.open = true;
    router.set_fallback(page_route, std::move(page).value());

    auto listener =
        http::Listener::listen(listener_options(config), router, hooks_for(keys.value()));
    if (!listener) return leave(kExitCouldNotRun, listener.error());
    const std::string address = address_of(config.host, listener.value()->port());
    std::cout << "listening on " << address << std::endl;
    log_started(address, config.database);

    signals->wait();
    signals.reset();
    listener.value()->stop();
    jobs.value()->stop();
    images.value()->stop();
    log_stopped();
    return 0;
}

int check_health(const Config& config) {
    // A daemon that listens everywhere listens here, too.
    std::string host = config.host;
    if (host == "0.0.0.0") host = "127.0.0.1";
    if (host == "::") host = "::1";
    const Result<int> status = http::probe(host, config.port, "/healthz", kProbeTimeout);
    if (status && status.value() == 200) return 0;
    std::cerr << address_of(host, config.port) << "/healthz: "
              << (status ? "status " + std::to_string(status.value())
                         : status.error().message)
              << '\n';
    return 1;
}

}  // namespace haarmony::server
