#include "engine/image/segment.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <utility>

#include "engine/image/packed_pictures.h"
#include "engine/image/picture_source.h"
#include "engine/image/segment_pictures.h"

namespace haarmony::image {

int LiveSegment::live() const { return segment->size() - removed_count(removed); }

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
    return std::shared_ptr<const Segment>(
        new Segment(build_segment(index_m, columns, RecordPictures(records, index_m))));
}

std::shared_ptr<const Segment> Segment::from_pictures(const PackedPictures& pictures) {
    return std::shared_ptr<const Segment>(
        new Segment(build_segment(pictures.index_m(), pictures.columns(), pictures)));
}

std::shared_ptr<const Segment> Segment::merge(std::span<const LiveSegment> parts) {
    struct Source {
        ImageId id;
        std::uint32_t part;
        std::uint32_t slot;
    };
    std::vector<Source> sources;
    std::vector<SegmentPictures::Part> read;
    for (std::uint32_t p = 0; p < parts.size(); ++p) {
        const Segment& segment = *parts[p].segment;
        read.push_back(
            {segment.view(),
             std::vector(std::size_t(segment.size()), SegmentPictures::kLeftOut)});
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
        read[source.part].place_of[source.slot] =
            static_cast<std::int32_t>(columns.ids.size());
        columns.ids.push_back(source.id);
        columns.terms.push_back(parts[source.part].segment->view_.terms[source.slot]);
    }
    std::vector<Source>().swap(sources);  // nothing below needs its 16 bytes a picture
    const auto index_m = static_cast<int>(parts[0].segment->view_.counts.index_m);
    const SegmentPictures pictures(std::move(read), columns.ids.size());
    return std::shared_ptr<const Segment>(
        new Segment(build_segment(index_m, columns, pictures)));
}

std::optional<int> Segment::find(ImageId id) const {
    const auto found = std::ranges::lower_bound(
        view_.slots_by_id, to_int(id), {}, [this](auto slot) { return view_.ids[slot]; });
    if (found == view_.slots_by_id.end() || view_.ids[*found] != to_int(id))
        return std::nullopt;
    return static_cast<int>(*found);
}

}  // namespace haarmony::image
