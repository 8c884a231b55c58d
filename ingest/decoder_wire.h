// What a decoder child and its parent say to each other over a socket.
//
//   parent -> child   one WireRequest; with it, as ancillary data, a sealed memory file
//                     with the picture's bytes
//   child -> parent   one WireReply, then `length` bytes: pixels, or a message
//
// They travel as socket_wire.h says, and kWireMagic tells a stranger. The parent believes
// nothing in a reply before check_reply() has agreed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "ingest/file_descriptor.h"
#include "ingest/sniff.h"
#include "ingest/socket_wire.h"

namespace haarmony::ingest {

inline constexpr std::uint32_t kWireMagic = 0x48443031;  // "HD01"
inline constexpr std::uint64_t kMaxWireMessage = 1024;

struct WireRequest {
    std::uint32_t magic = kWireMagic;
    std::uint32_t format = 0;  // a Format
    std::uint64_t size = 0;    // bytes in the memory file
    std::int64_t max_pixels = 0;
    std::int64_t cpu_seconds = 0;
};

enum class WireStatus : std::uint32_t { kPixels, kUndecodable, kTooLarge };

struct WireReply {
    std::uint32_t magic = kWireMagic;
    WireStatus status = WireStatus::kUndecodable;
    std::int32_t width = 0;
    std::int32_t height = 0;
    std::int32_t channels = 0;
    std::int32_t padding = 0;
    std::uint64_t length = 0;
};

// Whether a reply is one that an honest child could send.
[[nodiscard]] bool check_reply(const WireReply& reply, std::int64_t max_pixels);

// As send_with_file().
[[nodiscard]] bool send_request(int socket, const WireRequest& request, int memory);

struct ReceivedRequest {
    WireRequest request;
    FileDescriptor memory;
};
[[nodiscard]] std::optional<ReceivedRequest> receive_request(int socket);

}  // namespace haarmony::ingest
