#include "server/app/snapshot_format.h"

#include <xxhash.h>
#if defined(__x86_64__)
// The same sums by the widest vectors that the machine has: chosen at run time.
#include <xxh_x86dispatch.h>
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>
#include <new>
#include <string_view>

namespace haarmony::server {
namespace {

// Numbers are copied as they are.
static_assert(std::endian::native == std::endian::little);

constexpr std::string_view kMagic = "HAARSNAP";
constexpr std::size_t kHeaderBytes = 96;
constexpr std::size_t kChecksumBytes = 8;
constexpr std::size_t kPartBytes = 72;
constexpr std::uint32_t kHasRemoved = 1;

Error damaged(const std::string& what) {
    return {ErrorCode::kUndecodable, "the snapshot is damaged: " + what};
}

class ByteWriter {
  public:
    template <typename T>
    void put(T value) {
        const auto bytes = std::bit_cast<std::array<std::byte, sizeof(T)>>(value);
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    }
    void put_text(std::string_view text) {
        for (const char c : text) bytes_.push_back(static_cast<std::byte>(c));
    }
    void pad_to(std::size_t size) { bytes_.resize(size); }
    [[nodiscard]] std::vector<std::byte>& bytes() { return bytes_; }

  private:
    std::vector<std::byte> bytes_;
};

// Once it has failed, all it gives is 0.
class ByteReader {
  public:
    explicit ByteReader(std::span<const std::byte> bytes) : rest_(bytes) {}

    template <typename T>
    T take() {
        T value{};
        const std::span<const std::byte> bytes = take_bytes(sizeof(T));
        if (!bytes.empty()) std::memcpy(&value, bytes.data(), sizeof(T));
        return value;
    }
    std::string take_text(std::size_t size) {
        const std::span<const std::byte> bytes = take_bytes(size);
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }
    [[nodiscard]] bool failed() const { return failed_; }
    [[nodiscard]] bool at_end() const { return rest_.empty(); }

  private:
    std::span<const std::byte> take_bytes(std::size_t size) {
        failed_ = failed_ || size > rest_.size();
        if (failed_) return {};
        const std::span<const std::byte> taken = rest_.first(size);
        rest_ = rest_.subspan(size);
        return taken;
    }

