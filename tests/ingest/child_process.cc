#include "tests/ingest/child_process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>

namespace haarmony::ingest {
namespace {

std::string content_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

int open_to_write(const std::string& path) {
    return ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
}

int pipe_without_reader() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) std::abort();
    ::close(ends[0]);
    return ends[1];
}

// A pipe that takes no byte more until it is read.
struct FullPipe {
    int read_end = -1;
    int write_end = -1;
    std::size_t bytes = 0;
};

FullPipe full_pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) std::abort();
    FullPipe pipe{ends[0], ends[1], 0};
    ::fcntl(pipe.write_end, F_SETFL, O_NONBLOCK);
    while (::write(pipe.write_end, "x", 1) == 1) ++pipe.bytes;
    ::fcntl(pipe.write_end, F_SETFL, 0);
    return pipe;
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments,
                           const ChildOptions& options) {
    int out = -1;
    int err = -1;
    if (options.terminal) {
        const winsize size{.ws_row = 24, .ws_col = 80, .ws_xpixel = 0, .ws_ypixel = 0};
        if (::openpty(&our_end_, &out, nullptr, nullptr, &size) != 0) std::abort();
        err = out;
    } else {
        out = options.closed_output ? pipe_without_reader()
                                    : open_to_write(folder_ / "out");
        if (options.full_errors) {
            const FullPipe pipe = full_pipe();
            our_end_ = pipe.read_end;
            err = pipe.write_end;
            filled_ = pipe.bytes;
        } else {
            err = open_to_write(folder_ / "err");
        }
    }
    std::vector<char*> argv;
    for (const std::string& argument : arguments) {
        argv.push_back(const_cast<char*>(argument.c_str()));
    }
    argv.push_back(nullptr);
    process_ = ::fork();
    if (process_ == 0) {
        ::dup2(out, STDOUT_FILENO);
        ::dup2(err, STDERR_FILENO);
        if (!options.working_folder.empty() &&
            ::chdir(options.working_folder.c_str()) != 0) {
            ::_exit(126);
        }
        if (options.max_file_size >= 0) {
            const auto bytes = static_cast<rlim_t>(options.max_file_size);
            const rlimit limit{bytes, bytes};
            ::setrlimit(RLIMIT_FSIZE, &limit);
        }
        ::execv(argv[0], argv.data());
        ::_exit(127);
    }
    ::close(out);
    if (err != out) ::close(err);
    EXPECT_GT(process_, 0);
}

ChildProcess::~ChildProcess() {
    if (!status_) {
        signal(SIGKILL);
        (void)wait();
    }
    if (our_end_ >= 0) ::close(our_end_);
}

void ChildProcess::signal(int number) const { ::kill(process_, number); }

int ChildProcess::wait() {
    if (status_) return *status_;
    if (our_end_ >= 0) {
        // It holds little: it is read until the child has closed its end.
        std::array<char, 4096> bytes{};
        for (ssize_t count = 0;
             (count = ::read(our_end_, bytes.data(), bytes.size())) > 0;) {
            text_.append(bytes.data(), static_cast<std::size_t>(count));
        }
    }
    int status = 0;
    EXPECT_EQ(::waitpid(process_, &status, 0), process_);
    status_ = WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
    return *status_;
}

std::string ChildProcess::out() const {
    const bool terminal = our_end_ >= 0 && filled_ == 0;
    return terminal ? text_ : content_of(folder_ / "out");
}

std::string ChildProcess::err() const {
    const bool pipe = filled_ > 0;
    return pipe ? text_.substr(std::min(filled_, text_.size()))
                : content_of(folder_ / "err");
}

Finished run_to_end(const std::vector<std::string>& arguments,
                    const ChildOptions& options) {
    ChildProcess child(arguments, options);
    const int status = child.wait();
    return {status, child.out(), child.err()};
}

}  // namespace haarmony::ingest
