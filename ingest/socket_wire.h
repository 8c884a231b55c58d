// Structures, files and many bytes over the socket between us and a child of ours.
//
// Both ends are the same build on the same machine: structures travel as they lie in memory.
//
// Errors  kIo for memory files; the rest says false where the peer is gone or sends something
//         else. No signal is raised.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/core/result.h"
#include "ingest/file_descriptor.h"

namespace haarmony::ingest {

// A memory file with a copy of `bytes` that nobody can change any more.
[[nodiscard]] Result<FileDescriptor> sealed_memory(std::span<const std::uint8_t> bytes);

[[nodiscard]] bool send_all(int socket, const void* bytes, std::size_t count);
// Waits as long as the peer lives. For the child: its parent has deadlines.
[[nodiscard]] bool receive_all(int socket, void* bytes, std::size_t count);

// One structure, and with it, as ancillary data, the file `file` (-1 = none).
[[nodiscard]] bool send_with_file(int socket,
                                  const void* bytes,
                                  std::size_t count,
                                  int file);
// `file` becomes what came along, invalid if nothing did.
[[nodiscard]] bool receive_with_file(int socket,
                                     void* bytes,
                                     std::size_t count,
                                     FileDescriptor& file);

}  // namespace haarmony::ingest
