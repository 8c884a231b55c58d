#include "server/app/snapshot_keeper.h"

#include <spdlog/spdlog.h>
#include <sys/resource.h>

#include <algorithm>
#include <utility>

#include "server/app/connection.h"
#include "server/app/log_value.h"
#include "server/app/snapshot_writer.h"
#include "server/app/thread_executor.h"

namespace haarmony::server {
namespace {

constexpr int kNiceness = 10;  // as that of jobs
constexpr std::int64_t kShare = 10;

}  // namespace

std::string snapshot_path_of(const std::string& database_path) {
    return database_path + ".snapshot";
}

SnapshotKeeper::SnapshotKeeper(const SnapshotKeeperOptions& options,
                               IndexFollower& follower)
    : options_(options), follower_(follower), thread_([this] {
          ::setpriority(PRIO_PROCESS, 0, ::getpriority(PRIO_PROCESS, 0) + kNiceness);
          watch();
      }) {}

SnapshotKeeper::~SnapshotKeeper() { stop(); }

void SnapshotKeeper::stop() {
    {
        const std::lock_guard lock(wake_mutex_);
        stopping_ = true;
    }
    wake_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void SnapshotKeeper::save_and_stop() {
    stop();
    // Nothing was ever stored, or nothing since.
    if (!follower_.ready() || follower_.sequence() == sequence().value_or(0)) return;
    ThreadExecutor executor(std::max(0, options_.threads - 1));
    const auto written =
        write_with(executor, [](std::uint64_t, std::uint64_t) { return true; });
    if (!written)
        spdlog::error("event=snapshot_failed reason={}",
                      log_value(written.error().message));
}

std::optional<std::int64_t> SnapshotKeeper::sequence() const {
    const std::int64_t written = written_;
    return written == kNone ? follower_.began_with() : std::optional(written);
}

bool SnapshotKeeper::is_due() const {
    if (!follower_.ready()) return false;
    const std::int64_t now = follower_.sequence();
    const std::optional<std::int64_t> last = sequence();
    // An empty database is read as fast as any file.
    if (!last && follower_.loaded_sequence() > 0) return true;
    const std::int64_t images = follower_.snapshot()->stats().images;
    return now - last.value_or(0) >= std::max(options_.least_changes, images / kShare);
}

void SnapshotKeeper::watch() {
    while (wait(options_.look_interval)) {
        if (!is_due()) continue;
        const auto written =
            write([this](std::uint64_t, std::uint64_t) { return !stopping_; });
        if (written || stopping_) continue;
        spdlog::error("event=snapshot_failed reason={}",
                      log_value(written.error().message));
        if (!wait(options_.retry_interval)) return;
    }
}

bool SnapshotKeeper::wait(std::chrono::milliseconds period) {
    std::unique_lock lock(wake_mutex_);
    return !wake_.wait_for(lock, period, [this] { return stopping_.load(); });
}

Result<SnapshotWritten> SnapshotKeeper::write(
    const std::function<bool(std::uint64_t, std::uint64_t)>& go_on) {
    InlineExecutor alone;
    return write_with(alone, go_on);
}

Result<SnapshotWritten> SnapshotKeeper::write_with(
    Executor& executor,
    const std::function<bool(std::uint64_t, std::uint64_t)>& go_on) {
    const auto started = std::chrono::steady_clock::now();
    const std::lock_guard lock(write_mutex_);
    std::optional<FollowedState> state = follower_.state();
    if (!state)
        return Error{ErrorCode::kUnavailable, "the collection is still being loaded"};
    auto connection = Connection::open(options_.database_path,
                                       schema::Database::Mode::kReadWriteCreate);
    if (!connection) return std::move(connection).error();

    SnapshotWritten result;
    result.sequence = state->sequence;
    result.images = total_stats(state->snapshots).images;
    SnapshotContents contents;
    contents.sequence = state->sequence;
    contents.index_m = follower_.index_m();
    contents.damaged = std::move(state->damaged);
    contents.segments = sealed(state->snapshots);
    state.reset();

    SnapshotWriting writing;
    writing.path = snapshot_path_of(options_.database_path);
    writing.token = [&] { return (*connection)->snapshots().add(contents.sequence); };
    writing.go_on = go_on;
    const Result<std::uint64_t> bytes = write_snapshot(contents, writing, executor);
    if (!bytes) return bytes.error();
    result.bytes = static_cast<std::int64_t>(*bytes);
    const std::chrono::duration<double> elapsed =
        std::chrono::steady_clock::now() - started;
    spdlog::info("event=snapshot_written images={} sequence={} bytes={} seconds={:.3f}",
                 result.images,
                 result.sequence,
                 result.bytes,
                 elapsed.count());
    written_ = result.sequence;
    return result;
}

}  // namespace haarmony::server
