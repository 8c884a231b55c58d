#include "server/app/index_follower.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "ingest/variant.h"
#include "server/app/log_value.h"
#include "server/app/rebuild.h"
#include "server/app/snapshot_reader.h"
#include "server/app/stored_signatures.h"
#include "server/app/thread_executor.h"

namespace haarmony::server {
namespace {

// Large enough that publishing a snapshot is no cost, small enough that a few megabytes
// are held at a time.
constexpr int kBatch = 4096;
constexpr std::chrono::milliseconds kRetryInterval{500};
// Changes after a snapshot, beside a quarter of its pictures: applying one costs some ten times
// what reading a picture with all others does.
constexpr std::int64_t kMostBehind = 20'000;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
        .count();
}

}  // namespace

Result<std::unique_ptr<IndexFollower>> IndexFollower::start(
    const FollowerOptions& options) {
    auto connection =
        Connection::open(options.database_path, schema::Database::Mode::kReadOnly);
    if (!connection) return std::move(connection).error();
    std::unique_ptr<IndexFollower> follower(
        new IndexFollower(options, std::move(connection).value()));
    follower->follower_ = std::thread([raw = follower.get()] { raw->follow(); });
    follower->merger_ = std::thread([raw = follower.get()] { raw->merge(); });
    return follower;
}

IndexFollower::IndexFollower(const FollowerOptions& options,
                             std::unique_ptr<Connection> connection)
    : options_(options), indexes_(options.index), connection_(std::move(connection)) {}

IndexFollower::~IndexFollower() { stop(); }

Snapshots IndexFollower::snapshots() const { return indexes_.snapshots(); }

std::shared_ptr<const image::IndexSnapshot> IndexFollower::snapshot() const {
    return indexes_.snapshots().at(ingest::kMainVariant);
}

int IndexFollower::index_m() const { return indexes_.index_m(); }

void IndexFollower::stop() {
    {
        const std::lock_guard lock(wake_mutex_);
        stopping_ = true;
    }
    stop_loading_ = true;
    wake_.notify_all();
    if (follower_.joinable()) follower_.join();
    if (merger_.joinable()) merger_.join();
}

Result<void> IndexFollower::catch_up() {
    const std::lock_guard lock(apply_mutex_);
    if (!loaded_) return {};
    return apply_changes();
}

void IndexFollower::follow() {
    bool failing = false;
    for (;;) {
        Result<void> step = loaded_ ? Result<void>() : load();
        if (step) step = poll();
        if (stop_loading_) return;
        if (!step && !failing)
            spdlog::error("event=follow_failed reason={}",
                          log_value(step.error().message));
        if (step && failing)
            spdlog::info("event=follow_recovered sequence={}", sequence());
        failing = !step;
        if (!wait(failing ? kRetryInterval : options_.poll_interval)) return;
    }
}

Result<void> IndexFollower::load() {
    ThreadExecutor executor(std::max(0, options_.threads - 1));
    if (!options_.snapshot_path.empty() && !snapshot_refused_) {
        const Result<bool> taken = load_snapshot(executor);
        if (!taken) return taken.error();
        if (*taken) return {};
        snapshot_refused_ = true;
    }
    return load_database(executor);
}

Result<bool> IndexFollower::load_snapshot(Executor& executor) {
    const auto started = std::chrono::steady_clock::now();
    // What the database says when it is asked is no fault of the file's.
    std::optional<Error> failed;
    auto contents = read_snapshot(
        options_.snapshot_path,
        indexes_.index_m(),
        [&](const SnapshotTable& table) {
            Result<void> own = check_origin(table);
            if (!own && own.error().code != ErrorCode::kConflict) failed = own.error();
            return own;
        },
        executor);
    if (failed) return *std::move(failed);
    if (!contents && contents.error().code == ErrorCode::kNotFound) {
        spdlog::info("event=no_snapshot path={}", log_value(options_.snapshot_path));
        return false;
    }
    if (!contents) {
        spdlog::warn("event=snapshot_ignored path={} reason={}",
                     log_value(options_.snapshot_path),
                     log_value(contents.error().message));
        return false;
    }
    indexes_.reset(std::move(contents->segments), image::SegmentOrigin::kFile);
    damaged_ = {contents->damaged.begin(), contents->damaged.end()};
    damaged_count_ = static_cast<std::int64_t>(damaged_.size());
    spdlog::info("event=snapshot_loaded images={} damaged={} sequence={} seconds={:.3f}",
                 snapshot()->stats().images,
                 damaged(),
                 contents->sequence,
                 seconds_since(started));
    began_with_ = contents->sequence;
    loaded(contents->sequence);
    return true;
}

// kConflict where the file is not of this database, or not of its last days.
Result<void> IndexFollower::check_origin(const SnapshotTable& table) {
    const auto known = connection_->snapshots().find(table.token);
    if (!known) return known.error();
    if (!*known || **known != table.sequence)
        return Error{
            ErrorCode::kConflict,
            "the database does not know the snapshot: another database's, or made "
            "after the copy that was put back"};
    const Result<std::int64_t> last = connection_->images().last_sequence();
    if (!last) return last.error();
    if (*last < table.sequence)
        return Error{ErrorCode::kConflict,
                     "the snapshot is ahead: it holds change " +
                         std::to_string(table.sequence) + ", the database's last is " +
                         std::to_string(*last)};
    std::int64_t pictures = 0;
    for (const SnapshotPart& part : table.parts) pictures += part.counts.slots;
    const std::int64_t behind = *last - table.sequence;
    if (behind > kMostBehind + pictures / 4)
        return Error{ErrorCode::kConflict,
                     "the snapshot is " + std::to_string(behind) +
                         " changes old: the database is read sooner"};
    return {};
}

