// haarmony-bench-start: how long a start takes, with a snapshot file and without.
//
// The parts and the whole are measured by turns in each round. The daemon is started on the
// same database and asked for the first picture's neighbours until it answers; on the way it
// writes the snapshot file that later starts begin with.
#include <CLI/CLI.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "tests/bench/start/parts.h"
#include "tests/support/http_client.h"
#include "tests/support/process.h"

namespace haarmony::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kLongest{600};
constexpr std::chrono::milliseconds kPause{1};

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// From the start of the process to its first answer; then it is ended, and so writes its
// snapshot where it has none.
double start_daemon(const std::string& daemon,
                    const PartsOptions& options,
                    const std::string& target) {
    const auto started = Clock::now();
    testing::Process process({daemon,
                              "--db",
                              options.database,
                              "--listen",
                              "127.0.0.1:0",
                              "--index-m",
                              std::to_string(options.index_m),
                              "--threads",
                              std::to_string(options.threads),
                              "--log-level",
                              "error"});
    const auto line = process.read_line(kLongest);
    if (!line) throw std::runtime_error(daemon + " does not listen");
    const auto port = std::stoi(line->substr(line->rfind(':') + 1));
    test::HttpClient client(static_cast<std::uint16_t>(port));
    // With a pause: whoever asks without end takes a core from what he waits for.
    while (client.get(target).status != 200) {
        std::this_thread::sleep_for(kPause);
        if (Clock::now() - started > kLongest)
            throw std::runtime_error(target + " is never answered");
    }
    const double seconds = seconds_since(started);
    process.signal(SIGTERM);
    (void)process.wait(kLongest);
    return seconds;
}

void print(const char* name, double seconds, std::int64_t images) {
    std::printf("%-40s %10.1f ms %12.0f images/s\n",
                name,
                seconds * 1e3,
                static_cast<double>(images) / seconds);
}

void print_processor(double seconds, std::int64_t images) {
    std::printf("%-40s %10.1f ms %12.3f us an image\n",
                "  its processor time",
                seconds * 1e3,
                seconds * 1e6 / static_cast<double>(images));
}

void run_round(const PartsOptions& options, const std::string& daemon) {
    const std::string snapshot = options.database + ".bench-snapshot";
    const ReadTime read = read_signatures(options);
    print("read and decode, no segments", read.seconds, read.images);
    print_processor(read.processor_seconds, read.images);
    const RebuildTime rebuilt = rebuild_and_write(options, snapshot);
    print("rebuild: read, decode, segments", rebuilt.seconds, rebuilt.images);
    print_processor(rebuilt.processor_seconds, rebuilt.images);
    print("write and check a snapshot", rebuilt.snapshot_seconds, rebuilt.images);
    const MapTime mapped = map_snapshot(options, snapshot);
    print("map and check it, as a start does", mapped.seconds, rebuilt.images);
    print_processor(mapped.processor_seconds, rebuilt.images);
    print("its checksums alone", mapped.checksum_seconds, rebuilt.images);
    std::printf("%-40s %10.1f MB\n", "snapshot", double(rebuilt.snapshot_bytes) / 1e6);
    std::filesystem::remove(snapshot);
    if (daemon.empty()) return;
    std::filesystem::remove(options.database + ".snapshot");
    print("process to first answer, no snapshot",
          start_daemon(daemon, options, "/query?id=1&limit=20"),
          rebuilt.images);
    print("process to first answer, snapshot",
          start_daemon(daemon, options, "/query?id=1&limit=20"),
          rebuilt.images);
    print("process to listening, nothing to load",
          start_daemon(daemon, options, "/healthz"),
          rebuilt.images);
}

}  // namespace
}  // namespace haarmony::bench

int main(int argc, char** argv) {
    haarmony::bench::PartsOptions options;
    options.threads = 2;
    std::string daemon;
    int rounds = 3;
    CLI::App app("Measures the start over a Haarmony database.");
    app.add_option("--db", options.database, "the database, as haarmony-bench-database")
        ->required()
        ->check(CLI::ExistingFile);
    app.add_option("--daemon", daemon, "haarmonyd, to be started as well")
        ->check(CLI::ExistingFile);
    app.add_option("--index-m", options.index_m, "coefficients a channel")
        ->capture_default_str();
    app.add_option("--threads", options.threads, "cores to use")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_option("--rounds", rounds, "how often")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    try {
        for (int round = 1; round <= rounds; ++round) {
            std::printf("round %d\n", round);
            haarmony::bench::run_round(options, daemon);
        }
    } catch (const std::exception& failed) {
        std::fprintf(stderr, "haarmony-bench-start: %s\n", failed.what());
        return 1;
    }
    return 0;
}
