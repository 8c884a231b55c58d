#include "server/http/router.h"

#include <cassert>
#include <cstddef>
#include <exception>
#include <set>
#include <utility>

#include "server/http/problem.h"

namespace haarmony::http {
namespace {

std::vector<std::string_view> split(std::string_view path) {
    std::vector<std::string_view> segments;
    path.remove_prefix(1);
    for (;;) {
        const std::size_t slash = path.find('/');
        segments.push_back(path.substr(0, slash));
        if (slash == std::string_view::npos) return segments;
        path.remove_prefix(slash + 1);
    }
}

bool is_parameter(std::string_view segment) {
    return segment.size() > 2 && segment.front() == '{' && segment.back() == '}';
}

// A handler's exception ends here: its text may name files or queries.
Response call(const Handler& handler,
              const Request& request,
              const FailureReport& report) {
    std::string what = "an exception of unknown type";
    try {
        return handler(request);
    } catch (const std::exception& error) {
        what = error.what();
    } catch (...) {  // NOLINT(bugprone-empty-catch): `what` says so
    }
    if (report) report(request, what);
    return to_response(internal_problem(), request);
}

}  // namespace

struct Router::Route {
    RouteOptions options;
    std::vector<std::string> names;  // of the pattern's parameters, from left to right
    Handler handler;
};

struct Router::Node {
    std::map<std::string, std::unique_ptr<Node>, std::less<>> literals;
    std::unique_ptr<Node> parameter;
    std::map<std::string, Route, std::less<>> methods;  // empty: only a way to others
};

struct Router::Found {
    const Node* node = nullptr;
    std::vector<std::string_view> values;

    [[nodiscard]] const Route* route(std::string_view method) const {
        if (node == nullptr) return nullptr;
        auto found = node->methods.find(method);
        if (found == node->methods.end() && method == "HEAD") {
            found = node->methods.find("GET");
        }
        return found == node->methods.end() ? nullptr : &found->second;
    }

    [[nodiscard]] std::string allow() const {
        std::set<std::string, std::less<>> methods{"OPTIONS"};
        for (const auto& [method, route] : node->methods) methods.insert(method);
        if (methods.contains("GET")) methods.insert("HEAD");
        std::string list;
        for (const std::string& method : methods) {
            list += (list.empty() ? "" : ", ") + method;
        }
        return list;
    }

    // Depth first, literals first; a branch that leads nowhere is left again.
    bool descend(const Node& from,
                 const std::vector<std::string_view>& segments,
                 std::size_t at) {
        if (at == segments.size()) {
            if (from.methods.empty()) return false;
            node = &from;
            return true;
        }
        const auto literal = from.literals.find(segments[at]);
        if (literal != from.literals.end() &&
            descend(*literal->second, segments, at + 1)) {
            return true;
        }
        if (from.parameter == nullptr || segments[at].empty()) return false;
        values.push_back(segments[at]);
        if (descend(*from.parameter, segments, at + 1)) return true;
        values.pop_back();
        return false;
    }
};

Router::Router() : root_(std::make_unique<Node>()) {}
Router::~Router() = default;

void Router::add(std::string_view method,
                 std::string_view pattern,
                 const RouteOptions& options,
                 Handler handler) {
    assert(pattern.starts_with('/'));
    Node* node = root_.get();
    Route route{.options = options, .names = {}, .handler = std::move(handler)};
    for (const std::string_view segment : split(pattern)) {
        const bool parameter = is_parameter(segment);
        if (parameter) route.names.emplace_back(segment.substr(1, segment.size() - 2));
        std::unique_ptr<Node>& next =
            parameter ? node->parameter : node->literals[std::string(segment)];
        if (next == nullptr) next = std::make_unique<Node>();
        node = next.get();
    }
    [[maybe_unused]] const bool added =
        node->methods.emplace(method, std::move(route)).second;
    assert(added);
}

void Router::set_fallback(const RouteOptions& options, Handler handler) {
    fallback_options_ = options;
    fallback_ = std::move(handler);
}

Router::Found Router::find(std::string_view path) const {
    Found found;
    if (path.starts_with('/')) found.descend(*root_, split(path), 0);
    return found;
}

RouteMatch Router::match(std::string_view method, std::string_view path) const {
    const Found found = find(path);
    if (found.node == nullptr) {
        if (fallback_ == nullptr) return {};
        const bool reads = method == "GET" || method == "HEAD";
        return {.options = reads ? &fallback_options_ : nullptr,
                .open = fallback_options_.open};
    }
    RouteMatch match;
    for (const auto& [name, route] : found.node->methods)
        match.open |= route.options.open;
    if (const Route* route = found.route(method)) match.options = &route->options;
    return match;
}

Response Router::dispatch(Request& request) const { return dispatch(request, nullptr); }

Response Router::dispatch(Request& request, const FailureReport& report) const {
    const Found found = find(request.path);
    const Route* route = found.route(request.method);
    if (route == nullptr) return answer_without_route(request, found, report);
    request.path_parameters.clear();
    for (std::size_t i = 0; i < route->names.size(); ++i) {
        request.path_parameters[route->names[i]] = found.values[i];
    }
    return call(route->handler, request, report);
}

Response Router::answer_without_route(Request& request,
                                      const Found& found,
                                      const FailureReport& report) const {
    std::string allow;
    if (found.node != nullptr) {
        allow = found.allow();
    } else if (request.path == "*") {
        allow = "DELETE, GET, HEAD, OPTIONS, PATCH, POST, PUT";
    } else if (fallback_ != nullptr) {
        Response response = call(fallback_, request, report);
        if (request.method == "GET" || request.method == "HEAD") return response;
        // The fallback knows best which paths exist; nothing but reading is allowed there.
        if (response.status != 404) allow = "GET, HEAD, OPTIONS";
    }
    if (allow.empty()) {
        return to_response({.status = 404,
                            .code = "not_found",
                            .detail = "There is nothing at '" + request.path + "'."},
                           request);
    }
    if (request.method == "OPTIONS") {
        return {.status = 204, .headers = {{"Allow", allow}}, .body = {}};
    }
    return to_response({.status = 405,
                        .code = "method_not_allowed",
                        .detail = "'" + request.path + "' does not allow " +
                                  request.method + ", but " + allow + ".",
                        .headers = {{"Allow", allow}}},
                       request);
}

}  // namespace haarmony::http
