// Runs of bytes of one kind, each compressed by itself: what a chunk consists of.
//   [stream_coder.h] -> row_coder.h, ref_coder.h -> layer_coder.h, time_node_coder.h
//
// Shape   a varint 2n + 1, a varint of bytes and one frame of zstd of n bytes; or a varint 2n
//         and the n bytes as they are, where a frame would not be shorter.
// Errors  reading: kUndecodable. Nothing is allocated beyond what the caller allows.
// Source  RFC 8878 [zstd].
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/video/byte_stream.h"

namespace haarmony::video {

using Stream = std::vector<std::uint8_t>;

// What is worth looking for in a stream.
enum class Redundancy : std::uint8_t {
    kFrequent,  // some bytes are more frequent than others
    kRepeated,  // runs of bytes come again
    kSearched,  // and looking for them may take long
};

void put_stream(std::span<const std::uint8_t> stream,
                Redundancy redundancy,
                std::vector<std::byte>& out);

class StreamReader {
  public:
    // `bytes` must outlive the reader.
    explicit StreamReader(std::span<const std::byte> bytes) : in_(bytes) {}
    // The next stream, of `most` bytes at most.
    [[nodiscard]] Result<Stream> next(std::uint64_t most);
    // Whether all streams are read.
    [[nodiscard]] bool at_end() const { return in_.rest().empty(); }

  private:
    ByteReader in_;
};

}  // namespace haarmony::video
