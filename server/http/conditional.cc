#include "server/http/conditional.h"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "server/http/header_value.h"
#include "server/http/problem.h"

namespace haarmony::http {
namespace {

struct ByteRange {
    std::uint64_t first = 0;
    std::uint64_t last = 0;  // inclusive
};

enum class RangeAnswer { kWhole, kPart, kNone };

bool all_digits(std::string_view text) {
    return !text.empty() &&
           text.find_first_not_of("0123456789") == std::string_view::npos;
}

// A position beyond 64 bits is beyond every body's end.
std::uint64_t saturated(std::string_view digits) {
    constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();
    std::uint64_t value = 0;
    for (const char c : digits) {
        const auto digit = static_cast<std::uint64_t>(c - '0');
        if (value > (kMax - digit) / 10) return kMax;
        value = value * 10 + digit;
    }
    return value;
}

// One range-spec against a body of `length` bytes; kWhole means that it is malformed.
RangeAnswer read_range(std::string_view spec, std::uint64_t length, ByteRange& range) {
    const std::size_t dash = spec.find('-');
    if (dash == std::string_view::npos) return RangeAnswer::kWhole;
    const std::string_view first = spec.substr(0, dash);
    const std::string_view last = spec.substr(dash + 1);
    if (first.empty()) {
        if (!all_digits(last)) return RangeAnswer::kWhole;
        const std::uint64_t count = std::min(saturated(last), length);
        if (count == 0) return RangeAnswer::kNone;
        range = {.first = length - count, .last = length - 1};
        return RangeAnswer::kPart;
    }
    if (!all_digits(first) || (!last.empty() && !all_digits(last)))
        return RangeAnswer::kWhole;
    range.first = saturated(first);
    range.last =
        last.empty() ? std::numeric_limits<std::uint64_t>::max() : saturated(last);
    if (range.last < range.first) return RangeAnswer::kWhole;
    if (range.first >= length) return RangeAnswer::kNone;
    range.last = std::min(range.last, length - 1);
    return RangeAnswer::kPart;
}

RangeAnswer read_ranges(std::string_view header, std::uint64_t length, ByteRange& range) {
    constexpr std::string_view kUnit = "bytes=";
    if (header.size() <= kUnit.size() ||
        !equal_without_case(header.substr(0, kUnit.size()), kUnit)) {
        return RangeAnswer::kWhole;
    }
    const std::vector<std::string_view> specs = split_list(header.substr(kUnit.size()));
    bool satisfiable = false;
    for (const std::string_view spec : specs) {
        const RangeAnswer answer = read_range(spec, length, range);
        if (answer == RangeAnswer::kWhole) return RangeAnswer::kWhole;
        satisfiable |= answer == RangeAnswer::kPart;
    }
    if (specs.empty()) return RangeAnswer::kWhole;
    if (!satisfiable) return RangeAnswer::kNone;
    return specs.size() == 1 ? RangeAnswer::kPart : RangeAnswer::kWhole;
}

void cut(Response& response, const ByteRange& range) {
    const std::uint64_t count = range.last - range.first + 1;
    if (auto* bytes = std::get_if<std::string>(&response.body)) {
        *bytes = bytes->substr(range.first, count);
    } else if (auto* file = std::get_if<FileRange>(&response.body)) {
        file->offset += range.first;
        file->length = count;
    }
}

std::string_view header_of(const Response& response, std::string_view name) {
    const auto found = response.headers.find(name);
    return found == response.headers.end() ? std::string_view{}
                                           : std::string_view(found->second);
}

bool if_none_match_holds(std::string_view condition, std::string_view etag) {
    if (trim(condition) == "*") return false;
    for (const std::string_view candidate : split_list(condition)) {
        if (weakly_equal(candidate, etag)) return false;
    }
    return true;
}

void apply_range(const Request& request, Response& response) {
    const std::optional<std::uint64_t> length = body_length(response);
    const std::string_view header = request.header("Range");
    if (!length || header.empty() || request.method != "GET") return;
    if (!equal_without_case(header_of(response, "Accept-Ranges"), "bytes")) return;
    const std::string_view if_range = request.header("If-Range");
    // Without Last-Modified a date never matches, as it is no entity tag.
    if (!if_range.empty() &&
        !strongly_equal(trim(if_range), header_of(response, "ETag"))) {
        return;
    }
    ByteRange range;
    switch (read_ranges(header, *length, range)) {
        case RangeAnswer::kWhole:
            return;
        case RangeAnswer::kNone:
            response = to_response(
                {.status = 416,
                 .code = "range_not_satisfiable",
                 .detail = "No byte of '" + std::string(header) + "' is among the " +
                           std::to_string(*length) + " that there are.",
                 .param = "Range",
                 .headers = {{"Content-Range", "bytes */" + std::to_string(*length)},
                             {"Accept-Ranges", "bytes"}}},
                request);
            return;
        case RangeAnswer::kPart:
            cut(response, range);
            response.status = 206;
            response.headers["Content-Range"] = "bytes " + std::to_string(range.first) +
                                                "-" + std::to_string(range.last) + "/" +
                                                std::to_string(*length);
            return;
    }
}

}  // namespace

bool weakly_equal(std::string_view a, std::string_view b) {
    if (a.starts_with("W/")) a.remove_prefix(2);
    if (b.starts_with("W/")) b.remove_prefix(2);
    return strongly_equal(a, b);
}

bool strongly_equal(std::string_view a, std::string_view b) {
    return a.size() >= 2 && a.front() == '"' && a.back() == '"' && a == b;
}

std::optional<std::uint64_t> body_length(const Response& response) {
    if (const auto* bytes = std::get_if<std::string>(&response.body))
        return bytes->size();
    if (const auto* file = std::get_if<FileRange>(&response.body)) return file->length;
    return std::nullopt;
}

bool is_unmodified(const Request& request, std::string_view etag) {
    const bool reads = request.method == "GET" || request.method == "HEAD";
    const std::string_view condition = request.header("If-None-Match");
    return reads && !condition.empty() && !etag.empty() &&
           !if_none_match_holds(condition, etag);
}

void apply_conditions(const Request& request, Response& response) {
    const bool reads = request.method == "GET" || request.method == "HEAD";
    if (!reads || response.status != 200) return;
    if (is_unmodified(request, header_of(response, "ETag"))) {
        response.status = 304;
        response.body = std::string{};
        response.headers.erase("Content-Type");
        return;
    }
    apply_range(request, response);
}

}  // namespace haarmony::http
