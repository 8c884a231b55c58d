#include "engine/video/mrv_format.h"

#include <xxhash.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <optional>
#include <string>
#include <tuple>

#include "engine/video/byte_stream.h"

namespace haarmony::video {
namespace {

constexpr char kMagic[8] = {'H', 'A', 'A', 'R', 'M', 'R', 'V', '\n'};
constexpr std::size_t kSlots = 2;
static_assert(kMrvSlotsAt + kSlots * kMrvSlotBytes == kMrvHeaderBytes);

bool before(const SiblingAddress& a, const SiblingAddress& b) {
    return std::tie(a.time_level, a.index) < std::tie(b.time_level, b.index);
}

Error damaged(const std::string& what) { return {ErrorCode::kUndecodable, what}; }
Error damaged_file(const std::string& what) { return damaged(".mrv file: " + what); }

std::vector<std::byte> encode_index(const MrvFront& front) {
    std::vector<std::byte> out;
    const MrvIndex& index = front.index;
    std::size_t ordinal = 0;
    for (int level = 0; level <= front.shape.time_levels(); ++level) {
        const std::size_t begin = ordinal;
        while (ordinal < index.siblings() && index.address(ordinal).time_level == level)
            ++ordinal;
        put_varint(out, ordinal - begin);
        std::int64_t next = 0;
        for (std::size_t i = begin; i < ordinal; ++i) {
            put_varint(out, static_cast<std::uint64_t>(index.address(i).index - next));
            next = index.address(i).index + 1;
        }
    }
    for (int row = 0; row < index.rows(); ++row) {
        for (std::size_t i = 0; i < index.siblings(); ++i) {
            const MrvChunk& chunk = index.chunk(row, i);
            if (row > 0) {
                put_varint(out, chunk.size.nodes);
                put_varint(out, chunk.size.bricks);
                if (chunk.size.empty()) continue;
            }
            put_varint(out, chunk.bytes);
            put_fixed(out, chunk.checksum);
        }
    }
    return out;
}

// What the table says of a generation.
struct Record {
    std::int64_t frames = 0;
    std::uint64_t siblings = 0;
    std::uint64_t index_bytes = 0;
    std::uint64_t end = 0;
    std::uint64_t index_checksum = 0;
};

void put_record(std::vector<std::byte>& out, const Record& record) {
    put_fixed(out, record.frames);
    put_fixed(out, record.siblings);
    put_fixed(out, record.index_bytes);
    put_fixed(out, record.end);
    put_fixed(out, record.index_checksum);
}

Record read_record(ByteReader& in) {
    Record record;
    record.frames = in.fixed<std::int64_t>();
    record.siblings = in.fixed<std::uint64_t>();
    record.index_bytes = in.fixed<std::uint64_t>();
    record.end = in.fixed<std::uint64_t>();
    record.index_checksum = in.fixed<std::uint64_t>();
    return record;
}

// What never changes in a file.
std::vector<std::byte> header_begin(const MrvFront& front) {
    std::vector<std::byte> out(sizeof kMagic);
    std::memcpy(out.data(), kMagic, sizeof kMagic);
    put_fixed(out, kMrvVersion);
    put_fixed(out, front.shape.width());
    put_fixed(out, front.shape.height());
    put_fixed(out, front.shape.rate().numerator);
    put_fixed(out, front.shape.rate().denominator);
    put_fixed(out, front.delta);
    assert(out.size() == kMrvSlotsAt);
    return out;
}

std::uint64_t revision_of(std::span<const std::byte> begin,
                          std::span<const std::byte> slot) {
    std::vector<std::byte> all(begin.begin(), begin.end());
    all.insert(all.end(), slot.begin(), slot.end());
    return mrv_checksum(all);
}

struct Slot {
    std::uint64_t generations = 0;
    std::uint64_t table = 0;  // where the table of generations begins
    std::uint64_t table_checksum = 0;
    std::uint64_t revision = 0;
};

// A slot that was not written to its end is as if it were not there.
std::optional<Slot> newest_slot(std::span<const std::byte> header) {
    std::optional<Slot> newest;
    for (std::size_t i = 0; i < kSlots; ++i) {
        const auto bytes = header.subspan(kMrvSlotsAt + i * kMrvSlotBytes, kMrvSlotBytes);
        ByteReader in(bytes);
        Slot slot;
        slot.generations = in.fixed<std::uint64_t>();
        slot.table = in.fixed<std::uint64_t>();
        slot.table_checksum = in.fixed<std::uint64_t>();
        slot.revision = in.fixed<std::uint64_t>();
        const auto checked = bytes.first(kMrvSlotBytes - sizeof slot.revision);
        if (slot.revision != revision_of(header.first(kMrvSlotsAt), checked)) continue;
        if ((slot.generations - 1) % kSlots != i) continue;
        if (!newest || slot.generations > newest->generations) newest = slot;
    }
    return newest;
}

// How many siblings a time level may have.
std::int64_t most_siblings(const ClipShape& shape, int time_level) {
    return time_level == 0 ? 1 : shape.nodes_at(time_level - 1);
}

// `kept` frames are of an older generation, and so are the siblings below what they complete.
Result<std::vector<SiblingAddress>> read_addresses(ByteReader& in,
                                                   const ClipShape& shape,
                                                   std::int64_t kept,
                                                   std::uint64_t siblings) {
    std::vector<SiblingAddress> read;
    read.reserve(siblings);
    std::size_t above = 0;  // where the level above begins
    for (int level = 0; level <= shape.time_levels(); ++level) {
        const std::uint64_t count = in.varint();
        if (count > siblings - read.size()) return damaged("index: number of siblings");
        const std::size_t begin = read.size();
        std::int64_t next = 0;
        for (std::uint64_t i = 0; i < count; ++i) {
            const std::uint64_t gap = in.varint();
            if (gap >= static_cast<std::uint64_t>(most_siblings(shape, level) - next))
                return damaged("index: siblings outside of time level " +
                               std::to_string(level));
            const std::int64_t index = next + static_cast<std::int64_t>(gap);
            const SiblingAddress address{level, index};
            const SiblingAddress ancestor = siblings_of({level - 1, index});
            if (level > 0 &&
                !std::binary_search(
                    read.begin() + above, read.begin() + begin, ancestor, before)) {
                return damaged("index: siblings " + std::to_string(index) +
                               " of time level " + std::to_string(level) +
                               " without their time-parent");
            }
            const int height = shape.time_levels() - level + 1;  // of their parent
            if (level > 0 && (index + 1) << height <= kept) {
                return damaged("index: siblings " + std::to_string(index) +
                               " of time level " + std::to_string(level) +
                               ", which an older generation has");
            }
            read.push_back(address);
            next = index + 1;
        }
        above = begin;
    }
    if (in.overrun() || read.empty() || read.size() != siblings)
        return damaged("index: number of siblings");
    return read;
}

// Chunks from `begin` to `end`, without gaps.
Result<void> read_chunks(ByteReader& in,
                         std::uint64_t begin,
                         std::uint64_t end,
                         MrvIndex& index) {
    std::uint64_t next = begin;
    for (int row = 0; row < index.rows(); ++row) {
        for (std::size_t i = 0; i < index.siblings(); ++i) {
            MrvChunk& chunk = index.chunk(row, i);
            const auto wrong = [&](const char* what) {
                return damaged("index: " + std::string(what) + " of time level " +
                               std::to_string(index.address(i).time_level) +
                               ", siblings " + std::to_string(index.address(i).index) +
                               ", row " + std::to_string(row));
            };
            if (row > 0) {
                const std::uint64_t nodes = in.varint();
                const std::uint64_t bricks = in.varint();
                if (nodes > kMaxRefIndex + 1 || bricks > kMaxRefIndex + 1)
                    return wrong("size");
                chunk.size = {static_cast<std::uint32_t>(nodes),
                              static_cast<std::uint32_t>(bricks)};
                if (chunk.size.empty()) continue;
            }
            const std::uint64_t bytes = in.varint();
            chunk.checksum = in.fixed<std::uint64_t>();
            if (bytes > UINT32_MAX || bytes > end - next) return wrong("place");
            if (chunk.size.memory_bytes() / kMostExpansion > bytes)
                return wrong("expansion");
            chunk.offset = next;
            chunk.bytes = static_cast<std::uint32_t>(bytes);
            next += bytes;
        }
    }
    if (in.overrun() || !in.rest().empty()) return damaged("index: length");
    if (next != end) return damaged("index: chunks end at byte " + std::to_string(next));
    return {};
}

// The generation number `number` of a file; `before` is the one before it, or null.
Result<MrvGeneration> read_generation(std::span<const std::byte> file,
                                      const Record& record,
                                      std::size_t number,
                                      const FrameFormat& format,
                                      const MrvGeneration* before) {
    const auto wrong = [&](const std::string& what) {
        return damaged("generation " + std::to_string(number) + ": " + what);
    };
    const Result<ClipShape> shape = ClipShape::make(format, record.frames);
    if (!shape) return wrong(shape.error().message);
    const std::int64_t kept = before == nullptr ? 0 : before->shape.frames();
    if (record.frames <= kept)
        return wrong("frames are " + std::to_string(record.frames));
    const std::uint64_t index_at = (before == nullptr ? kMrvHeaderBytes : before->end) +
                                   (number + 1) * kMrvRecordBytes;
    if (index_at > file.size() || record.index_bytes > file.size() - index_at)
        return wrong("index cut off");
    const std::uint64_t chunks_at = index_at + record.index_bytes;
    if (record.end < chunks_at) return wrong("end is " + std::to_string(record.end));
    const auto bytes = file.subspan(index_at, record.index_bytes);
    if (mrv_checksum(bytes) != record.index_checksum)
        return wrong("checksum of the index");
    const int rows = mrv_rows(*shape);
    // At least a byte for an address and for each number of a chunk.
    if (record.siblings > record.index_bytes / static_cast<std::uint64_t>(2 * rows))
        return wrong("number of siblings " + std::to_string(record.siblings));

    ByteReader in(bytes);
    Result<std::vector<SiblingAddress>> addresses =
        read_addresses(in, *shape, kept, record.siblings);
    if (!addresses) return wrong(addresses.error().message);
    MrvGeneration generation{.shape = *shape,
                             .index = MrvIndex(*std::move(addresses), rows),
                             .index_bytes = record.index_bytes,
                             .index_checksum = record.index_checksum,
                             .end = record.end};
    const Result<void> read = read_chunks(in, chunks_at, record.end, generation.index);
    if (!read) return wrong(read.error().message);
    return generation;
}

}  // namespace

std::uint64_t mrv_checksum(std::span<const std::byte> bytes) {
    return XXH3_64bits(bytes.data(), bytes.size());
}

int mrv_rows(const ClipShape& shape) {
    return mrv_row_of(std::max(shape.space_levels(), kBrickLevel)) + 1;
}

MrvIndex::MrvIndex(std::vector<SiblingAddress> siblings, int rows)
    : siblings_(std::move(siblings)),
      rows_(rows),
      chunks_(siblings_.size() * static_cast<std::size_t>(rows)) {
    assert(std::is_sorted(siblings_.begin(), siblings_.end(), before));
}

std::optional<std::size_t> MrvIndex::find(const SiblingAddress& address) const {
    const auto found =
        std::lower_bound(siblings_.begin(), siblings_.end(), address, before);
    if (found == siblings_.end() || *found != address) return std::nullopt;
    return static_cast<std::size_t>(found - siblings_.begin());
}

MrvGenerationBytes encode_generation(MrvFront& front) {
    assert(front.older.size() < kMostGenerations);
    const std::size_t generations = front.older.size() + 1;
    const std::vector<std::byte> index = encode_index(front);
    MrvGenerationBytes made;
    made.segment_at = front.older.empty() ? kMrvHeaderBytes : front.older.back().end;
    std::uint64_t next = made.segment_at + generations * kMrvRecordBytes + index.size();
    for (int row = 0; row < front.index.rows(); ++row) {
        for (std::size_t i = 0; i < front.index.siblings(); ++i) {
            MrvChunk& chunk = front.index.chunk(row, i);
            chunk.offset = chunk.bytes == 0 ? 0 : next;
            next += chunk.bytes;
        }
    }
    front.file_bytes = next;
    front.index_bytes = index.size();
    front.index_checksum = mrv_checksum(index);

    for (const MrvGeneration& older : front.older) {
        put_record(made.segment,
                   {.frames = older.shape.frames(),
                    .siblings = older.index.siblings(),
                    .index_bytes = older.index_bytes,
                    .end = older.end,
                    .index_checksum = older.index_checksum});
    }
    put_record(made.segment,
               {.frames = front.shape.frames(),
                .siblings = front.index.siblings(),
                .index_bytes = front.index_bytes,
                .end = front.file_bytes,
                .index_checksum = front.index_checksum});
    const std::uint64_t table_checksum = mrv_checksum(made.segment);
    made.segment.insert(made.segment.end(), index.begin(), index.end());

    made.slot_at = kMrvSlotsAt + (generations - 1) % kSlots * kMrvSlotBytes;
    put_fixed(made.slot, std::uint64_t{generations});
    put_fixed(made.slot, made.segment_at);
    put_fixed(made.slot, table_checksum);
    front.revision = revision_of(header_begin(front), made.slot);
    put_fixed(made.slot, front.revision);
    return made;
}

std::vector<std::byte> encode_front(MrvFront& front) {
    assert(front.older.empty());
    const MrvGenerationBytes first = encode_generation(front);
    std::vector<std::byte> out = header_begin(front);
    out.resize(kMrvHeaderBytes);
    std::copy(first.slot.begin(), first.slot.end(), out.begin() + kMrvSlotsAt);
    out.insert(out.end(), first.segment.begin(), first.segment.end());
    return out;
}

Result<MrvFront> decode_front(std::span<const std::byte> file) {
    if (file.size() < sizeof kMagic ||
        std::memcmp(file.data(), kMagic, sizeof kMagic) != 0) {
        return Error{ErrorCode::kUnsupportedFormat, "not a .mrv file"};
    }
    ByteReader in(file.subspan(sizeof kMagic));
    const auto version = in.fixed<std::uint32_t>();
    if (in.overrun()) return damaged_file("header cut off");
    // Before any checksum: another version may have another header.
    if (version > kMrvVersion) {
        return Error{ErrorCode::kNewerVersion,
                     ".mrv file of version " + std::to_string(version) +
                         "; known is version " + std::to_string(kMrvVersion)};
    }
    if (version < kMrvVersion) {
        return Error{ErrorCode::kUnsupportedFormat,
                     ".mrv file of version " + std::to_string(version) +
                         ", which is no longer read: upload the clip again"};
    }
    if (file.size() < kMrvHeaderBytes) return damaged_file("header cut off");
    FrameFormat format;
    format.width = in.fixed<std::int32_t>();
    format.height = in.fixed<std::int32_t>();
    format.rate.numerator = in.fixed<std::int32_t>();
    format.rate.denominator = in.fixed<std::int32_t>();
    const auto delta = in.fixed<std::uint32_t>();
    const std::optional<Slot> slot = newest_slot(file.first(kMrvHeaderBytes));
    if (!slot) return damaged_file("checksum of the header");
    // Of an approximation, older generations would show something else.
    if (slot->generations < 1 || slot->generations > (delta == 0 ? kMostGenerations : 1))
        return damaged_file("generations are " + std::to_string(slot->generations));
    const auto generations = static_cast<std::size_t>(slot->generations);
    const std::size_t table_bytes = generations * kMrvRecordBytes;
    if (slot->table < kMrvHeaderBytes || slot->table > file.size() ||
        table_bytes > file.size() - slot->table) {
        return damaged_file("table of generations cut off");
    }
    const auto table = file.subspan(slot->table, table_bytes);
    if (mrv_checksum(table) != slot->table_checksum)
        return damaged_file("checksum of the table of generations");

    ByteReader table_in(table);
    std::vector<MrvGeneration> read;
    for (std::size_t number = 0; number < generations; ++number) {
        Result<MrvGeneration> generation =
            read_generation(file,
                            read_record(table_in),
                            number,
                            format,
                            read.empty() ? nullptr : &read.back());
        if (!generation) return damaged_file(generation.error().message);
        read.push_back(*std::move(generation));
    }
    MrvGeneration newest = std::move(read.back());
    read.pop_back();
    if (slot->table != (read.empty() ? kMrvHeaderBytes : read.back().end))
        return damaged_file("place of the table of generations");
    return MrvFront{.shape = newest.shape,
                    .delta = delta,
                    .index = std::move(newest.index),
                    .file_bytes = newest.end,
                    .revision = slot->revision,
                    .index_bytes = newest.index_bytes,
                    .index_checksum = newest.index_checksum,
                    .older = std::move(read)};
}

}  // namespace haarmony::video
