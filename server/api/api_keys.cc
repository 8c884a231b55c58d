#include "server/api/api_keys.h"

#include <algorithm>
#include <cstdint>

#include "ingest/describe.h"
#include "server/http/header_value.h"

namespace haarmony::server {
namespace {

constexpr std::string_view kRead = "read:";
constexpr std::string_view kWrite = "write:";

std::string hash_of(std::string_view key) {
    return ingest::content_hash(
        {reinterpret_cast<const std::uint8_t*>(key.data()), key.size()});
}

// Requires: equal lengths, as hashes have.
bool equal_in_constant_time(std::string_view a, std::string_view b) {
    unsigned difference = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
    return difference == 0;
}

bool is_visible(char c) { return c > ' ' && c < '\x7f'; }

std::string_view presented_key(const http::Request& request) {
    const std::string_view authorization = request.header("Authorization");
    const std::size_t space = authorization.find(' ');
    if (space != std::string_view::npos &&
        http::equal_without_case(authorization.substr(0, space), "Bearer"))
        return http::trim(authorization.substr(space));
    return http::trim(request.header("X-Api-Key"));
}

// A query is a POST for its body's sake alone.
bool only_reads(const http::Request& request) {
    return request.method == "GET" || request.method == "HEAD" ||
           request.method == "OPTIONS" || request.path == "/query";
}

}  // namespace

Result<ApiKeys> ApiKeys::parse(std::string_view text) {
    ApiKeys keys;
    for (int line_number = 1; !text.empty(); ++line_number) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view key = http::trim(text.substr(0, end));
        if (key.ends_with('\r')) key = http::trim(key.substr(0, key.size() - 1));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (key.empty() || key.front() == '#') continue;
        const bool writes = !key.starts_with(kRead);
        if (!writes) {
            key.remove_prefix(kRead.size());
        } else if (key.starts_with(kWrite)) {
            key.remove_prefix(kWrite.size());
        }
        if (key.empty() || !std::all_of(key.begin(), key.end(), is_visible))
            return Error{ErrorCode::kInvalidArgument,
                         "line " + std::to_string(line_number) +
                             " is no key: visible ASCII characters without blanks"};
        keys.keys_.push_back({hash_of(key), writes});
    }
    if (keys.keys_.empty())
        return Error{ErrorCode::kInvalidArgument, "there is no key in it"};
    return keys;
}

std::optional<http::Problem> ApiKeys::admit(const http::Request& request) const {
    const std::string hash = hash_of(presented_key(request));
    bool known = false;
    bool writes = false;
    for (const Key& key : keys_) {
        const bool same = equal_in_constant_time(key.hash, hash);
        known |= same;
        writes |= same && key.writes;
    }
    if (!known)
        return http::Problem{
            401,
            "key_required",
            "a key is needed: Authorization: Bearer KEY, or X-Api-Key: KEY",
            "Authorization",
            {{"WWW-Authenticate", "Bearer"}}};
    if (!writes && !only_reads(request))
        return http::Problem{403,
                             "read_only_key",
                             "this key may read and search, not change",
                             "Authorization",
                             {}};
    return {};
}

}  // namespace haarmony::server
