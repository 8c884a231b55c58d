#include "server/config.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <sstream>
#include <thread>
#include <utility>

#include "engine/image/signature.h"
#include "server/version.h"

namespace haarmony::server {
namespace {

constexpr const char* kMediaRootVariable = "HAARMONY_MEDIA_ROOT";
constexpr int kMaxThreads = 1024;

// The flags as CLI11 fills them.
struct Flags {
    Config config;
    std::string listen = "127.0.0.1:8080";
    std::string web;
    std::string api_key_file;
    std::string file;
};

void declare(CLI::App& app, Flags& flags) {
    Config& config = flags.config;
    app.set_version_flag("--version", "haarmonyd " + std::string(kVersion));
    app.add_flag("--healthcheck",
                 config.healthcheck,
                 "Ask the daemon at --listen whether it is well; exit code 0 if so");
    app.add_option("--config", flags.file, "TOML file with the flags below as keys")
        ->envname("HAARMONY_CONFIG");
    app.add_option("--db", config.database, "The database; created when absent")
        ->envname("HAARMONY_DB");
    app.add_option("--listen", flags.listen, "HOST:PORT, [IPv6]:PORT; port 0: any")
        ->envname("HAARMONY_LISTEN")
        ->capture_default_str();
    app.add_option("--web", flags.web, "Folder of the page; built in otherwise")
        ->envname("HAARMONY_WEB");
    app.add_option("--threads", config.threads, "Threads that decode and search")
        ->envname("HAARMONY_THREADS")
        ->check(CLI::Range(1, kMaxThreads))
        ->capture_default_str();
    app.add_option("--media-root",
                   config.media_roots,
                   "Folder whose pictures may be sent as originals; may be repeated "
                   "(Env:HAARMONY_MEDIA_ROOT, separated by ':')")
        ->allow_extra_args(false);
    app.add_option("--api-key-file",
                   flags.api_key_file,
                   "Keys, one a line: KEY, write:KEY or read:KEY")
        ->envname("HAARMONY_API_KEY_FILE");
    app.add_flag("--allow-url-fetch",
                 config.allow_url_fetch,
                 "Fetch pictures from addresses that clients name")
        ->envname("HAARMONY_ALLOW_URL_FETCH");
    app.add_option_function<std::uint64_t>(
           "--max-body",
           [&config](std::uint64_t bytes) {
               config.max_body = bytes;
               config.max_video_body = bytes;
           },
           "Bytes of a request's body")
        ->envname("HAARMONY_MAX_BODY")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 40))
        ->default_str("67108864, of a video 1073741824");
    app.add_option("--index-m", config.index_m, "Coefficients per channel in the index")
        ->envname("HAARMONY_INDEX_M")
        ->check(CLI::Range(1, image::kMaxCoefficients))
        ->capture_default_str();
    app.add_option("--log-level", config.log_level, "debug, info, warn, error or off")
        ->envname("HAARMONY_LOG_LEVEL")
        ->check(CLI::IsMember({"debug", "info", "warn", "error", "off"}))
        ->capture_default_str();
}

// The environment gives what no flag gave; CLI11 sees to all but the list.
void take_media_roots(CLI::App& app) {
    CLI::Option* option = app.get_option("--media-root");
    const char* value = std::getenv(kMediaRootVariable);
    if (option->count() != 0 || value == nullptr) return;
    std::istringstream roots{std::string(value)};
    for (std::string root; std::getline(roots, root, ':');)
        if (!root.empty()) option->add_result(root);
    if (option->count() != 0) option->run_callback();
}

// CLI11 would let the file go before the environment.
void take_file(CLI::App& app, const std::string& path) {
    for (const CLI::ConfigItem& item : CLI::ConfigTOML().from_file(path)) {
        const std::string key = item.fullname();
        CLI::Option* option = app.get_option_no_throw("--" + key);
        const bool is_setting = option != nullptr && key != "config" && key != "help" &&
                                key != "version" && key != "healthcheck";
        if (!is_setting)
            throw CLI::ConfigError(path + ": the key '" + key + "' is not known");
        if (option->count() != 0) continue;
        option->add_result(item.inputs);
        option->run_callback();
    }
}

std::variant<Config, Leave> checked(Flags flags) {
    Config config = std::move(flags.config);
    const std::optional<Endpoint> endpoint = parse_endpoint(flags.listen);
    if (!endpoint)
        return Leave{
            kExitUsage,
            "--listen: '" + flags.listen + "' is not HOST:PORT or [IPv6]:PORT\n"};
    config.host = endpoint->host;
    config.port = endpoint->port;
    if (!flags.web.empty()) config.web = std::move(flags.web);
    if (!flags.api_key_file.empty()) config.api_key_file = std::move(flags.api_key_file);
    if (config.database.empty() && !config.healthcheck)
        return Leave{kExitUsage, "haarmonyd: --db FILE is required (see --help)\n"};
    return config;
}

}  // namespace

std::variant<Config, Leave> read_config(int argc, const char* const* argv) {
    CLI::App app("Haarmony: finds pictures by painting them.", "haarmonyd");
    Flags flags;
    flags.config.threads =
        std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMaxThreads);
    declare(app, flags);
    try {
        app.parse(argc, argv);
        take_media_roots(app);
        if (!flags.file.empty()) take_file(app, flags.file);
    } catch (const CLI::ParseError& error) {
        std::ostringstream out;
        const bool failed = app.exit(error, out, out) != 0;
        return Leave{failed ? kExitUsage : 0, out.str()};
    }
    return checked(std::move(flags));
}

std::optional<Endpoint> parse_endpoint(const std::string& text) {
    const std::size_t colon = text.rfind(':');
    if (colon == std::string::npos) return {};
    Endpoint endpoint{text.substr(0, colon), 0};
    const char* end = text.data() + text.size();
    const auto [stop, error] =
        std::from_chars(text.data() + colon + 1, end, endpoint.port);
    if (error != std::errc{} || stop != end) return {};
    std::string& host = endpoint.host;
    if (host.starts_with('[') && host.ends_with(']')) {
        host = host.substr(1, host.size() - 2);
        if (host.find(':') == std::string::npos) return {};
    } else if (host.find_first_of(":[]") != std::string::npos) {
        return {};
    }
    if (host.empty()) return {};
    return endpoint;
}

std::string address_of(const std::string& host, std::uint16_t port) {
    const bool is_ipv6 = host.find(':') != std::string::npos;
    return "http://" + (is_ipv6 ? '[' + host + ']' : host) + ':' + std::to_string(port);
}

}  // namespace haarmony::server
