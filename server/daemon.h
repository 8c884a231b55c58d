// Puts the parts together and runs them until told to stop:
//   database and index -> handlers -> router -> listener
#pragma once

#include "server/config.h"

namespace haarmony::server {

// Runs until SIGTERM or SIGINT; answers what has been received by then. Returns the exit
// code: 0, kExitUsage for a folder or a key file that is none, kExitCouldNotRun.
[[nodiscard]] int run_daemon(const Config& config);

// Whether the daemon of this configuration answers: 0, or 1 and the reason on stderr.
[[nodiscard]] int check_health(const Config& config);

}  // namespace haarmony::server
