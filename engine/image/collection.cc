#include "engine/image/collection.h"

#include <algorithm>
#include <cassert>

namespace haarmony::image {
namespace {

// A set of tombstones that is copied when it is first changed.
class TombstonesInWork {
  public:
    TombstonesInWork(TombstonesPtr& published, int slots)
        : published_(&published), slots_(slots) {}

    // Whether the slot was live.
    bool set(int slot) {
        if (is_removed(*published_, slot)) return false;
        if (copy_ == nullptr) {
            copy_ = *published_ == nullptr ? std::make_shared<Tombstones>(slots_)
                                           : std::make_shared<Tombstones>(**published_);
            *published_ = copy_;
        }
        copy_->set(slot);
        return true;
    }

  private:
    TombstonesPtr* published_;
    int slots_;
    std::shared_ptr<Tombstones> copy_;
};

}  // namespace

IndexStats stats(const Collection& collection) {
    const LiveTail& tail = collection.tail;
    IndexStats stats;
    stats.images = tail.live();
    stats.tombstones = removed_count(tail.removed);
    stats.segments = std::int64_t(collection.segments.size());
    stats.tail = tail.count;
    stats.bytes = tail.records->bytes();
    if (tail.removed != nullptr) stats.bytes += tail.removed->bytes();
    for (const LiveSegment& part : collection.segments) {
        stats.images += part.live();
        stats.tombstones += removed_count(part.removed);
        stats.bytes += std::int64_t(part.segment->bytes().total);
        stats.rank_bytes += std::int64_t(part.segment->bytes().total -
                                         part.segment->bytes().without_ranks);
        if (part.removed != nullptr) stats.bytes += part.removed->bytes();
    }
    return stats;
}

std::vector<LiveSegment> sealed(const Collection& collection) {
    std::vector<LiveSegment> segments = collection.segments;
    const LiveTail& tail = collection.tail;
    std::vector<const Record*> newest;
    for (int slot = 0; slot < tail.count; ++slot) {
        if (!is_removed(tail.removed, slot)) newest.push_back(&(*tail.records)[slot]);
    }
    std::ranges::sort(newest, {}, &Record::id);
    if (!newest.empty())
        segments.push_back({Segment::from_records(newest, collection.index_m), nullptr});
    return segments;
}

void remove(Collection& collection, std::span<const ImageId> ids) {
    std::vector<TombstonesInWork> tombstones;
    tombstones.reserve(collection.segments.size());
    for (LiveSegment& part : collection.segments) {
        tombstones.emplace_back(part.removed, part.segment->size());
    }
    for (const ImageId id : ids) {
        for (std::size_t i = 0; i < tombstones.size(); ++i) {
            const auto slot = collection.segments[i].segment->find(id);
            if (slot && tombstones[i].set(*slot)) break;  // live in one place at most
        }
    }
}

void replace_segments(Collection& collection,
                      std::span<const LiveSegment> parts,
                      const std::shared_ptr<const Segment>& merged) {
    LiveSegment replacement{merged, nullptr};
    std::vector<ImageId> gone;
    for (const LiveSegment& before : parts) {
        const auto now =
            std::ranges::find(collection.segments, before.segment, &LiveSegment::segment);
        assert(now != collection.segments.end());
        for (int slot = 0; slot < before.segment->size(); ++slot) {
            if (is_removed(now->removed, slot) && !is_removed(before.removed, slot)) {
                gone.push_back(before.segment->id(slot));
            }
        }
        collection.segments.erase(now);
    }
    if (merged == nullptr) return;
    TombstonesInWork tombstones(replacement.removed, merged->size());
    for (const ImageId id : gone) {
        const auto slot = merged->find(id);
        assert(slot);
        tombstones.set(*slot);
    }
    if (replacement.live() > 0) collection.segments.push_back(std::move(replacement));
}

}  // namespace haarmony::image
