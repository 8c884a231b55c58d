#include "tests/support/process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>

extern char** environ;

namespace haarmony::testing {
namespace {

using Clock = std::chrono::steady_clock;

std::chrono::milliseconds left_until(Clock::time_point end) {
    return std::max(std::chrono::milliseconds{0},
                    std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now()));
}

// Reads what is there; closes at the end.
void drain(int& fd, std::string& text) {
    char buffer[4096];
    const ssize_t count = read(fd, buffer, sizeof buffer);
    if (count > 0) {
        text.append(buffer, static_cast<std::size_t>(count));
        return;
    }
    close(fd);
    fd = -1;
}

// All that was written, wherever its writer stands.
std::string written_to(int memory) {
    std::string text;
    char buffer[4096];
    for (;;) {
        const ssize_t count =
            pread(memory, buffer, sizeof buffer, static_cast<off_t>(text.size()));
        if (count <= 0) return text;
        text.append(buffer, static_cast<std::size_t>(count));
    }
}

}  // namespace

Process::Process(const std::vector<std::string>& arguments) {
    int out[2];
    if (pipe2(out, O_CLOEXEC) != 0) throw std::runtime_error("pipe2");
    err_ = memfd_create("standard error", MFD_CLOEXEC);
    if (err_ < 0) throw std::runtime_error("memfd_create");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err_, STDERR_FILENO);
    std::vector<char*> argv;
    for (const std::string& argument : arguments) {
        argv.push_back(const_cast<char*>(argument.c_str()));
    }
    argv.push_back(nullptr);
    const int failure =
        posix_spawn(&pid_, argv[0], &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(out[1]);
    out_ = out[0];
    if (failure != 0) throw std::runtime_error("cannot start " + arguments[0]);
}

Process::~Process() {
    if (pid_ > 0) {
        kill(pid_, SIGKILL);
        waitpid(pid_, nullptr, 0);
    }
    if (out_ >= 0) close(out_);
    if (err_ >= 0) close(err_);
}

bool Process::pump(std::chrono::milliseconds bound) {
    pollfd out{out_, POLLIN, 0};
    if (poll(&out, 1, static_cast<int>(bound.count())) <= 0) return false;
    drain(out_, out_text_);
    return true;
}

std::optional<std::string> Process::read_line(std::chrono::seconds bound) {
    const auto end = Clock::now() + bound;
    while (true) {
        if (const auto newline = out_text_.find('\n'); newline != std::string::npos) {
            std::string line = out_text_.substr(0, newline);
            out_text_.erase(0, newline + 1);
            return line;
        }
        if (out_ < 0 || !pump(left_until(end))) return std::nullopt;
    }
}

void Process::signal(int number) const {
    if (pid_ > 0) kill(pid_, number);
}

Finished Process::wait(std::chrono::seconds bound) {
    const auto end = Clock::now() + bound;
    while (out_ >= 0) {
        if (!pump(left_until(end))) {
            kill(pid_, SIGKILL);
            break;
        }
    }
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
            out_text_,
            written_to(err_)};
}

Finished run(const std::vector<std::string>& arguments, std::chrono::seconds bound) {
    return Process(arguments).wait(bound);
}

}  // namespace haarmony::testing
