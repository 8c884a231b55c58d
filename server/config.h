// What the daemon is told: flags, environment variables, a file.
//
// A flag goes before its HAARMONY_ variable, that before the same key in the TOML file of
// --config, that before the default.
//
// Threads  read_config reads the environment: before other threads write it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace haarmony::server {

struct Config {
    std::string database;
    std::string host = "127.0.0.1";
    std::uint16_t port = 8080;  // 0: any free port
    std::optional<std::string> web;
    int threads = 1;
    std::vector<std::string> media_roots;
    std::optional<std::string> api_key_file;
    bool allow_url_fetch = false;
    std::uint64_t max_body = std::uint64_t{64} << 20;       // pictures and JSON
    std::uint64_t max_video_body = std::uint64_t{1} << 30;  // --max-body sets both
    int index_m = 60;
    std::string log_level = "info";
    bool healthcheck = false;  // ask the daemon that runs with this configuration
};

inline constexpr int kExitUsage = 2;
inline constexpr int kExitCouldNotRun = 3;

// There is nothing to run: help or version (exit code 0, for stdout), or a usage error.
struct Leave {
    int exit_code = 0;
    std::string text;
};

[[nodiscard]] std::variant<Config, Leave> read_config(int argc, const char* const* argv);

struct Endpoint {
    std::string host;
    std::uint16_t port = 0;
};

// "127.0.0.1:8080", "localhost:0", "[::1]:8080" (the host without its brackets).
[[nodiscard]] std::optional<Endpoint> parse_endpoint(const std::string& text);

// "http://127.0.0.1:8080", "http://[::1]:8080".
[[nodiscard]] std::string address_of(const std::string& host, std::uint16_t port);

}  // namespace haarmony::server
