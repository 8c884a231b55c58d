#include "ingest/socket_child.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

namespace haarmony::ingest {
namespace {

// posix_spawn's settings, freed with the scope.
struct SpawnPlan {
    SpawnPlan() {
        posix_spawn_file_actions_init(&actions);
        posix_spawnattr_init(&attributes);
    }
    ~SpawnPlan() {
        posix_spawn_file_actions_destroy(&actions);
        posix_spawnattr_destroy(&attributes);
    }
    SpawnPlan(const SpawnPlan&) = delete;
    SpawnPlan& operator=(const SpawnPlan&) = delete;

    posix_spawn_file_actions_t actions{};
    posix_spawnattr_t attributes{};
};

// The socket as descriptor 0, nothing else open; no signal blocked or ignored; a process
// group of its own, for Ctrl-C in the terminal is meant for us and not for a child in the
// middle of a picture.
void plan_child(SpawnPlan& plan, int socket) {
    posix_spawn_file_actions_adddup2(&plan.actions, socket, 0);
    posix_spawn_file_actions_addopen(&plan.actions, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&plan.actions, 2, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addclosefrom_np(&plan.actions, 3);
    sigset_t none;
    sigset_t all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&plan.attributes, &none);
    posix_spawnattr_setsigdefault(&plan.attributes, &all);
    posix_spawnattr_setpgroup(&plan.attributes, 0);
    posix_spawnattr_setflags(
        &plan.attributes,
        POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
}

}  // namespace

std::string find_program(const std::string& name) {
    std::error_code failed;
    const std::filesystem::path self =
        std::filesystem::read_symlink("/proc/self/exe", failed).parent_path();
    for (const std::filesystem::path& folder : {self, self.parent_path() / "libexec"}) {
        const std::filesystem::path candidate = folder / name;
        if (::access(candidate.c_str(), X_OK) == 0) return candidate.string();
    }
    return name;
}

SocketChild::~SocketChild() { kill_and_wait(); }

int SocketChild::kill_and_wait() {
    socket_ = FileDescriptor();
    if (pid_ < 0) return 0;
    ::kill(pid_, SIGKILL);
    int status = 0;
    pid_t waited = 0;
    do {
        waited = ::waitpid(pid_, &status, 0);
    } while (waited < 0 && errno == EINTR);
    pid_ = -1;
    return waited < 0 ? 0 : status;
}

Result<void> SocketChild::start(const std::string& program,
                                const std::string& task,
                                std::int64_t address_space) {
    assert(!running());
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
        return Error{ErrorCode::kIo,
                     "socketpair: " + std::generic_category().message(errno)};
    }
    FileDescriptor ours(ends[0]);
    const FileDescriptor theirs(ends[1]);

    SpawnPlan plan;
    plan_child(plan, theirs.get());
    std::string name = std::filesystem::path(program).filename().string();
    std::string memory = std::to_string(address_space);
    // One heap for all threads keeps the address space small.
    std::string arenas = "MALLOC_ARENA_MAX=1";
    const std::array<char*, 3> arguments = {name.data(), memory.data(), nullptr};
    const std::array<char*, 2> environment = {arenas.data(), nullptr};
    const int failed = ::posix_spawn(&pid_,
                                     program.c_str(),
                                     &plan.actions,
                                     &plan.attributes,
                                     arguments.data(),
                                     environment.data());
    if (failed != 0) {
        pid_ = -1;
        return Error{ErrorCode::kIo,
                     name + ", the program that " + task + ", cannot be started: " +
                         std::generic_category().message(failed)};
    }
    socket_ = std::move(ours);
    return {};
}

Received SocketChild::receive(void* bytes,
                              std::size_t count,
                              Clock::time_point deadline) {
    char* to = static_cast<char*>(bytes);
    while (count > 0) {
        const auto left =
            std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
        if (left <= 0) return Received::kLate;
        pollfd wait = {socket_.get(), POLLIN, 0};
        const int ready =
            ::poll(&wait, 1, static_cast<int>(std::min<long>(left, 1 << 30)));
        if (ready < 0 && errno != EINTR) return Received::kEnd;
        if (ready <= 0) continue;
        const ssize_t got = ::recv(socket_.get(), to, count, MSG_DONTWAIT);
        if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
        if (got <= 0) return Received::kEnd;
        to += got;
        count -= static_cast<std::size_t>(got);
    }
    return Received::kAll;
}

std::string SocketChild::bury(const std::string& sign, std::int64_t cpu_seconds) {
    // One that is on its way out is left to finish dying, so that its own signal is seen:
    // the socket closed before the process became a zombie.
    int status = 0;
    pid_t waited = 0;
    const Clock::time_point deadline = Clock::now() + std::chrono::seconds(1);
    while (sign.empty() && waited == 0 && Clock::now() < deadline) {
        waited = ::waitpid(pid_, &status, WNOHANG);
        if (waited == 0) ::poll(nullptr, 0, 1);
    }
    if (waited == pid_) {
        pid_ = -1;
        socket_ = FileDescriptor();
    } else {
        status = kill_and_wait();
    }
    std::string reason = sign;
    if (reason.empty() && WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) {
        reason = "took more than " + std::to_string(cpu_seconds) + " s of processor time";
    } else if (reason.empty() && WIFSIGNALED(status)) {
        const char* text = ::sigdescr_np(WTERMSIG(status));
        reason = "crashed (signal " + std::to_string(WTERMSIG(status)) +
                 (text != nullptr ? ", " + std::string(text) : std::string()) + ")";
    } else if (reason.empty()) {
        reason =
            "crashed (it ended with status " + std::to_string(WEXITSTATUS(status)) + ")";
    }
    return reason;
}

}  // namespace haarmony::ingest
