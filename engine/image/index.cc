#include "engine/image/index.h"

#include <algorithm>
#include <cassert>
#include <mutex>
#include <set>
#include <unordered_map>
#include <utility>

#include "engine/image/collection.h"
#include "engine/image/collection_search.h"
#include "engine/image/merge_plan.h"

namespace haarmony::image {
namespace {

class PublishedCollection final : public IndexSnapshot {
  public:
    explicit PublishedCollection(Collection collection)
        : collection_(std::move(collection)) {}

    [[nodiscard]] SearchResult search(const Query& query,
                                      const SearchScope& scope) const override {
        return image::search(collection_, query, scope);
    }
    [[nodiscard]] std::vector<Match> score_all(const Query& query,
                                               const IdSet* only) const override {
        return image::score_all(collection_, query, only);
    }
    [[nodiscard]] IndexStats stats() const override { return image::stats(collection_); }
    [[nodiscard]] std::vector<LiveSegment> sealed() const override {
        return image::sealed(collection_);
    }
    [[nodiscard]] const Collection& collection() const { return collection_; }

  private:
    Collection collection_;
};

// The last version of each id, in rising order of id, without those in `removals`.
// Requires: removals in rising order.
std::vector<const Record*> last_versions(std::span<const Record> upserts,
                                         std::span<const ImageId> removals) {
    std::vector<const Record*> versions;
    versions.reserve(upserts.size());
    for (const Record& record : upserts) versions.push_back(&record);
    std::ranges::stable_sort(versions, {}, &Record::id);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < versions.size(); ++i) {
        const ImageId id = versions[i]->id;
        const bool is_last = i + 1 == versions.size() || versions[i + 1]->id != id;
        if (is_last && !std::ranges::binary_search(removals, id)) {
            versions[kept++] = versions[i];
        }
    }
    versions.resize(kept);
    return versions;
}

}  // namespace

class Index::State {
  public:
    explicit State(const IndexOptions& options) : options_(options) {
        assert(options.index_m >= 1 && options.index_m <= kMaxCoefficients);
        assert(options.tail_capacity >= 1 && options.tail_capacity <= kMaxSegmentSlots);
        publish(with_empty_tail({}));
    }

    void apply(std::span<const Record> upserts, std::span<const ImageId> removals);
    void reset(std::vector<LiveSegment> segments, SegmentOrigin origin);
    bool merge_once();

    [[nodiscard]] std::shared_ptr<const PublishedCollection> published() const {
        const std::lock_guard lock(publish_mutex_);
        return published_;
    }
    [[nodiscard]] int index_m() const { return options_.index_m; }

  private:
    void publish(Collection collection) {
        auto next = std::make_shared<const PublishedCollection>(std::move(collection));
        const std::lock_guard lock(publish_mutex_);
        published_.swap(next);
    }

    Collection with_empty_tail(std::vector<LiveSegment> segments) {
        Collection collection;
        collection.index_m = options_.index_m;
        collection.segments = std::move(segments);
        start_tail(collection);
        return collection;
    }

    [[nodiscard]] std::vector<LiveSegment> due_parts() const;
    bool prove(std::span<const LiveSegment> parts);
    void start_tail(Collection& collection);
    void remove_from_tail(Collection& collection, std::span<const ImageId> ids);
    void append_to_tail(Collection& collection, std::span<const Record* const> records);
    void seal_with(Collection& collection, std::vector<const Record*> records);

    const IndexOptions options_;

    // One merge at a time; taken before write_mutex_, and guards the next two.
    std::mutex merge_mutex_;
    // Those from a file that were not checked completely yet, or found damaged.
    std::set<std::shared_ptr<const Segment>> unproven_;
    std::set<std::shared_ptr<const Segment>> damaged_;
    std::mutex write_mutex_;  // one writer at a time; guards the next two
    std::shared_ptr<Tail> tail_;
    std::unordered_map<std::int64_t, int> slot_in_tail_;  // of the live ones

    mutable std::mutex publish_mutex_;  // held only while the pointer is copied
    std::shared_ptr<const PublishedCollection> published_;
};

void Index::State::start_tail(Collection& collection) {
    tail_ = std::make_shared<Tail>(options_.tail_capacity);
    slot_in_tail_.clear();
    collection.tail = LiveTail{tail_, 0, nullptr};
}

void Index::State::remove_from_tail(Collection& collection,
                                    std::span<const ImageId> ids) {
    std::shared_ptr<Tombstones> removed;
    for (const ImageId id : ids) {
        const auto found = slot_in_tail_.find(to_int(id));
        if (found == slot_in_tail_.end()) continue;
        if (removed == nullptr) {
            const TombstonesPtr& before = collection.tail.removed;
            removed = before == nullptr ? std::make_shared<Tombstones>(tail_->capacity())
                                        : std::make_shared<Tombstones>(*before);
        }
        removed->set(found->second);
        slot_in_tail_.erase(found);
    }
    if (removed != nullptr) collection.tail.removed = std::move(removed);
}

