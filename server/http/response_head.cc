#include "server/http/response_head.h"

#include <array>
#include <cstdio>

#include "server/http/header_value.h"
#include "server/http/problem.h"

namespace haarmony::http {
namespace {

bool is_the_sessions(std::string_view name) {
    for (const std::string_view own : {"Content-Length",
                                       "Transfer-Encoding",
                                       "Connection",
                                       "Date",
                                       "Server",
                                       "X-Request-Id"}) {
        if (equal_without_case(name, own)) return true;
    }
    return false;
}

void append(std::string& head, std::string_view name, std::string_view value) {
    head += name;
    head += ": ";
    for (const char c : value) head.push_back(has_control({&c, 1}) ? ' ' : c);
    head += "\r\n";
}

}  // namespace

std::string response_head(const Response& response, const Framing& framing) {
    std::string head = "HTTP/1.1 " + std::to_string(response.status) + " ";
    head += reason_phrase(response.status);
    head += "\r\n";
    append(head, "Date", http_date(framing.now));
    append(head, "Server", "haarmony");
    append(head, "X-Request-Id", framing.request_id);
    for (const auto& [name, value] : response.headers) {
        if (is_token(name) && !is_the_sessions(name)) append(head, name, value);
    }
    if (!response.headers.contains("X-Content-Type-Options")) {
        append(head, "X-Content-Type-Options", "nosniff");
    }
    if (may_have_body(response.status)) {
        if (framing.content_length) {
            append(head, "Content-Length", std::to_string(*framing.content_length));
        } else if (framing.chunked) {
            append(head, "Transfer-Encoding", "chunked");
        }
    }
    if (!framing.keep_alive) {
        append(head, "Connection", "close");
    } else if (framing.http_1_0) {
        append(head, "Connection", "keep-alive");
    }
    return head += "\r\n";
}

bool may_have_body(int status) { return status >= 200 && status != 204 && status != 304; }

std::string http_date(std::time_t time) {
    // strftime() would follow the locale.
    static constexpr std::array kDays{"Sun", "Mon", "Tue", "Wed", "Thu", "Fri", "Sat"};
    static constexpr std::array kMonths{"Jan",
                                        "Feb",
                                        "Mar",
                                        "Apr",
                                        "May",
                                        "Jun",
                                        "Jul",
                                        "Aug",
                                        "Sep",
                                        "Oct",
                                        "Nov",
                                        "Dec"};
    std::tm utc{};
    gmtime_r(&time, &utc);
    std::array<char, 64> text{};
    const int length = std::snprintf(text.data(),
                                     text.size(),
                                     "%s, %02d %s %d %02d:%02d:%02d GMT",
                                     kDays[static_cast<std::size_t>(utc.tm_wday)],
                                     utc.tm_mday,
                                     kMonths[static_cast<std::size_t>(utc.tm_mon)],
                                     utc.tm_year + 1900,
                                     utc.tm_hour,
                                     utc.tm_min,
                                     utc.tm_sec);
    return std::string(text.data(), static_cast<std::size_t>(length));
}

}  // namespace haarmony::http
