// The header of W3C Server Timing: how long the parts of an answer took.
//
// Shape    "search;dur=1.204, rows;dur=0.080": milliseconds, rounded to thousandths.
// Threads  values.
#pragma once

#include <chrono>
#include <initializer_list>
#include <string>
#include <string_view>

namespace haarmony::server {

struct TimedPart {
    std::string_view name;  // letters
    std::chrono::nanoseconds took;
};

[[nodiscard]] std::string server_timing(std::initializer_list<TimedPart> parts);

}  // namespace haarmony::server