void Index::State::append_to_tail(Collection& collection,
                                  std::span<const Record* const> records) {
    for (const Record* record : records) {
        const int slot = collection.tail.count++;
        tail_->write(slot, *record);
        slot_in_tail_[to_int(record->id)] = slot;
    }
}

// Seals the tail and `records` together; the tail starts anew.
void Index::State::seal_with(Collection& collection, std::vector<const Record*> records) {
    const LiveTail tail = collection.tail;
    for (int slot = 0; slot < tail.count; ++slot) {
        if (!is_removed(tail.removed, slot)) records.push_back(&(*tail.records)[slot]);
    }
    std::ranges::sort(records, {}, &Record::id);
    for (std::span<const Record* const> rest = records; !rest.empty();) {
        const auto block =
            rest.first(std::min(rest.size(), std::size_t{kMaxSegmentSlots}));
        collection.segments.push_back(
            {Segment::from_records(block, options_.index_m), nullptr});
        rest = rest.subspan(block.size());
    }
    start_tail(collection);
}

void Index::State::apply(std::span<const Record> upserts,
                         std::span<const ImageId> removals) {
    std::vector<ImageId> removed(removals.begin(), removals.end());
    std::ranges::sort(removed);
    std::vector<const Record*> added = last_versions(upserts, removed);
    for (const Record* record : added) removed.push_back(record->id);

    const std::lock_guard lock(write_mutex_);
    Collection next = published()->collection();
    remove(next, removed);
    remove_from_tail(next, removed);
    if (next.tail.count + std::int64_t(added.size()) <= options_.tail_capacity) {
        append_to_tail(next, added);
    } else {
        seal_with(next, std::move(added));
    }
    publish(std::move(next));
}

void Index::State::reset(std::vector<LiveSegment> segments, SegmentOrigin origin) {
    const std::lock_guard merging(merge_mutex_);
    damaged_.clear();
    unproven_.clear();
    if (origin == SegmentOrigin::kFile) {
        for (const LiveSegment& part : segments) unproven_.insert(part.segment);
    }
    const std::lock_guard lock(write_mutex_);
    publish(with_empty_tail(std::move(segments)));
}

std::vector<LiveSegment> Index::State::due_parts() const {
    std::vector<LiveSegment> sound;
    std::vector<SegmentSize> sizes;
    // Another thread may publish the next state meanwhile: this one is held on to.
    const std::shared_ptr<const PublishedCollection> now = published();
    for (const LiveSegment& part : now->collection().segments) {
        if (damaged_.contains(part.segment)) continue;
        sound.push_back(part);
        sizes.push_back({part.segment->size(), part.live()});
    }
    std::vector<LiveSegment> parts;
    for (const std::size_t i : plan_merge(sizes)) parts.push_back(sound[i]);
    return parts;
}

// Whether all of them may be merged.
bool Index::State::prove(std::span<const LiveSegment> parts) {
    for (const LiveSegment& part : parts) {
        if (unproven_.erase(part.segment) == 0) continue;
        const SegmentView& view = part.segment->view();
        if (!view_segment(view.counts, bytes_of(view))) damaged_.insert(part.segment);
    }
    return std::ranges::none_of(
        parts, [&](const LiveSegment& part) { return damaged_.contains(part.segment); });
}

bool Index::State::merge_once() {
    const std::lock_guard merging(merge_mutex_);
    std::vector<LiveSegment> parts = due_parts();
    // Each turn finds out about a damaged one, so there is an end.
    while (!prove(parts)) parts = due_parts();
    if (parts.empty()) return false;
    const std::shared_ptr<const Segment> merged = Segment::merge(parts);

    const std::lock_guard lock(write_mutex_);
    Collection next = published()->collection();
    replace_segments(next, parts, merged);
    publish(std::move(next));
    return true;
}

Index::Index(const IndexOptions& options) : state_(std::make_unique<State>(options)) {}
Index::~Index() = default;

void Index::apply(std::span<const Record> upserts, std::span<const ImageId> removals) {
    state_->apply(upserts, removals);
}

void Index::reset(std::vector<LiveSegment> segments, SegmentOrigin origin) {
    state_->reset(std::move(segments), origin);
}

bool Index::merge_once() { return state_->merge_once(); }

std::shared_ptr<const IndexSnapshot> Index::snapshot() const {
    return state_->published();
}

int Index::index_m() const { return state_->index_m(); }

}  // namespace haarmony::image
