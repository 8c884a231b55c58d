// A program of ours as a child process, for tests of the real executables.
//
// Its standard output is a pipe that the test reads; what it writes to its standard error is
// kept until its end.
//
// Errors  a program that cannot be started throws; everything else is for the test to see.
// Threads one process, one thread.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace haarmony::testing {

struct Finished {
    int exit_code = -1;  // 128 + n where signal n ended it
    std::string out;
    std::string err;
};

class Process {
  public:
    // arguments[0] is the program's path; the environment is the test's own.
    explicit Process(const std::vector<std::string>& arguments);
    ~Process();  // kills what still runs
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    // The next line of its standard output, without the line's end; nothing when the
    // output ends or the bound passes.
    [[nodiscard]] std::optional<std::string> read_line(std::chrono::seconds bound);
    void signal(int number) const;
    // Waits for its end, reading all it says; kills it when the bound passes.
    Finished wait(std::chrono::seconds bound);

  private:
    bool pump(std::chrono::milliseconds bound);

    pid_t pid_ = -1;
    int out_ = -1;
    // Memory, not a pipe: a daemon that logs more than a pipe holds, while a test asks it
    // again and again and reads none of it, would wait for a reader for ever.
    int err_ = -1;
    std::string out_text_;
};

// Starts, waits, and gives what it said.
[[nodiscard]] Finished run(const std::vector<std::string>& arguments,
                           std::chrono::seconds bound = std::chrono::seconds{120});

}  // namespace haarmony::testing