    std::span<const std::byte> rest_;
    bool failed_ = false;
};

struct Header {
    std::uint32_t layout = 0;
    std::uint32_t variants = 0;
    std::uint64_t parts = 0;
    std::uint64_t damaged = 0;
    std::uint64_t table_bytes = 0;
    std::uint64_t file_bytes = 0;
    std::uint64_t table_checksum = 0;
};

std::uint64_t table_bytes(const SnapshotTable& table) {
    std::uint64_t bytes = table.parts.size() * kPartBytes + table.damaged.size() * 8;
    for (const std::string& variant : table.variants) bytes += 4 + variant.size();
    return bytes;
}

void put_part(const SnapshotPart& part, ByteWriter& out) {
    out.put(part.variant);
    out.put(part.has_removed ? kHasRemoved : 0U);
    out.put(part.counts.slots);
    for (const std::uint32_t dense : part.counts.dense) out.put(dense);
    out.put(part.counts.coarse);
    out.put(std::uint32_t{0});
    out.put(part.counts.dense_postings);
    out.put(part.counts.own_postings);
    out.put(part.segment_bytes);
    out.put(part.segment_checksum);
    out.put(part.removed_checksum);
}

Result<SnapshotPart> take_part(std::uint32_t index_m, ByteReader& in) {
    SnapshotPart part;
    part.variant = in.take<std::uint32_t>();
    const auto flags = in.take<std::uint32_t>();
    part.has_removed = flags == kHasRemoved;
    part.counts.index_m = index_m;
    part.counts.slots = in.take<std::uint32_t>();
    for (std::uint32_t& dense : part.counts.dense) dense = in.take<std::uint32_t>();
    part.counts.coarse = in.take<std::uint32_t>();
    const auto reserved = in.take<std::uint32_t>();
    part.counts.dense_postings = in.take<std::uint64_t>();
    part.counts.own_postings = in.take<std::uint64_t>();
    part.segment_bytes = in.take<std::uint64_t>();
    part.segment_checksum = in.take<std::uint64_t>();
    part.removed_checksum = in.take<std::uint64_t>();
    if (flags > kHasRemoved || reserved != 0)
        return damaged("a part has flags " + std::to_string(flags));
    return part;
}

Result<void> take_table(const Header& header, ByteReader& in, SnapshotTable& table) {
    for (std::uint32_t i = 0; i < header.variants && !in.failed(); ++i)
        table.variants.push_back(in.take_text(in.take<std::uint32_t>()));
    for (std::uint64_t i = 0; i < header.parts && !in.failed(); ++i) {
        const Result<SnapshotPart> part = take_part(table.index_m, in);
        if (!part) return part.error();
        if (part->variant >= header.variants)
            return damaged("a part is of variant " + std::to_string(part->variant));
        table.parts.push_back(part.value());
    }
    for (std::uint64_t i = 0; i < header.damaged && !in.failed(); ++i)
        table.damaged.push_back(ImageId{in.take<std::int64_t>()});
    if (in.failed() || !in.at_end())
        return damaged("its table has " + std::to_string(header.table_bytes) + " bytes");
    return {};
}

// The parts fill the file behind the table exactly.
Result<void> check_extents(const SnapshotTable& table, std::uint64_t file_bytes) {
    std::uint64_t end = table.parts_begin();
    for (const SnapshotPart& part : table.parts) {
        const bool fits = part.segment_bytes <= file_bytes &&
                          part.extent() <= file_bytes - std::min(end, file_bytes);
        if (!fits)
            return damaged("a part of " + std::to_string(part.segment_bytes) +
                           " bytes reaches beyond its end");
        end += part.extent();
    }
    if (end != file_bytes) return damaged("its parts end at byte " + std::to_string(end));
    return {};
}

}  // namespace

std::uint64_t SnapshotTable::parts_begin() const {
    return aligned_in_snapshot(kHeaderBytes + table_bytes(*this));
}

std::uint64_t SnapshotTable::file_bytes() const {
    std::uint64_t bytes = parts_begin();
    for (const SnapshotPart& part : parts) bytes += part.extent();
    return bytes;
}

std::uint64_t snapshot_checksum(std::span<const std::byte> bytes) {
    return XXH3_64bits(bytes.data(), bytes.size());
}

SnapshotChecksum::SnapshotChecksum() : state_(XXH3_createState()) {
    if (state_ == nullptr) throw std::bad_alloc();
    XXH3_64bits_reset(state_);
}
SnapshotChecksum::~SnapshotChecksum() { XXH3_freeState(state_); }

void SnapshotChecksum::add(std::span<const std::byte> bytes) {
    XXH3_64bits_update(state_, bytes.data(), bytes.size());
}

std::uint64_t SnapshotChecksum::value() const { return XXH3_64bits_digest(state_); }

std::vector<std::byte> encode_table(const SnapshotTable& table) {
    ByteWriter body;
    for (const std::string& variant : table.variants) {
        body.put(static_cast<std::uint32_t>(variant.size()));
        body.put_text(variant);
    }
    for (const SnapshotPart& part : table.parts) put_part(part, body);
    for (const ImageId id : table.damaged) body.put(to_int(id));
    const std::size_t body_bytes = body.bytes().size();
    body.pad_to(table.parts_begin() - kHeaderBytes);

    ByteWriter out;
    out.put_text(kMagic);
    out.put(kSnapshotVersion);
    out.put(image::kSegmentLayoutVersion);
    for (const std::uint8_t byte : table.token) out.put(byte);
    out.put(table.sequence);
    out.put(table.index_m);
    out.put(static_cast<std::uint32_t>(table.variants.size()));
    out.put(std::uint64_t{table.parts.size()});
    out.put(std::uint64_t{table.damaged.size()});
    out.put(std::uint64_t{body_bytes});
    out.put(table.file_bytes());
    out.put(snapshot_checksum(body.bytes()));
    out.put(snapshot_checksum(out.bytes()));
    assert(out.bytes().size() == kHeaderBytes);
    out.bytes().insert(out.bytes().end(), body.bytes().begin(), body.bytes().end());
    return std::move(out.bytes());
}

Result<SnapshotTable> decode_table(std::span<const std::byte> file) {
    if (file.size() < kHeaderBytes)
        return damaged("it has only " + std::to_string(file.size()) + " bytes");
    ByteReader in(file.first(kHeaderBytes));
    if (in.take_text(kMagic.size()) != kMagic)
        return Error{ErrorCode::kUnsupportedFormat, "the file is no snapshot"};
    const auto version = in.take<std::uint32_t>();
    if (version != kSnapshotVersion)
        return Error{ErrorCode::kNewerVersion,
                     "the snapshot has version " + std::to_string(version) + ", not " +
                         std::to_string(kSnapshotVersion)};
    Header header;
    SnapshotTable table;
    header.layout = in.take<std::uint32_t>();
    for (std::uint8_t& byte : table.token) byte = in.take<std::uint8_t>();
    table.sequence = in.take<std::int64_t>();
    table.index_m = in.take<std::uint32_t>();
    header.variants = in.take<std::uint32_t>();
    header.parts = in.take<std::uint64_t>();
    header.damaged = in.take<std::uint64_t>();
    header.table_bytes = in.take<std::uint64_t>();
    header.file_bytes = in.take<std::uint64_t>();
    header.table_checksum = in.take<std::uint64_t>();
    if (snapshot_checksum(file.first(kHeaderBytes - kChecksumBytes)) !=
        in.take<std::uint64_t>())
        return damaged("the checksum of its header is another");
    if (header.layout != image::kSegmentLayoutVersion)
        return Error{ErrorCode::kNewerVersion,
                     "the segments of the snapshot have layout " +
                         std::to_string(header.layout) + ", not " +
                         std::to_string(image::kSegmentLayoutVersion)};
    if (header.file_bytes != file.size())
        return damaged("it has " + std::to_string(file.size()) + " bytes of " +
                       std::to_string(header.file_bytes));
    if (header.table_bytes > file.size() - kHeaderBytes)
        return damaged("its table has " + std::to_string(header.table_bytes) + " bytes");
    const std::uint64_t begin = aligned_in_snapshot(kHeaderBytes + header.table_bytes);
    if (begin > file.size() ||
        snapshot_checksum(file.subspan(kHeaderBytes, begin - kHeaderBytes)) !=
            header.table_checksum)
        return damaged("the checksum of its table is another");
    ByteReader body(file.subspan(kHeaderBytes, header.table_bytes));
    if (Result<void> taken = take_table(header, body, table); !taken)
        return taken.error();
    if (Result<void> sound = check_extents(table, file.size()); !sound)
        return sound.error();
    return table;
}

}  // namespace haarmony::server
