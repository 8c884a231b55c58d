#include "engine/image/segment.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <functional>
#include <utility>

namespace haarmony::image {
namespace {

constexpr std::int32_t kLeftOut = -1;

// Postings on their way to a sink, some at a time.
class Outbox {
  public:
    explicit Outbox(const PostingSink& sink) : sink_(sink) { waiting_.reserve(kSome); }

    void send(const PlacedPosting& posting) {
        waiting_.push_back(posting);
        if (waiting_.size() == kSome) flush();
    }
    void flush() {
        if (!waiting_.empty()) sink_(waiting_);
        waiting_.clear();
    }

  private:
    static constexpr std::size_t kSome = 2048;
    const PostingSink& sink_;
    std::vector<PlacedPosting> waiting_;
};

void send_dense(const SegmentView& view,
                std::span<const std::int32_t> place_of,
                Outbox& out) {
    const std::size_t stride = view.counts.row_words();
    const std::size_t words = view.counts.block_words();
    const auto rows = view.rows[std::size_t(view.tiers.top())];
    std::size_t rank = 0;
    for (std::size_t list = 0; list < view.dense_keys.size(); ++list) {
        for (std::size_t word = 0; word < words; ++word) {
            for (std::uint64_t bits = rows[list * stride + word]; bits != 0;
                 bits &= bits - 1) {
                const std::int32_t place =
                    place_of[word * 64 + std::size_t(std::countr_zero(bits))];
                const std::uint8_t its_rank = view.dense_ranks[rank++];
                if (place != kLeftOut)
                    out.send({view.dense_keys[list], std::uint32_t(place), its_rank});
            }
        }
    }
}

// Those of lists that are dense in a tier above are among the dense ones already.
void send_own(const SegmentView& view,
              std::span<const std::int32_t> place_of,
              Outbox& out) {
    const auto top = std::size_t(view.tiers.top());
    for (std::size_t slot = 0; slot < view.counts.slots; ++slot) {
        const std::int32_t place = place_of[slot];
        if (place == kLeftOut) continue;
        std::size_t at = view.own_begin[slot];
        for (int c = 0; c < kChannels; ++c) {
            for (const std::size_t end = at + view.own_counts[slot][c][top]; at < end;
                 ++at) {
                const std::uint32_t key = coefficient_key(c, view.own[at]);
                if (DirectoryEntry(view.directory[key]).dense() == DirectoryEntry::kNone)
                    out.send({key, std::uint32_t(place), view.own_ranks[at]});
            }
        }
    }
}

}  // namespace

int LiveSegment::live() const { return segment->size() - removed_count(removed); }

void for_each_posting(const SegmentView& view,
                      std::span<const std::int32_t> place_of,
                      const PostingSink& sink) {
    Outbox out(sink);
    send_dense(view, place_of, out);
    send_own(view, place_of, out);
    out.flush();
}

Segment::Segment(BuiltSegment built) {
    const std::span<const std::byte> bytes = built.bytes.span();
    view_ = spans_of(built.counts, bytes);
    owner_ = std::shared_ptr<const std::byte[]>(std::move(built.bytes.bytes));
}

std::shared_ptr<const Segment> Segment::from_view(const SegmentView& view,
                                                  std::shared_ptr<const void> owner) {
    return std::shared_ptr<const Segment>(new Segment(view, std::move(owner)));
}

std::shared_ptr<const Segment> Segment::from_records(
    std::span<const Record* const> records,
    int index_m) {
    PictureColumns columns;
    columns.ids.reserve(records.size());
    columns.terms.reserve(records.size());
    for (const Record* record : records) {
        columns.ids.push_back(record->id);
        PictureTerms terms;
        for (int c = 0; c < kChannels; ++c)
            terms.average[c] = record->signature.channels[c].average;
        terms.log_aspect = record->log_aspect;
        columns.terms.push_back(terms);
    }
    assert(std::ranges::adjacent_find(columns.ids, std::greater_equal<>()) ==
           columns.ids.end());
    const auto postings = [&](std::span<const std::uint32_t> places,
                              const PostingSink& sink) {
        std::vector<PlacedPosting> of_picture;
        for (const std::uint32_t place : places) {
            of_picture.clear();
            for (int c = 0; c < kChannels; ++c) {
                std::uint8_t rank = 0;
                for (const std::int16_t signed_index :
                     records[place]->signature.channels[c].largest(index_m)) {
                    of_picture.push_back(
                        {coefficient_key(c, signed_index), place, rank++});
                }
            }
            sink(of_picture);
        }
    };
    return std::shared_ptr<const Segment>(
        new Segment(build_segment(index_m, columns, postings)));
}

std::shared_ptr<const Segment> Segment::merge(std::span<const LiveSegment> parts) {
    struct Source {
        ImageId id;
        std::uint32_t part;
        std::uint32_t slot;
    };
    std::vector<Source> sources;
    std::vector<std::vector<std::int32_t>> place_of;
    for (std::uint32_t p = 0; p < parts.size(); ++p) {
        const Segment& segment = *parts[p].segment;
        // Whole blocks: a row has bits for slots beyond the last, though none is set.
        place_of.emplace_back(std::size_t(segment.view_.counts.blocks()) * kBlockSlots,
                              kLeftOut);
        for (int slot = 0; slot < segment.size(); ++slot) {
            if (is_removed(parts[p].removed, slot)) continue;
            sources.push_back({segment.id(slot), p, std::uint32_t(slot)});
        }
    }
    if (sources.empty()) return nullptr;
    std::ranges::sort(sources, {}, &Source::id);

    PictureColumns columns;
    columns.ids.reserve(sources.size());
    columns.terms.reserve(sources.size());
    for (const Source& source : sources) {
        place_of[source.part][source.slot] =
            static_cast<std::int32_t>(columns.ids.size());
        columns.ids.push_back(source.id);
        columns.terms.push_back(parts[source.part].segment->view_.terms[source.slot]);
    }
    const auto index_m = parts[0].segment->view_.counts.index_m;
    const auto postings = [&](std::span<const std::uint32_t>, const PostingSink& sink) {
        for (std::size_t p = 0; p < parts.size(); ++p) {
            assert(parts[p].segment->view_.counts.index_m == index_m);
            for_each_posting(parts[p].segment->view_, place_of[p], sink);
        }
    };
    return std::shared_ptr<const Segment>(
        new Segment(build_segment(static_cast<int>(index_m), columns, postings)));
}

std::optional<int> Segment::find(ImageId id) const {
    const auto found = std::ranges::lower_bound(
        view_.slots_by_id, to_int(id), {}, [this](auto slot) { return view_.ids[slot]; });
    if (found == view_.slots_by_id.end() || view_.ids[*found] != to_int(id))
        return std::nullopt;
    return static_cast<int>(*found);
}

}  // namespace haarmony::image
