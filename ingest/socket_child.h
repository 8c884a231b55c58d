// A program of ours in a process of its own, behind a socket, that may crash, hang or talk
// nonsense without harm to us: what decoder_child.h and video_source.h have in common.
//
// The child gets the socket as descriptor 0 and no other, an empty environment, a process
// group of its own and, as its argument, the address space that it may use (confine.h).
//
// Errors  kIo (it cannot be started).
// Threads one caller a child; any number of children side by side.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "engine/core/result.h"
#include "ingest/file_descriptor.h"

namespace haarmony::ingest {

enum class Received { kAll, kEnd, kLate };

class SocketChild {
  public:
    using Clock = std::chrono::steady_clock;

    SocketChild() = default;
    ~SocketChild();
    SocketChild(const SocketChild&) = delete;
    SocketChild& operator=(const SocketChild&) = delete;

    // `task` ends the message "NAME, the program that TASK, cannot be started".
    // Requires: none is running.
    [[nodiscard]] Result<void> start(const std::string& program,
                                     const std::string& task,
                                     std::int64_t address_space);
    [[nodiscard]] bool running() const { return pid_ >= 0; }
    [[nodiscard]] pid_t pid() const { return pid_; }  // -1 = none
    [[nodiscard]] int socket() const { return socket_.get(); }

    // Exactly `count` bytes before `deadline`.
    [[nodiscard]] Received receive(void* bytes,
                                   std::size_t count,
                                   Clock::time_point deadline);

    // Ends it. What it died of, as the end of a sentence about it: `sign` if that is not
    // empty, else what its status says ("crashed (signal 11, ...)").
    std::string bury(const std::string& sign, std::int64_t cpu_seconds);
    // Its wait status, 0 where there was none.
    int kill_and_wait();

  private:
    FileDescriptor socket_;
    pid_t pid_ = -1;
};

// The program of that name beside the running executable, or in ../libexec, or just its name
// where neither exists (starting it then fails and says so).
[[nodiscard]] std::string find_program(const std::string& name);

}  // namespace haarmony::ingest
