#include "tests/bench/http/load.h"

#include <charconv>
#include <chrono>
#include <future>
#include <random>
#include <stdexcept>
#include <string>

#include "tests/support/http_client.h"

namespace haarmony::bench {
namespace {

using Clock = std::chrono::steady_clock;

std::vector<Waited> ask_over_one(const LoadOptions& options, int connection, int count) {
    std::mt19937_64 random(options.seed + static_cast<unsigned>(connection) * 7919U);
    std::uniform_int_distribution<std::int64_t> ids(1, options.largest_id);
    test::HttpClient client(options.port);
    std::vector<Waited> waited;
    for (int i = 0; i < count; ++i) {
        const std::string target = "/query?id=" + std::to_string(ids(random)) +
                                   "&limit=" + std::to_string(options.limit);
        const Clock::time_point start = Clock::now();
        const test::HttpReply reply = client.get(target);
        const std::chrono::duration<double, std::milli> total = Clock::now() - start;
        if (reply.status != 200)
            throw std::runtime_error("status " + std::to_string(reply.status) + " for " +
                                     target + ": " + reply.body);
        waited.push_back({total.count(),
                          number_after(reply.body, "\"took_ms\":"),
                          number_after(reply.header("server-timing"), "search;dur=")});
    }
    return waited;
}

}  // namespace

double number_after(std::string_view text, std::string_view name) {
    const std::size_t found = text.find(name);
    double number = 0;
    if (found != std::string_view::npos) {
        const std::string_view rest = text.substr(found + name.size());
        const auto end = std::from_chars(rest.data(), rest.data() + rest.size(), number);
        if (end.ec == std::errc{}) return number;
    }
    throw std::runtime_error("no number behind '" + std::string(name) + "' in '" +
                             std::string(text.substr(0, 200)) + "'");
}

std::vector<Waited> run_load(const LoadOptions& options) {
    std::vector<std::future<std::vector<Waited>>> connections;
    for (int i = 0; i < options.connections; ++i) {
        // What does not divide goes to the first ones.
        const int count = options.requests / options.connections +
                          (i < options.requests % options.connections ? 1 : 0);
        connections.push_back(
            std::async(std::launch::async, ask_over_one, options, i, count));
    }
    std::vector<Waited> all;
    for (auto& connection : connections)
        for (const Waited& waited : connection.get()) all.push_back(waited);
    return all;
}

}  // namespace haarmony::bench
