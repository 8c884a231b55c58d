#include "ingest/decoder_wire.h"

namespace haarmony::ingest {

bool check_reply(const WireReply& reply, std::int64_t max_pixels) {
    if (reply.magic != kWireMagic) return false;
    switch (reply.status) {
        case WireStatus::kUndecodable:
        case WireStatus::kTooLarge:
            return reply.length <= kMaxWireMessage;
        case WireStatus::kPixels:
            break;
        default:
            return false;
    }
    const std::int64_t width = reply.width;
    const std::int64_t height = reply.height;
    const bool depth = reply.channels == 1 || reply.channels == 3 || reply.channels == 4;
    if (width < 1 || height < 1 || !depth || width * height > max_pixels) return false;
    return reply.length == static_cast<std::uint64_t>(width * height) *
                               static_cast<std::uint64_t>(reply.channels);
}

bool send_request(int socket, const WireRequest& request, int memory) {
    return send_with_file(socket, &request, sizeof(request), memory);
}

std::optional<ReceivedRequest> receive_request(int socket) {
    ReceivedRequest received;
    const bool whole = receive_with_file(
        socket, &received.request, sizeof(received.request), received.memory);
    if (!whole || !received.memory.valid() || received.request.magic != kWireMagic) {
        return std::nullopt;
    }
    return received;
}

}  // namespace haarmony::ingest
