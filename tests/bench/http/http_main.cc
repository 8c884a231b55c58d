// haarmony-bench-http: how long clients of a running daemon wait.
//
// Each round measures in turn: one connection; several; several beside others that send
// pictures. Ratios are taken within a round, so that the machine's mood cancels out.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <iostream>
#include <numeric>
#include <string>
#include <vector>

#include "tests/bench/http/load.h"
#include "tests/bench/http/picture.h"
#include "tests/bench/http/posters.h"
#include "tests/bench/http/quantiles.h"

namespace haarmony::bench {
namespace {

struct Settings {
    LoadOptions load;
    int clients = 8;
    int posters = 4;
    int rounds = 5;
    int side = 2000;  // of the posted picture
};

// What one round found.
struct Round {
    Quantiles one_total;
    Quantiles one_overhead;  // total less search
    double one_search = 0;
    Quantiles many;
    Quantiles beside;
};

using Field = std::function<double(const Waited&)>;

Quantiles quantiles(const std::vector<Waited>& all, const Field& field) {
    std::vector<double> values;
    for (const Waited& waited : all) values.push_back(field(waited));
    return quantiles_of(std::move(values));
}

void print(const std::string& name, const Quantiles& q) {
    std::printf(
        "%-34s %8.3f %8.3f %8.3f %8.3f\n", name.c_str(), q.p50, q.p90, q.p99, q.max);
}

Quantiles measure(const std::string& name, const LoadOptions& load) {
    const std::vector<Waited> all = run_load(load);
    const Quantiles total = quantiles(all, [](const Waited& w) { return w.total; });
    print(name, total);
    return total;
}

Round run_round(const Settings& settings, const std::string& picture) {
    Round round;
    LoadOptions one = settings.load;
    one.connections = 1;
    const std::vector<Waited> alone = run_load(one);
    round.one_total = quantiles(alone, [](const Waited& w) { return w.total; });
    round.one_overhead =
        quantiles(alone, [](const Waited& w) { return w.total - w.search; });
    const Quantiles search = quantiles(alone, [](const Waited& w) { return w.search; });
    round.one_search = search.p50;
    print("one connection", round.one_total);
    print("  search", search);
    print("  took_ms", quantiles(alone, [](const Waited& w) { return w.took; }));
    print("  total - search", round.one_overhead);

    LoadOptions many = settings.load;
    many.connections = settings.clients;
    const std::string clients = std::to_string(settings.clients) + " connections";
    round.many = measure(clients, many);

    Posters posters(settings.load.port, settings.posters, picture);
    round.beside =
        measure(clients + ", " + std::to_string(settings.posters) + " posting", many);
    std::printf("  pictures answered %d, refused %d, failed %d\n",
                posters.answered(),
                posters.refused(),
                posters.failed());
    return round;
}

// Mean and standard deviation of a ratio over the rounds.
void print_ratio(const std::string& name,
                 const std::vector<Round>& rounds,
                 const std::function<double(const Round&)>& ratio) {
    std::vector<double> values;
    for (const Round& round : rounds) values.push_back(ratio(round));
    const auto count = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
    double squares = 0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    const double deviation = count > 1 ? std::sqrt(squares / (count - 1)) : 0;
    std::printf("%-50s %8.3f +- %.3f\n", name.c_str(), mean, deviation);
}

void run(const Settings& settings, const std::string& picture) {
    std::printf("%-34s %8s %8s %8s %8s\n", "milliseconds", "p50", "p90", "p99", "max");
    std::vector<Round> rounds;
    for (int i = 0; i < settings.rounds; ++i)
        rounds.push_back(run_round(settings, picture));
    std::printf("\nover %d rounds\n", settings.rounds);
    print_ratio("one connection, p50 of total - search, ms", rounds, [](const Round& r) {
        return r.one_overhead.p50;
    });
    print_ratio("one connection, p50: total / search", rounds, [](const Round& r) {
        return r.one_total.p50 / r.one_search;
    });
    print_ratio("several connections, p99 / p50", rounds, [](const Round& r) {
        return r.many.p99 / r.many.p50;
    });
    print_ratio("several connections, p50: beside posts / without",
                rounds,
                [](const Round& r) { return r.beside.p50 / r.many.p50; });
    print_ratio("several connections, p99: beside posts / without",
                rounds,
                [](const Round& r) { return r.beside.p99 / r.many.p99; });
}

}  // namespace
}  // namespace haarmony::bench

int main(int argc, char** argv) {
    using haarmony::bench::Settings;
    Settings settings;
    CLI::App app("Measures a running daemon. Its database: haarmony-bench-database.");
    app.add_option("--port", settings.load.port, "of the daemon, on this machine")
        ->capture_default_str();
    app.add_option("--ids", settings.load.largest_id, "ids 1 to this one are asked for")
        ->required()
        ->check(CLI::PositiveNumber);
    app.add_option("--requests", settings.load.requests, "in each measurement")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_option("--limit", settings.load.limit, "matches in an answer")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_option("--clients", settings.clients, "connections of the second measurement")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_option("--posters", settings.posters, "clients that send pictures")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_option("--side", settings.side, "of the picture they send, in pixels")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_option("--rounds", settings.rounds)
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    CLI11_PARSE(app, argc, argv);

    try {
        const auto picture = haarmony::bench::jpeg_picture(settings.side, settings.side);
        if (picture) {
            haarmony::bench::run(settings, picture.value());
            return 0;
        }
        std::cerr << "haarmony-bench-http: " << picture.error().message << '\n';
    } catch (const std::exception& error) {
        std::cerr << "haarmony-bench-http: " << error.what() << '\n';
    }
    return 1;
}
