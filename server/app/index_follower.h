// Keeps the search indexes equal to the database, whoever writes to it:
//   SQLite (the truth) -> [index_follower] -> variant_indexes (a view of it)
//
// A thread takes what a snapshot file holds, or where there is none that can be used loads
// every signature, then polls for commits of other connections and applies the changes in
// batches; a second thread merges segments. A stored signature that does not decode is
// logged, counted and left out, never fatal.
//
// Errors   start() fails where the database cannot be opened; a failure later is logged and
//          tried again at the next poll.
// Threads  every member may be called from any thread; no lock is held while searching a
//          snapshot or merging.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "engine/core/executor.h"
#include "engine/core/result.h"
#include "engine/image/index.h"
#include "server/app/connection.h"
#include "server/app/snapshot_format.h"
#include "server/app/variant_indexes.h"

namespace haarmony::server {

struct FollowerOptions {
    std::string database_path;
    image::IndexOptions index;
    std::chrono::milliseconds poll_interval{25};
    std::string snapshot_path = {};  // empty: never looked for
    int threads = 1;                 // that load, the follower's own included
};

// The indexes as they are after a change, and the pictures with a damaged signature.
struct FollowedState {
    std::int64_t sequence = 0;
    Snapshots snapshots;
    std::vector<ImageId> damaged;
};

class IndexFollower {
  public:
    // The database must exist. Loading goes on in the background: see ready().
    [[nodiscard]] static Result<std::unique_ptr<IndexFollower>> start(
        const FollowerOptions& options);
    ~IndexFollower();
    IndexFollower(const IndexFollower&) = delete;
    IndexFollower& operator=(const IndexFollower&) = delete;

    // Whether the whole collection has been loaded.
    [[nodiscard]] bool ready() const { return ready_; }
    [[nodiscard]] Snapshots snapshots() const;
    // Of the first signatures, which every searchable picture has.
    [[nodiscard]] std::shared_ptr<const image::IndexSnapshot> snapshot() const;
    [[nodiscard]] int index_m() const;
    // The last change that the indexes contain, and how many pictures lack a signature there
    // because the stored one is damaged.
    [[nodiscard]] std::int64_t sequence() const { return sequence_; }
    [[nodiscard]] std::int64_t damaged() const { return damaged_count_; }

    // What a snapshot file may be made of; nothing until the collection is loaded.
    [[nodiscard]] std::optional<FollowedState> state();
    // The sequence of the snapshot file that it began with; nothing where it read the database,
    // or is still at it.
    [[nodiscard]] std::optional<std::int64_t> began_with() const;
    // The last change that loading found, whichever way. Requires: ready().
    [[nodiscard]] std::int64_t loaded_sequence() const { return loaded_sequence_; }

    // Applies what was committed before the call, so that the writer who committed it finds
    // it. Before ready() it does nothing: loading ends with the same step.
    [[nodiscard]] Result<void> catch_up();

    // Ends both threads; the indexes stay as they are.
    void stop();

  private:
    IndexFollower(const FollowerOptions& options, std::unique_ptr<Connection> connection);

    void follow();
    void merge();
    [[nodiscard]] Result<void> load();
    // Whether there was a snapshot file that could be used.
    [[nodiscard]] Result<bool> load_snapshot(Executor& executor);
    [[nodiscard]] Result<void> load_database(Executor& executor);
    [[nodiscard]] Result<void> check_origin(const SnapshotTable& table);
    void loaded(std::int64_t sequence);
    [[nodiscard]] Result<void> poll();
    [[nodiscard]] Result<void> apply_changes();
    // What of a picture can be searched; damaged signatures are noted and left out.
    [[nodiscard]] SearchablePicture read(const schema::SearchableImage& image);
    void note_damage(ImageId id, const std::string& reason);
    void note_sound(ImageId id);
    void wake_merger();
    bool wait(std::chrono::milliseconds period);  // false: time to stop

    const FollowerOptions options_;
    VariantIndexes indexes_;

    // Guards connection_, damaged_ and the order of apply(). While loading, the
    // follower's thread owns them without it: others look at loaded_ first.
    std::mutex apply_mutex_;
    std::unique_ptr<Connection> connection_;
    std::set<ImageId> damaged_;
    bool loaded_ = false;
    bool snapshot_refused_ = false;
    std::int64_t data_version_ = -1;  // of the last poll; SQLite's are never negative

    std::atomic<std::int64_t> sequence_{0};
    std::atomic<std::int64_t> damaged_count_{0};
    std::atomic<bool> ready_{false};
    std::atomic<bool> stop_loading_{false};
    static constexpr std::int64_t kNoSnapshot = -1;
    std::atomic<std::int64_t> began_with_{kNoSnapshot};
    std::atomic<std::int64_t> loaded_sequence_{0};

    std::mutex wake_mutex_;  // guards stopping_ and merge_due_
    std::condition_variable wake_;
    bool stopping_ = false;
    bool merge_due_ = false;

    std::thread follower_;
    std::thread merger_;
};

}  // namespace haarmony::server
