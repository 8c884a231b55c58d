#include "engine/video/mrv_format.h"

#include <xxhash.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <string>
#include <tuple>

#include "engine/video/byte_stream.h"

namespace haarmony::video {
namespace {

constexpr char kMagic[8] = {'H', 'A', 'A', 'R', 'M', 'R', 'V', '\n'};
constexpr std::size_t kRevisionAt = kMrvHeaderBytes - sizeof(std::uint64_t);

bool before(const SiblingAddress& a, const SiblingAddress& b) {
    return std::tie(a.time_level, a.index) < std::tie(b.time_level, b.index);
}

Error damaged(const std::string& what) {
    return {ErrorCode::kUndecodable, ".mrv file: " + what};
}

std::vector<std::byte> encode_index(const MrvFront& front, std::uint64_t chunks_begin) {
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
    std::uint64_t expected = chunks_begin;
    for (int row = 0; row < index.rows(); ++row) {
        for (std::size_t i = 0; i < index.siblings(); ++i) {
            const MrvChunk& chunk = index.chunk(row, i);
            if (row > 0) {
                put_varint(out, chunk.size.nodes);
                put_varint(out, chunk.size.bricks);
                if (chunk.size.empty()) continue;
            }
            put_varint(out, chunk.bytes);
            put_varint(out, zigzag(static_cast<std::int64_t>(chunk.offset - expected)));
            put_fixed(out, chunk.checksum);
            expected = chunk.offset + chunk.bytes;
        }
    }
    return out;
}

// How many siblings a time level may have.
std::int64_t most_siblings(const ClipShape& shape, int time_level) {
    return time_level == 0 ? 1 : shape.nodes_at(time_level - 1);
}

Result<std::vector<SiblingAddress>> read_addresses(ByteReader& in,
                                                   const ClipShape& shape,
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
            read.push_back(address);
            next = index + 1;
        }
        above = begin;
    }
    if (in.overrun() || read.empty() || read.size() != siblings)
        return damaged("index: number of siblings");
    return read;
}

Result<void> read_chunks(ByteReader& in,
                         std::uint64_t chunks_begin,
                         std::uint64_t file_bytes,
                         MrvIndex& index) {
    std::uint64_t expected = chunks_begin;
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
            chunk.offset = expected + static_cast<std::uint64_t>(unzigzag(in.varint()));
            chunk.checksum = in.fixed<std::uint64_t>();
            if (bytes > UINT32_MAX || chunk.offset < kMrvHeaderBytes ||
                chunk.offset > file_bytes || bytes > file_bytes - chunk.offset) {
                return wrong("place");
            }
            if (chunk.size.memory_bytes() / kMostExpansion > bytes)
                return wrong("expansion");
            chunk.bytes = static_cast<std::uint32_t>(bytes);
            expected = chunk.offset + bytes;
        }
    }
    if (in.overrun() || !in.rest().empty()) return damaged("index: length");
    return {};
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

std::vector<std::byte> encode_front(MrvFront& front) {
    // Offsets are told relative to where the chunks begin, so the index's length does not
    // depend on itself.
    std::uint64_t chunk_bytes = 0;
    for (int row = 0; row < front.index.rows(); ++row) {
        for (std::size_t i = 0; i < front.index.siblings(); ++i) {
            MrvChunk& chunk = front.index.chunk(row, i);
            chunk.offset = chunk.bytes == 0 ? 0 : chunk_bytes;
            chunk_bytes += chunk.bytes;
        }
    }
    const std::vector<std::byte> index = encode_index(front, 0);
    const std::uint64_t chunks_begin = kMrvHeaderBytes + index.size();
    for (int row = 0; row < front.index.rows(); ++row) {
        for (std::size_t i = 0; i < front.index.siblings(); ++i) {
            MrvChunk& chunk = front.index.chunk(row, i);
            if (chunk.bytes > 0) chunk.offset += chunks_begin;
        }
    }
    front.file_bytes = chunks_begin + chunk_bytes;

    std::vector<std::byte> out(sizeof kMagic);
    std::memcpy(out.data(), kMagic, sizeof kMagic);
    put_fixed(out, kMrvVersion);
    put_fixed(out, front.shape.width());
    put_fixed(out, front.shape.height());
    put_fixed(out, front.shape.rate().numerator);
    put_fixed(out, front.shape.rate().denominator);
    put_fixed(out, front.delta);
    put_fixed(out, front.shape.frames());
    put_fixed(out, std::uint64_t{front.index.siblings()});
    put_fixed(out, std::uint64_t{kMrvHeaderBytes});
    put_fixed(out, std::uint64_t{index.size()});
    put_fixed(out, chunks_begin);
    put_fixed(out, front.file_bytes);
    put_fixed(out, mrv_checksum(index));
    assert(out.size() == kRevisionAt);
    front.revision = mrv_checksum(out);
    put_fixed(out, front.revision);
    out.insert(out.end(), index.begin(), index.end());
    return out;
}

Result<MrvFront> decode_front(std::span<const std::byte> file) {
    if (file.size() < sizeof kMagic ||
        std::memcmp(file.data(), kMagic, sizeof kMagic) != 0) {
        return Error{ErrorCode::kUnsupportedFormat, "not a .mrv file"};
    }
    ByteReader in(file.subspan(sizeof kMagic));
    const auto version = in.fixed<std::uint32_t>();
    if (in.overrun()) return damaged("header cut off");
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
    if (file.size() < kMrvHeaderBytes) return damaged("header cut off");
    FrameFormat format;
    format.width = in.fixed<std::int32_t>();
    format.height = in.fixed<std::int32_t>();
    format.rate.numerator = in.fixed<std::int32_t>();
    format.rate.denominator = in.fixed<std::int32_t>();
    const auto delta = in.fixed<std::uint32_t>();
    const auto frames = in.fixed<std::int64_t>();
    const auto siblings = in.fixed<std::uint64_t>();
    const auto index_offset = in.fixed<std::uint64_t>();
    const auto index_bytes = in.fixed<std::uint64_t>();
    const auto chunks_begin = in.fixed<std::uint64_t>();
    const auto file_bytes = in.fixed<std::uint64_t>();
    const auto index_checksum = in.fixed<std::uint64_t>();
    const auto revision = in.fixed<std::uint64_t>();
    if (mrv_checksum(file.first(kRevisionAt)) != revision)
        return damaged("checksum of the header");
    const Result<ClipShape> shape = ClipShape::make(format, frames);
    if (!shape) return damaged(shape.error().message);
    if (index_offset < kMrvHeaderBytes || index_offset > file.size() ||
        index_bytes > file.size() - index_offset) {
        return damaged("index cut off");
    }
    const auto bytes = file.subspan(index_offset, index_bytes);
    if (mrv_checksum(bytes) != index_checksum) return damaged("checksum of the index");
    const int rows = mrv_rows(*shape);
    // At least a byte for an address and for each number of a chunk.
    if (siblings > index_bytes / static_cast<std::uint64_t>(2 * rows))
        return damaged("number of siblings " + std::to_string(siblings));

    ByteReader index_in(bytes);
    Result<std::vector<SiblingAddress>> addresses =
        read_addresses(index_in, *shape, siblings);
    if (!addresses) return std::move(addresses).error();
    MrvFront front{.shape = *shape,
                   .delta = delta,
                   .index = MrvIndex(*std::move(addresses), rows),
                   .file_bytes = file_bytes,
                   .revision = revision};
    if (Result<void> read = read_chunks(index_in, chunks_begin, file_bytes, front.index);
        !read) {
        return std::move(read).error();
    }
    return front;
}

}  // namespace haarmony::video
