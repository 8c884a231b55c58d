// A child process and what it says, for tests of real executables.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tests/ingest/scratch_folder.h"

namespace haarmony::ingest {

struct ChildOptions {
    bool terminal = false;            // stdout and stderr are one terminal of 80 columns
    bool closed_output = false;       // nobody reads stdout, and nobody can
    bool full_errors = false;         // nobody reads stderr before wait(): writing waits
    std::int64_t max_file_size = -1;  // bytes it may write to one file; -1: any number
    std::string working_folder = {};  // empty: the test's own
};

class ChildProcess {
  public:
    // arguments[0] is the executable.
    ChildProcess(const std::vector<std::string>& arguments, const ChildOptions& options);
    ~ChildProcess();  // kills what is still running
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    void signal(int number) const;
    // The exit code, or minus the signal that ended it.
    int wait();

    // What it wrote; complete once wait() has returned. On a terminal all is in out().
    [[nodiscard]] std::string out() const;
    [[nodiscard]] std::string err() const;

  private:
    const ScratchFolder folder_;
    pid_t process_ = -1;
    std::optional<int> status_;
    int our_end_ = -1;  // of a terminal or of a full pipe
    std::size_t filled_ = 0;
    std::string text_;  // read from there
};

struct Finished {
    int status = 0;
    std::string out;
    std::string err;
};
[[nodiscard]] Finished run_to_end(const std::vector<std::string>& arguments,
                                  const ChildOptions& options);

}  // namespace haarmony::ingest
