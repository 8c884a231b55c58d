#include "server/log.h"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include "server/app/log_value.h"

namespace haarmony::server {

void open_log(const std::string& level) {
    auto logger = std::make_shared<spdlog::logger>(
        "haarmonyd", std::make_shared<spdlog::sinks::stderr_sink_mt>());
    logger->set_formatter(std::make_unique<spdlog::pattern_formatter>(
        "time=%Y-%m-%dT%H:%M:%S.%eZ level=%l %v", spdlog::pattern_time_type::utc));
    logger->set_level(spdlog::level::from_str(level));
    spdlog::set_default_logger(std::move(logger));
}

void log_started(std::string_view address, std::string_view database) {
    spdlog::info("event=started address={} db={}", address, log_value(database));
}

void log_stopped() { spdlog::info("event=stopped"); }

void log_request(const http::Request& request,
                 int status,
                 std::chrono::microseconds duration) {
    spdlog::log(status >= 500 ? spdlog::level::warn : spdlog::level::info,
                "event=request method={} path={} status={} ms={:.3f} remote={} id={}",
                log_value(request.method),
                log_value(request.path),
                status,
                static_cast<double>(duration.count()) / 1000,
                request.remote,
                log_value(request.request_id));
}

void log_failure(const http::Request& request, std::string_view what) {
    spdlog::error("event=handler_failed path={} reason={} id={}",
                  log_value(request.path),
                  log_value(what),
                  log_value(request.request_id));
}

}  // namespace haarmony::server
