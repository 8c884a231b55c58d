// haarmonyd: finds pictures over HTTP (server/config.cc lists its flags).
#include <iostream>
#include <variant>

#include "server/config.h"
#include "server/daemon.h"

int main(int argc, char** argv) {
    using namespace haarmony::server;
    const std::variant<Config, Leave> read = read_config(argc, argv);
    if (const auto* leave = std::get_if<Leave>(&read)) {
        (leave->exit_code == 0 ? std::cout : std::cerr) << leave->text;
        return leave->exit_code;
    }
    const Config& config = std::get<Config>(read);
    return config.healthcheck ? check_health(config) : run_daemon(config);
}
