#include "engine/image/segment.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <utility>

#include "engine/image/score_kernel.h"

namespace haarmony::image {

int LiveSegment::live() const { return segment->size() - removed_count(removed); }

Segment::Segment(std::vector<ImageId> ids, Columns columns, SearchArrays arrays)
    : ids_(std::move(ids)), columns_(std::move(columns)), arrays_(std::move(arrays)) {
    assert(!ids_.empty() && ids_.size() <= std::size_t{kMaxSlots});
    assert(std::ranges::adjacent_find(ids_, std::greater_equal<>()) == ids_.end());
}

std::shared_ptr<const Segment> Segment::from_records(
    std::span<const Record* const> records,
    int index_m) {
    std::vector<ImageId> ids;
    Columns columns;
    ids.reserve(records.size());
    columns.log_aspects.reserve(records.size());
    for (const Record* record : records) {
        ids.push_back(record->id);
        columns.log_aspects.push_back(record->log_aspect);
    }
    for (int c = 0; c < kChannels; ++c) {
        columns.averages[c].reserve(records.size());
        for (const Record* record : records) {
            columns.averages[c].push_back(record->signature.channels[c].average);
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
        new Segment(std::move(ids), std::move(columns), std::move(arrays)));
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
    Columns columns;
    for (const Source& source : sources) {
        const auto slot = std::size_t(source.slot);
        const Columns& old = parts[source.part].segment->columns_;
        new_slot[source.part][slot] = static_cast<int>(ids.size());
        ids.push_back(source.id);
        columns.log_aspects.push_back(old.log_aspects[slot]);
        for (int c = 0; c < kChannels; ++c) {
            columns.averages[c].push_back(old.averages[c][slot]);
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
        new Segment(std::move(ids), std::move(columns), std::move(arrays)));
}

std::optional<int> Segment::find(ImageId id) const {
    if (id < ids_.front() || id > ids_.back()) return std::nullopt;
    const auto found = std::ranges::lower_bound(ids_, id);
    if (*found != id) return std::nullopt;
    return static_cast<int>(found - ids_.begin());
}

void Segment::score(const Query& query, SegmentScores& scores) const {
    scores.matched.assign(ids_.size(), 0);
    scores.scores.resize(ids_.size());
    arrays_.add_matches(query, scores.matched);
    const auto& averages = columns_.averages;
    score_slots(query,
                {{averages[0], averages[1], averages[2]}, columns_.log_aspects},
                scores.matched,
                scores.scores);
}

int Segment::search(const Query& query,
                    const TombstonesPtr& removed,
                    const IdSet* only,
                    SegmentScores& scores,
                    TopK& top) const {
    score(query, scores);
    if (only == nullptr) {
        for (int slot = 0; slot < size(); ++slot) {
            const Score score = scores.scores[std::size_t(slot)];
            if (top.admits(score) && !is_removed(removed, slot))
                top.offer({id(slot), score});
        }
        return size() - removed_count(removed);
    }
    int searched = 0;
    for (int slot = 0; slot < size(); ++slot) {
        if (!only->contains(id(slot)) || is_removed(removed, slot)) continue;
        ++searched;
        top.offer({id(slot), scores.scores[std::size_t(slot)]});
    }
    return searched;
}

void Segment::score_all(const Query& query,
                        const TombstonesPtr& removed,
                        const IdSet* only,
                        SegmentScores& scores,
                        std::vector<Match>& out) const {
    score(query, scores);
    for (int slot = 0; slot < size(); ++slot) {
        if (is_removed(removed, slot)) continue;
        if (only != nullptr && !only->contains(id(slot))) continue;
        out.push_back({id(slot), scores.scores[std::size_t(slot)]});
    }
}

std::int64_t Segment::bytes() const {
    const std::size_t per_slot = sizeof(ImageId) + (kChannels + 1) * sizeof(std::int32_t);
    return arrays_.bytes() + std::int64_t(ids_.size() * per_slot);
}

}  // namespace haarmony::image
