// What a snapshot file says about itself: where it comes from, and what its parts are.
//   SNAPSHOT.md, byte by byte; snapshot_file.h has the parts themselves
//
// Shape   header, table, then the parts one after another, each beginning at a multiple of
//         kSnapshotAlignment. Little-endian throughout.
// Errors  kUnsupportedFormat, kNewerVersion, kUndecodable: each naming what is wrong.
// Threads any.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/core/ids.h"
#include "engine/core/result.h"
#include "engine/image/segment_layout.h"
#include "schema/snapshot_store.h"

struct XXH3_state_s;

namespace haarmony::server {

inline constexpr std::uint32_t kSnapshotVersion = 1;
// A page: so that parts can be dropped from memory one by one.
inline constexpr std::size_t kSnapshotAlignment = 4096;

[[nodiscard]] constexpr std::uint64_t aligned_in_snapshot(std::uint64_t bytes) {
    return (bytes + kSnapshotAlignment - 1) / kSnapshotAlignment * kSnapshotAlignment;
}

// One segment, and behind it which of its pictures are gone.
struct SnapshotPart {
    std::uint32_t variant = 0;  // its place among the table's
    image::SegmentCounts counts;
    std::uint64_t segment_bytes = 0;
    // Checksums are of the bytes and the zeros behind them, up to where the next begins.
    std::uint64_t segment_checksum = 0;
    bool has_removed = false;
    std::uint64_t removed_checksum = 0;

    // Of the tombstones: one bit a slot, in words.
    [[nodiscard]] std::uint64_t removed_bytes() const {
        return has_removed ? (std::uint64_t{counts.slots} + 63) / 64 * 8 : 0;
    }
    // All that the part takes of the file.
    [[nodiscard]] std::uint64_t extent() const {
        return aligned_in_snapshot(segment_bytes) + aligned_in_snapshot(removed_bytes());
    }
    friend bool operator==(const SnapshotPart&, const SnapshotPart&) = default;
};

struct SnapshotTable {
    schema::SnapshotToken token{};
    std::int64_t sequence = 0;  // of the last change that it holds
    std::uint32_t index_m = 0;  // of every part
    std::vector<std::string> variants;
    std::vector<SnapshotPart> parts;
    std::vector<ImageId> damaged;  // pictures of which a stored signature is damaged

    // Where the first part begins, and where the last one ends.
    [[nodiscard]] std::uint64_t parts_begin() const;
    [[nodiscard]] std::uint64_t file_bytes() const;
    friend bool operator==(const SnapshotTable&, const SnapshotTable&) = default;
};

// XXH3, 64 bits.
[[nodiscard]] std::uint64_t snapshot_checksum(std::span<const std::byte> bytes);

// The same of bytes that come piece by piece.
class SnapshotChecksum {
  public:
    SnapshotChecksum();
    ~SnapshotChecksum();
    SnapshotChecksum(const SnapshotChecksum&) = delete;
    SnapshotChecksum& operator=(const SnapshotChecksum&) = delete;

    void add(std::span<const std::byte> bytes);
    [[nodiscard]] std::uint64_t value() const;

  private:
    XXH3_state_s* state_;
};

// Everything before the first part.
[[nodiscard]] std::vector<std::byte> encode_table(const SnapshotTable& table);
// `file` is the whole file. The parts are inside of it; their contents are not looked at.
[[nodiscard]] Result<SnapshotTable> decode_table(std::span<const std::byte> file);

}  // namespace haarmony::server