Result<void> IndexFollower::load_database(Executor& executor) {
    const auto started = std::chrono::steady_clock::now();
    RebuildOptions rebuilding;
    rebuilding.index_m = indexes_.index_m();
    rebuilding.threads = std::max(1, options_.threads);
    rebuilding.go_on = [this] { return !stop_loading_; };
    ReadConnections connections([this] {
        return Connection::open(options_.database_path,
                                schema::Database::Mode::kReadOnly);
    });
    Result<Rebuilt> rebuilt = rebuild(connections, rebuilding, executor);
    if (!rebuilt) return std::move(rebuilt).error();
    for (const DamagedSignature& damaged : rebuilt->damaged)
        note_damage(damaged.id, damaged.reason);
    const std::int64_t images = rebuilt->images;
    indexes_.reset(std::move(rebuilt->segments), image::SegmentOrigin::kBuilt);
    spdlog::info("event=loaded images={} damaged={} sequence={} seconds={:.3f}",
                 images,
                 damaged(),
                 rebuilt->sequence,
                 seconds_since(started));
    loaded(rebuilt->sequence);
    return {};
}

void IndexFollower::loaded(std::int64_t sequence) {
    wake_merger();
    const std::lock_guard lock(apply_mutex_);
    loaded_sequence_ = sequence;
    sequence_ = sequence;
    loaded_ = true;
}

std::optional<FollowedState> IndexFollower::state() {
    const std::lock_guard lock(apply_mutex_);
    if (!loaded_) return std::nullopt;
    return FollowedState{
        sequence_, indexes_.snapshots(), {damaged_.begin(), damaged_.end()}};
}

std::optional<std::int64_t> IndexFollower::began_with() const {
    const std::int64_t sequence = began_with_;
    return sequence == kNoSnapshot ? std::nullopt : std::optional(sequence);
}

Result<void> IndexFollower::poll() {
    const std::lock_guard lock(apply_mutex_);
    const Result<std::int64_t> version = connection_->database().data_version();
    if (!version) return version.error();
    if (version.value() == data_version_) return {};
    // The version is read before the changes: a commit in between is seen at the next poll.
    if (Result<void> applied = apply_changes(); !applied) return applied;
    data_version_ = version.value();
    ready_ = true;
    return {};
}

Result<void> IndexFollower::apply_changes() {
    for (;;) {
        Result<std::vector<schema::Change>> changes =
            connection_->images().changes_after(sequence_, kBatch);
        if (!changes) return std::move(changes).error();
        if (changes->empty()) return {};
        std::vector<SearchablePicture> pictures;
        std::vector<ImageId> removals;
        for (const schema::Change& change : changes.value()) {
            note_sound(change.id);
            if (change.signature.empty()) {
                removals.push_back(change.id);
            } else {
                pictures.push_back(read({change.id,
                                         change.width,
                                         change.height,
                                         change.signature,
                                         change.variants}));
            }
        }
        indexes_.apply(pictures, removals);
        sequence_ = changes->back().sequence;
        wake_merger();
        if (changes->size() < kBatch) return {};
    }
}

SearchablePicture IndexFollower::read(const schema::SearchableImage& image) {
    SearchablePicture picture;
    picture.id = image.id;
    picture.log_aspect = log_aspect_of(image);
    decode_signatures(
        image,
        [&](const std::string& variant, image::Signature&& signature) {
            picture.signatures.emplace(variant, std::move(signature));
        },
        [&](const std::string& reason) { note_damage(image.id, reason); });
    return picture;
}

void IndexFollower::note_damage(ImageId id, const std::string& reason) {
    if (!damaged_.insert(id).second) return;
    damaged_count_ = static_cast<std::int64_t>(damaged_.size());
    spdlog::warn(
        "event=damaged_signature id={} reason={}", to_int(id), log_value(reason));
}

void IndexFollower::note_sound(ImageId id) {
    if (damaged_.erase(id) != 0)
        damaged_count_ = static_cast<std::int64_t>(damaged_.size());
}

void IndexFollower::merge() {
    for (;;) {
        {
            std::unique_lock lock(wake_mutex_);
            wake_.wait(lock, [this] { return stopping_ || merge_due_; });
            if (stopping_) return;
            merge_due_ = false;
        }
        // One merge may make the next one due; ask for more until there is none.
        if (indexes_.merge_once()) wake_merger();
    }
}

void IndexFollower::wake_merger() {
    {
        const std::lock_guard lock(wake_mutex_);
        merge_due_ = true;
    }
    wake_.notify_all();
}

bool IndexFollower::wait(std::chrono::milliseconds period) {
    std::unique_lock lock(wake_mutex_);
    return !wake_.wait_for(lock, period, [this] { return stopping_; });
}

}  // namespace haarmony::server
