#include "ingest/decoder_wire.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

namespace haarmony::ingest {
namespace {

// Room for one descriptor, aligned as the kernel wants it.
union Ancillary {
    cmsghdr header;
    char bytes[CMSG_SPACE(sizeof(int))];
};

Error io_error(const std::string& what) {
    return {ErrorCode::kIo, what + ": " + std::generic_category().message(errno)};
}

}  // namespace

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

Result<FileDescriptor> sealed_memory(std::span<const std::uint8_t> bytes) {
    FileDescriptor memory(::memfd_create("picture", MFD_CLOEXEC | MFD_ALLOW_SEALING));
    if (!memory.valid()) return io_error("memfd_create");
    std::size_t written = 0;
    while (written < bytes.size()) {
        const ssize_t count =
            ::write(memory.get(), bytes.data() + written, bytes.size() - written);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) {
            return io_error("writing " + std::to_string(bytes.size()) +
                            " bytes to a memory file");
        }
        written += static_cast<std::size_t>(count);
    }
    constexpr int kSeals = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE | F_SEAL_SEAL;
    if (::fcntl(memory.get(), F_ADD_SEALS, kSeals) != 0) return io_error("F_ADD_SEALS");
    return memory;
}

bool send_all(int socket, const void* bytes, std::size_t count) {
    const char* from = static_cast<const char*>(bytes);
    while (count > 0) {
        const ssize_t sent = ::send(socket, from, count, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return false;
        from += sent;
        count -= static_cast<std::size_t>(sent);
    }
    return true;
}

bool send_request(int socket, const WireRequest& request, int memory) {
    iovec part = {const_cast<WireRequest*>(&request), sizeof(request)};
    Ancillary ancillary{};
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = &ancillary;
    message.msg_controllen = sizeof(ancillary.bytes);
    cmsghdr* header = CMSG_FIRSTHDR(&message);
    header->cmsg_level = SOL_SOCKET;
    header->cmsg_type = SCM_RIGHTS;
    header->cmsg_len = CMSG_LEN(sizeof(int));
    std::memcpy(CMSG_DATA(header), &memory, sizeof(int));
    ssize_t sent = 0;
    do {
        sent = ::sendmsg(socket, &message, MSG_NOSIGNAL);
    } while (sent < 0 && errno == EINTR);
    // 32 bytes into an empty socket buffer go whole or not at all.
    return sent == static_cast<ssize_t>(sizeof(request));
}

std::optional<ReceivedRequest> receive_request(int socket) {
    ReceivedRequest received;
    iovec part = {&received.request, sizeof(received.request)};
    Ancillary ancillary{};
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = &ancillary;
    message.msg_controllen = sizeof(ancillary.bytes);
    ssize_t count = 0;
    do {
        count = ::recvmsg(socket, &message, MSG_CMSG_CLOEXEC | MSG_WAITALL);
    } while (count < 0 && errno == EINTR);
    if (count < 0) return std::nullopt;
    const cmsghdr* header = CMSG_FIRSTHDR(&message);
    if (header != nullptr && header->cmsg_level == SOL_SOCKET &&
        header->cmsg_type == SCM_RIGHTS && header->cmsg_len == CMSG_LEN(sizeof(int))) {
        int memory = -1;
        std::memcpy(&memory, CMSG_DATA(header), sizeof(int));
        received.memory = FileDescriptor(memory);
    }
    const bool whole = count == static_cast<ssize_t>(sizeof(received.request));
    if (!whole || !received.memory.valid() || received.request.magic != kWireMagic) {
        return std::nullopt;
    }
    return received;
}

}  // namespace haarmony::ingest
