#include "engine/image/segment.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <utility>

#include "engine/image/score_kernel.h"

namespace haarmony::image {

int LiveSegment::live() const { return segment->size() - removed_count(removed); }

Segment::Segment(std::vector<ImageId> ids, Averages averages, SearchArrays arrays)
    : ids_(std::move(ids)), averages_(std::move(averages)), arrays_(std::move(arrays)) {
    assert(!ids_.empty() && ids_.size() <= std::size_t{kMaxSlots});
    assert(std::ranges::adjacent_find(ids_, std::greater_equal<>()) == ids_.end());
}

std::shared_ptr<const Segment> Segment::from_records(
    std::span<const Record* const> records,
    int index_m) {
    std::vector<ImageId> ids;
    Averages averages;
    ids.reserve(records.size());
    for (const Record* record : records) ids.push_back(record->id);
    for (int c = 0; c < kChannels; ++c) {
        averages[c].reserve(records.size());
        for (const Record* record : records) {
            averages[c].push_back(record->signature.channels[c].average);
        }
    }
    SearchArrays arrays(index_m, [&](const auto& sink) {
        for (std::size_t slot = 0; slot < records.size(); ++slot) {
            for (int c = 0; c < kChannels; ++c) {
                int rank = 0;
                for (const std::int16_t signed_index :
                     records[slot]->signature.channels[c].largest(index_m)) {
                    sink(Posting{coefficient_key(c, signed_index), int(slot), rank++});
                }
            }
        }
    });
    return std::shared_ptr<const Segment>(
        new Segment(std::move(ids), std::move(averages), std::move(arrays)));
}

std::shared_ptr<const Segment> Segment::merge(std::span<const LiveSegment> parts) {
    struct Source {
        ImageId id;
        int part;
        int slot;
    };
    std::vector<Source> sources;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        for (int slot = 0; slot < parts[p].segment->size(); ++slot) {
            if (is_removed(parts[p].removed, slot)) continue;
            sources.push_back({parts[p].segment->id(slot), int(p), slot});
        }
    }
    if (sources.empty()) return nullptr;
    std::ranges::sort(sources, {}, &Source::id);

    constexpr int kGone = -1;
    std::vector<std::vector<int>> new_slot;
    for (const LiveSegment& part : parts)
        new_slot.emplace_back(part.segment->size(), kGone);
    std::vector<ImageId> ids;
    Averages averages;
    for (const Source& source : sources) {
        new_slot[source.part][source.slot] = static_cast<int>(ids.size());
        ids.push_back(source.id);
        for (int c = 0; c < kChannels; ++c) {
            averages[c].push_back(
                parts[source.part].segment->averages_[c][std::size_t(source.slot)]);
        }
    }
    const int index_m = parts[0].segment->arrays_.index_m();
    SearchArrays arrays(index_m, [&](const auto& sink) {
        for (std::size_t p = 0; p < parts.size(); ++p) {
            const SearchArrays& old = parts[p].segment->arrays_;
            assert(old.index_m() == index_m);
            old.for_each_posting([&](Posting posting) {
                posting.slot = new_slot[p][posting.slot];
                if (posting.slot != kGone) sink(posting);
            });
        }
    });
    return std::shared_ptr<const Segment>(
        new Segment(std::move(ids), std::move(averages), std::move(arrays)));
}

std::optional<int> Segment::find(ImageId id) const {
    if (id < ids_.front() || id > ids_.back()) return std::nullopt;
    const auto found = std::ranges::lower_bound(ids_, id);
    if (*found != id) return std::nullopt;
    return static_cast<int>(found - ids_.begin());
}

void Segment::search(const Query& query,
                     const TombstonesPtr& removed,
                     SegmentScores& scores,
                     TopK& top) const {
    scores.matched.assign(ids_.size(), 0);
    scores.scores.resize(ids_.size());
    arrays_.add_matches(query, scores.matched);
    score_slots(
        query, {averages_[0], averages_[1], averages_[2]}, scores.matched, scores.scores);
    for (int slot = 0; slot < size(); ++slot) {
        const Score score = scores.scores[std::size_t(slot)];
        if (top.admits(score) && !is_removed(removed, slot)) top.offer({id(slot), score});
    }
}

std::int64_t Segment::bytes() const {
    const std::size_t per_slot = sizeof(ImageId) + kChannels * sizeof(std::int32_t);
    return arrays_.bytes() + std::int64_t(ids_.size() * per_slot);
}

}  // namespace haarmony::image
