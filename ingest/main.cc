// haarmony-ingest: see `--help`.
#include <malloc.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <iostream>
#include <utility>
#include <vector>

#include "ingest/catalogue.h"
#include "ingest/command_line.h"
#include "ingest/pipeline.h"
#include "ingest/progress.h"

namespace {

using namespace haarmony;

enum ExitCode { kAllWell = 0, kSomeFailed = 1, kUsage = 2, kCouldNotRun = 3 };
constexpr int kSignalled = 128;  // plus the signal's number, as shells report it

std::atomic<bool> stop = false;
std::atomic<int> caught_signal = 0;
static_assert(std::atomic<bool>::is_always_lock_free &&
                  std::atomic<int>::is_always_lock_free,
              "a signal handler sets them");

void request_stop(int signal) {
    caught_signal = signal;
    stop = true;
}

void install_signal_handlers() {
    struct sigaction action {};
    action.sa_handler = request_stop;
    // The second Ctrl-C meets the default again and ends the process at once.
    action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
    for (const int signal : {SIGINT, SIGTERM}) ::sigaction(signal, &action, nullptr);
    // A reader of our output that has gone away, or a full quota, is an error of the one
    // write, not the end of the run.
    for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
}

// The pixels of one picture go where those of the last one were: given back to the system
// and asked for again, page by page, they would cost a tenth of all the time.
void keep_freed_memory() {
    constexpr int kLargestKept = 32 << 20;  // the most that glibc allows
    ::mallopt(M_MMAP_THRESHOLD, kLargestKept);
    ::mallopt(M_TRIM_THRESHOLD, 2 * kLargestKept);
}

int terminal_columns() {
    constexpr int kUsual = 80;
    winsize size{};
    return ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col
                                                                             : kUsual;
}

void complain(const Error& error) {
    std::cerr << "haarmony-ingest: " << ingest::printable_line(error.message) << '\n';
}

int exit_code(const ingest::Report& report) {
    if (!report.outcome) return kCouldNotRun;
    if (report.stopped) return kSignalled + caught_signal;
    if (report.paths_reached == 0) return kCouldNotRun;
    return report.tally.failed > 0 ? kSomeFailed : kAllWell;
}

}  // namespace

int main(int argc, char** argv) {
    Result<ingest::CommandLine> line =
        ingest::parse_command_line(std::vector<std::string>(argv + 1, argv + argc));
    if (!line) {
        std::cerr << "haarmony-ingest: " << line.error().message
                  << "\nRun haarmony-ingest --help for its options.\n";
        return kUsage;
    }
    if (!line->answer.empty()) {
        std::cout << line->answer;
        return kAllWell;
    }
    install_signal_handlers();
    keep_freed_memory();

    auto catalogue = ingest::StoredCatalogue::open(line->database);
    if (!catalogue) {
        complain(catalogue.error());
        return kCouldNotRun;
    }
    auto kinds = catalogue.value()->kinds_in_use();
    if (!kinds) {
        complain(kinds.error());
        return kCouldNotRun;
    }
    line->pipeline.walk.own_files = ingest::database_files(line->database);
    const ingest::ProgressMode mode = line->progress.value_or(
        ::isatty(STDOUT_FILENO) != 0 ? ingest::ProgressMode::kBar
                                     : ingest::ProgressMode::kPlain);
    line->pipeline.count_ahead = mode != ingest::ProgressMode::kNone;

    ingest::Progress progress(
        mode, terminal_columns(), std::cout, std::cerr, ingest::Progress::Clock::now);
    const ingest::Report report = ingest::run(
        line->pipeline,
        **catalogue,
        ingest::picture_steps(std::move(kinds).value(), line->most_key_frames),
        progress,
        stop);
    progress.done(report.tally);
    if (!report.outcome) complain(report.outcome.error());
    return exit_code(report);
}
