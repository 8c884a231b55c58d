#include "server/app/snapshot_reader.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>
#include <utility>

namespace haarmony::server {
namespace {

Error damaged(std::size_t part, const std::string& what) {
    return {ErrorCode::kUndecodable,
            "the snapshot is damaged: part " + std::to_string(part) + ": " + what};
}

Result<image::TombstonesPtr> read_removed(std::span<const std::byte> bytes, int slots) {
    const auto removed = std::make_shared<image::Tombstones>(slots);
    for (std::size_t word = 0; word < bytes.size() / sizeof(std::uint64_t); ++word) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, bytes.data() + word * sizeof bits, sizeof bits);
        for (; bits != 0; bits &= bits - 1) {
            const int slot = int(word) * 64 + std::countr_zero(bits);
            if (slot >= slots)
                return Error{ErrorCode::kUndecodable,
                             "slot " + std::to_string(slot) + " of " +
                                 std::to_string(slots) + " is removed"};
            removed->set(slot);
        }
    }
    return image::TombstonesPtr(removed);
}

// One part, `extent` being all that it takes of the file.
Result<image::LiveSegment> read_part(const std::shared_ptr<const MappedFile>& file,
                                     std::size_t number,
                                     const SnapshotPart& part,
                                     std::span<const std::byte> extent,
                                     const PartChecks& checks) {
    MappedFile::expect(extent);
    const std::size_t segment_extent = aligned_in_snapshot(part.segment_bytes);
    const auto removed_extent = extent.subspan(segment_extent);
    if (snapshot_checksum(extent.first(segment_extent)) != part.segment_checksum)
        return damaged(number, "the checksum of its segment is another");
    if (part.has_removed && snapshot_checksum(removed_extent) != part.removed_checksum)
        return damaged(number, "the checksum of its removals is another");
    const auto view = checks.view(part.counts, extent.first(part.segment_bytes));
    if (!view) return damaged(number, view.error().message);
    image::LiveSegment live{image::Segment::from_view(view.value(), file), nullptr};
    if (part.has_removed) {
        auto removed = read_removed(removed_extent.first(part.removed_bytes()),
                                    int(part.counts.slots));
        if (!removed) return damaged(number, removed.error().message);
        live.removed = std::move(removed).value();
    }
    if (checks.forget) MappedFile::forget(extent);
    return live;
}

}  // namespace

Result<std::vector<image::LiveSegment>> read_parts(
    const std::shared_ptr<const MappedFile>& file,
    const SnapshotTable& table,
    const PartChecks& checks,
    Executor& executor) {
    std::vector<std::span<const std::byte>> extents;
    std::span<const std::byte> rest = file->bytes().subspan(table.parts_begin());
    for (const SnapshotPart& part : table.parts) {
        extents.push_back(rest.first(part.extent()));
        rest = rest.subspan(part.extent());
    }
    std::vector<std::optional<Result<image::LiveSegment>>> read(extents.size());
    executor.parallel_for(extents.size(), [&](std::size_t i) {
        read[i].emplace(read_part(file, i, table.parts[i], extents[i], checks));
    });
    std::vector<image::LiveSegment> segments;
    for (auto& segment : read) {
        if (!*segment) return segment->error();
        segments.push_back(std::move(*segment).value());
    }
    return segments;
}

Result<SnapshotContents> read_snapshot(
    const std::string& path,
    int index_m,
    const std::function<Result<void>(const SnapshotTable&)>& belongs,
    Executor& executor) {
    const auto file = MappedFile::open(path);
    if (!file) return file.error();
    const Result<SnapshotTable> table = decode_table((*file)->bytes());
    if (!table) return table.error();
    if (table->index_m != std::uint32_t(index_m))
        return Error{ErrorCode::kConflict,
                     "the snapshot has " + std::to_string(table->index_m) +
                         " coefficients a channel, not " + std::to_string(index_m)};
    if (Result<void> own = belongs(table.value()); !own) return own.error();
    auto segments =
        read_parts(*file, table.value(), {image::view_known_segment, false}, executor);
    if (!segments) return std::move(segments).error();
    SnapshotContents contents;
    contents.sequence = table->sequence;
    contents.index_m = index_m;
    contents.damaged = table->damaged;
    for (const std::string& variant : table->variants) contents.segments[variant];
    for (std::size_t i = 0; i < segments->size(); ++i)
        contents.segments[table->variants[table->parts[i].variant]].push_back(
            std::move((*segments)[i]));
    return contents;
}

}  // namespace haarmony::server
