// Bodies that lie on the disk.
//
// Errors  kNotFound if there is no such file (any more), kIo if it cannot be read or has
//         become shorter than the range; the text does not name the path.
// Threads const-safe; each source is pulled by one thread at a time.
#pragma once

#include <cstddef>

#include "engine/core/result.h"
#include "server/http/message.h"

namespace haarmony::http {

inline constexpr std::size_t kFileChunk = 256 * 1024;

// A source of exactly `range.length` bytes in pieces of at most kFileChunk; the file stays
// open as long as the source lives. The source throws std::runtime_error when the file ends
// early or fails under it.
[[nodiscard]] Result<ChunkSource> open_file_range(const FileRange& range);

}  // namespace haarmony::http
