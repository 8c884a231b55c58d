// The front of a .mrv file: header and index (engine/video/MRV.md, byte by byte).
//   [mrv_format.h] -> mrv_writer.h, mrv_clip.h
//
// Shape   siblings sorted by time level, then index; chunks in rows: row 0 has the time nodes,
//         row r the layers of space level r + 2; an empty layer has no chunk.
// Errors  decode_front(): kUnsupportedFormat, kNewerVersion, kUndecodable, naming the field.
//         What it returns is consistent: every time-ancestor is there, every chunk lies within
//         the clip's bytes and expands within kMostExpansion.
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

struct MrvFront {
    ClipShape shape;
    std::uint32_t delta = 0;
    MrvIndex index;
    std::uint64_t file_bytes = 0;
    std::uint64_t revision = 0;
};

// Header and index of a clip whose chunks follow them without gaps, row by row; sets their
// offsets, file_bytes and revision.
[[nodiscard]] std::vector<std::byte> encode_front(MrvFront& front);
// `file` may be the front of a file only.
[[nodiscard]] Result<MrvFront> decode_front(std::span<const std::byte> file);

}  // namespace haarmony::video
