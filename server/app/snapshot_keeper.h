// Keeps a snapshot file beside the database that is never far behind the indexes.
//
//   index_follower -> [snapshot_keeper] -> snapshot_writer
//
// Rule     a file is written when pictures had to be read from the database; when at least
//          `least_changes` changes, and a tenth as many as there are pictures, have come since
//          the last one; when a job asks for it; and when the daemon ends and anything has
//          changed. Nobody waits for it: it is made of what is published, by a thread of low
//          priority.
// Errors   of write(): those of snapshot_writer.h; kUnavailable while the collection is loaded.
//          What the thread meets is logged, and tried again after `retry_interval`.
// Threads  every member from any thread.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "engine/core/result.h"
#include "server/app/index_follower.h"

namespace haarmony::server {

// Where the snapshot of a database is.
[[nodiscard]] std::string snapshot_path_of(const std::string& database_path);

struct SnapshotKeeperOptions {
    std::string database_path;
    int threads = 1;  // that may be used when the daemon ends
    std::int64_t least_changes = 10'000;
    std::chrono::milliseconds look_interval{1000};
    std::chrono::milliseconds retry_interval{600'000};
};

struct SnapshotWritten {
    std::int64_t bytes = 0;
    std::int64_t images = 0;
    std::int64_t sequence = 0;
};

class SnapshotKeeper {
  public:
    // Requires: the follower outlives it.
    SnapshotKeeper(const SnapshotKeeperOptions& options, IndexFollower& follower);
    ~SnapshotKeeper();
    SnapshotKeeper(const SnapshotKeeper&) = delete;
    SnapshotKeeper& operator=(const SnapshotKeeper&) = delete;

    // Writes a file now. `go_on` is told how many bytes of how many are written, and says
    // whether to go on.
    [[nodiscard]] Result<SnapshotWritten> write(
        const std::function<bool(std::uint64_t bytes, std::uint64_t total)>& go_on);

    // The last change in the file; nothing where no file is known.
    [[nodiscard]] std::optional<std::int64_t> sequence() const;

    // Ends the thread and writes what has changed.
    void save_and_stop();

  private:
    void watch();
    void stop();
    [[nodiscard]] bool is_due() const;
    [[nodiscard]] Result<SnapshotWritten> write_with(
        Executor& executor,
        const std::function<bool(std::uint64_t, std::uint64_t)>& go_on);
    [[nodiscard]] bool wait(std::chrono::milliseconds period);  // false: time to stop

    const SnapshotKeeperOptions options_;
    IndexFollower& follower_;

    std::mutex write_mutex_;  // one file at a time
    static constexpr std::int64_t kNone = -1;
    std::atomic<std::int64_t> written_{kNone};  // the sequence of the last one
    std::atomic<bool> stopping_{false};         // written under wake_mutex_

    std::mutex wake_mutex_;
    std::condition_variable wake_;
    std::thread thread_;
};

}  // namespace haarmony::server
