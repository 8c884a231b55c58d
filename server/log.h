// The daemon's log: one line an event, key=value, on stderr.
//
// Threads  any.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "server/http/message.h"

namespace haarmony::server {

// `level` is one of Config::log_level's. Before other threads log.
void open_log(const std::string& level);

void log_started(std::string_view address, std::string_view database);
void log_stopped();

// For http::Hooks: every finished request, and what a handler let go.
void log_request(const http::Request& request,
                 int status,
                 std::chrono::microseconds duration);
void log_failure(const http::Request& request, std::string_view what);

}  // namespace haarmony::server
