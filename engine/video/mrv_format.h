// Header, generations and indexes of a .mrv file (engine/video/MRV.md, byte by byte).
//   [mrv_format.h] -> mrv_writer.h, mrv_clip.h
//
// Shape   a generation is the time tree as it was written, or as it was after frames were
//         appended; its siblings are sorted by time level, then index. Chunks are in rows: row
//         0 has the time nodes, row r the layers of space level r + 2; an empty layer has none.
// Errors  decode_front(): kUnsupportedFormat, kNewerVersion, kUndecodable, naming the field.
//         What it returns is consistent: every generation has more frames than the one before
//         and lies behind it, every time-ancestor is there, every chunk lies within its
//         generation and expands within kMostExpansion.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/video/clip_shape.h"
#include "engine/video/layer.h"
#include "engine/video/layer_coder.h"

namespace haarmony::video {

inline constexpr std::uint32_t kMrvVersion = 2;
inline constexpr std::size_t kMrvHeaderBytes = 96;
// The header says where the newest generation is in one of two slots, by turns, so that the
// other one is whole whatever becomes of a write.
inline constexpr std::size_t kMrvSlotsAt = 32;
inline constexpr std::size_t kMrvSlotBytes = 32;
// Of a generation in the table of generations.
inline constexpr std::size_t kMrvRecordBytes = 40;
inline constexpr std::size_t kMostGenerations = 4096;

// XXH3 of 64 bits, seed 0.
[[nodiscard]] std::uint64_t mrv_checksum(std::span<const std::byte> bytes);

struct MrvChunk {
    std::uint64_t offset = 0;  // in the file
    std::uint32_t bytes = 0;
    LayerSize size;  // of row 0: none
    std::uint64_t checksum = 0;

    friend bool operator==(const MrvChunk&, const MrvChunk&) = default;
};

// Rows of a clip's chunks: the time nodes, and the space levels from kBrickLevel on.
[[nodiscard]] int mrv_rows(const ClipShape& shape);
[[nodiscard]] constexpr int mrv_row_of(int space_level) {
    return space_level - kBrickLevel + 1;
}

class MrvIndex {
  public:
    MrvIndex() = default;
    // Requires: sorted addresses.
    MrvIndex(std::vector<SiblingAddress> siblings, int rows);

    [[nodiscard]] std::size_t siblings() const { return siblings_.size(); }
    [[nodiscard]] int rows() const { return rows_; }
    [[nodiscard]] const SiblingAddress& address(std::size_t ordinal) const {
        return siblings_[ordinal];
    }
    [[nodiscard]] std::optional<std::size_t> find(const SiblingAddress& address) const;
    [[nodiscard]] MrvChunk& chunk(int row, std::size_t ordinal) {
        return chunks_[static_cast<std::size_t>(row) * siblings_.size() + ordinal];
    }
    [[nodiscard]] const MrvChunk& chunk(int row, std::size_t ordinal) const {
        return chunks_[static_cast<std::size_t>(row) * siblings_.size() + ordinal];
    }
    friend bool operator==(const MrvIndex&, const MrvIndex&) = default;

  private:
    std::vector<SiblingAddress> siblings_;
    int rows_ = 0;
    std::vector<MrvChunk> chunks_;
};

// Siblings at an address are those of the first generation in which the time node that they
// halve was complete, or else of the last one.
struct MrvGeneration {
    ClipShape shape;
    MrvIndex index;
    std::uint64_t index_bytes = 0;
    std::uint64_t index_checksum = 0;
    std::uint64_t end = 0;  // in the file
};

struct MrvFront {
    ClipShape shape;
    std::uint32_t delta = 0;
    MrvIndex index;  // of the newest generation, whose shape is the clip's
    std::uint64_t file_bytes = 0;
    std::uint64_t revision = 0;
    // Of the newest generation's index, where the front was encoded or decoded.
    std::uint64_t index_bytes = 0;
    std::uint64_t index_checksum = 0;
    std::vector<MrvGeneration> older = {};  // the first first
};

// The front of the newest generation, in the order in which it is written: the segment, its
// chunks right behind it, and then the slot of the header that makes it the clip.
struct MrvGenerationBytes {
    std::uint64_t segment_at = 0;
    std::vector<std::byte> segment;  // table of generations and index
    std::uint64_t slot_at = 0;
    std::vector<std::byte> slot;
};
// Sets the offsets of the newest generation's chunks, which follow one another row by row,
// file_bytes and revision. Requires: fewer than kMostGenerations older ones.
[[nodiscard]] MrvGenerationBytes encode_generation(MrvFront& front);
// Header and segment of a clip of one generation. Requires: no older ones.
[[nodiscard]] std::vector<std::byte> encode_front(MrvFront& front);
// `file` may be the front of a file only.
[[nodiscard]] Result<MrvFront> decode_front(std::span<const std::byte> file);

}  // namespace haarmony::video
