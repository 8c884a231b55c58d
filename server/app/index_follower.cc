#include "server/app/index_follower.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/image/aspect.h"
#include "engine/image/signature_codec.h"
#include "ingest/variant.h"
#include "server/app/log_value.h"

namespace haarmony::server {
namespace {

// Large enough that publishing a snapshot is no cost, small enough that a few megabytes
// are held at a time.
constexpr int kBatch = 4096;
constexpr std::chrono::milliseconds kRetryInterval{500};

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
    const auto started = std::chrono::steady_clock::now();
    std::vector<SearchablePicture> batch;
    batch.reserve(kBatch);
    std::vector<ImageId> loaded;
    const auto flush = [&] {
        indexes_.apply(batch, {});
        for (const SearchablePicture& picture : batch) loaded.push_back(picture.id);
        batch.clear();
        wake_merger();
    };
    const Result<std::int64_t> sequence = connection_->images().for_each_searchable(
        [&](const schema::SearchableImage& image) {
            batch.push_back(read(image));
            if (batch.size() == kBatch) flush();
        });
    flush();
    if (!sequence) {
        // What is deleted before the next attempt would otherwise stay for ever.
        indexes_.apply({}, loaded);
        return sequence.error();
    }
    const std::chrono::duration<double> elapsed =
        std::chrono::steady_clock::now() - started;
    spdlog::info("event=loaded images={} damaged={} sequence={} seconds={:.3f}",
                 loaded.size(),
                 damaged(),
                 sequence.value(),
                 elapsed.count());
    const std::lock_guard lock(apply_mutex_);
    sequence_ = sequence.value();
    loaded_ = true;
    return {};
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
    // No picture has a side of 0, but a row that others wrote may.
    picture.log_aspect =
        image::log_aspect(std::max(1, image.width), std::max(1, image.height));
    const auto add = [&](const std::string& variant,
                         std::span<const std::uint8_t> bytes) {
        Result<image::Signature> signature = image::decode_signature(bytes);
        if (!signature)
            return note_damage(image.id, variant + ": " + signature.error().message);
        picture.signatures.emplace(variant, std::move(signature).value());
    };
    add(ingest::kMainVariant, image.signature);
    for (const schema::SignatureVariant& variant : image.variants)
        add(variant.variant, variant.signature);
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
