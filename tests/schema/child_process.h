// Another process at the same database: schema_process, spoken to over pipes.
//
// Separate executables and not fork(): SQLite's connections and locks do not survive one.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace haarmony::schema {

class ChildProcess {
  public:
    explicit ChildProcess(const std::vector<std::string>& arguments);
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;
    // Kills what still runs.
    ~ChildProcess();

    // Blocks until the child has written a line or closed its output (nothing).
    [[nodiscard]] std::optional<std::string> read_line();
    // Lets a waiting child go on.
    void release();
    // SIGKILL; returns when it is gone, with the lines that were still in the pipe.
    std::vector<std::string> kill();
    // The exit status, once it has ended by itself.
    [[nodiscard]] int wait();

  private:
    pid_t pid_ = -1;
    int input_ = -1;
    int output_ = -1;
    std::string pending_;
};

}  // namespace haarmony::schema
