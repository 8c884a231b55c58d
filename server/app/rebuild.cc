#include "server/app/rebuild.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <span>

#include "engine/image/segment.h"
#include "server/app/stored_signatures.h"

namespace haarmony::server {
namespace {

// Fewer pictures are not worth another segment: its directory alone has 192 KB.
constexpr std::int64_t kFewPictures = 8192;

std::int64_t ceil_divide(std::int64_t a, std::int64_t b) { return (a + b - 1) / b; }

Error stopped() {
    return {ErrorCode::kUnavailable, "loading the signatures was stopped"};
}

void append_segments(std::span<const image::Record> records,
                     int index_m,
                     std::vector<image::LiveSegment>& segments) {
    std::vector<const image::Record*> block;
    for (std::span<const image::Record> rest = records; !rest.empty();) {
        // Pictures that came meanwhile may make it more than one.
        const auto first =
            rest.first(std::min(rest.size(), std::size_t{image::kMaxSegmentSlots}));
        block.clear();
        for (const image::Record& record : first) block.push_back(&record);
        segments.push_back({image::Segment::from_records(block, index_m), nullptr});
        rest = rest.subspan(first.size());
    }
}

Result<Rebuilt> rebuild_range(ReadConnections& connections,
                              const schema::IdRange& range,
                              int most,
                              const RebuildOptions& options) {
    const auto connection = connections.lend();
    if (!connection) return connection.error();
    auto records =
        read_records((*connection)->images(), range, std::size_t(most), options.go_on);
    if (!records) return std::move(records).error();
    Rebuilt part;
    part.sequence = records->sequence;
    part.images = records->images;
    part.damaged = std::move(records->damaged);
    for (auto& [variant, of_variant] : records->variants) {
        if (!options.go_on()) return stopped();
        append_segments(of_variant, options.index_m, part.segments[variant]);
        of_variant = {};
    }
    return part;
}

}  // namespace

Result<StoredRecords> read_records(schema::ImageStore& images,
                                   const schema::IdRange& range,
                                   std::size_t most,
                                   const std::function<bool()>& go_on) {
    StoredRecords records;
    records.variants[ingest::kMainVariant].reserve(most);
    bool interrupted = false;
    const auto sequence =
        images.for_each_searchable(range, [&](const schema::SearchableImage& image) {
            ++records.images;
            decode_signatures(
                image,
                [&](const std::string& variant, image::Signature&& signature) {
                    image::Record& record = records.variants[variant].emplace_back();
                    record.id = image.id;
                    record.signature = std::move(signature);
                    record.log_aspect = log_aspect_of(image);
                },
                [&](std::string reason) {
                    records.damaged.push_back({image.id, std::move(reason)});
                });
            interrupted = !go_on();
            return !interrupted;
        });
    if (!sequence) return sequence.error();
    if (interrupted) return stopped();
    records.sequence = sequence.value();
    return records;
}

int pictures_per_segment(std::int64_t images, int threads) {
    assert(images >= 0 && threads >= 1);
    const std::int64_t fewest = ceil_divide(images, image::kMaxSegmentSlots);
    const std::int64_t useful = std::min<std::int64_t>(threads, images / kFewPictures);
    const std::int64_t segments = std::max({std::int64_t{1}, fewest, useful});
    return static_cast<int>(std::max<std::int64_t>(1, ceil_divide(images, segments)));
}

Result<Rebuilt> rebuild(ReadConnections& connections,
                        const RebuildOptions& options,
                        Executor& executor) {
    Rebuilt all;
    int size = 0;
    std::vector<schema::IdRange> ranges;
    {
        const auto connection = connections.lend();
        if (!connection) return connection.error();
        schema::ImageStore& images = (*connection)->images();
        const auto counts = images.counts();
        if (!counts) return counts.error();
        size = pictures_per_segment(counts->indexed, options.threads);
        auto found = images.searchable_ranges(size);
        if (!found) return std::move(found).error();
        ranges = std::move(found).value();
    }
    std::vector<std::optional<Result<Rebuilt>>> parts(ranges.size());
    executor.parallel_for(ranges.size(), [&](std::size_t i) {
        parts[i].emplace(rebuild_range(connections, ranges[i], size, options));
    });
    for (std::size_t i = 0; i < parts.size(); ++i) {
        Result<Rebuilt>& part = *parts[i];
        if (!part) return std::move(part).error();
        all.sequence = i == 0 ? part->sequence : std::min(all.sequence, part->sequence);
        all.images += part->images;
        std::ranges::move(part->damaged, std::back_inserter(all.damaged));
        for (auto& [variant, segments] : part->segments)
            std::ranges::move(segments, std::back_inserter(all.segments[variant]));
    }
    return all;
}

}  // namespace haarmony::server
