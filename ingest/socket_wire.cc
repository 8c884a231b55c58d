#include "ingest/socket_wire.h"

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

bool receive_all(int socket, void* bytes, std::size_t count) {
    char* to = static_cast<char*>(bytes);
    while (count > 0) {
        const ssize_t got = ::recv(socket, to, count, 0);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        to += got;
        count -= static_cast<std::size_t>(got);
    }
    return true;
}

bool send_with_file(int socket, const void* bytes, std::size_t count, int file) {
    iovec part = {const_cast<void*>(bytes), count};
    Ancillary ancillary{};
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    if (file >= 0) {
        message.msg_control = &ancillary;
        message.msg_controllen = sizeof(ancillary.bytes);
        cmsghdr* header = CMSG_FIRSTHDR(&message);
        header->cmsg_level = SOL_SOCKET;
        header->cmsg_type = SCM_RIGHTS;
        header->cmsg_len = CMSG_LEN(sizeof(int));
        std::memcpy(CMSG_DATA(header), &file, sizeof(int));
    }
    ssize_t sent = 0;
    do {
        sent = ::sendmsg(socket, &message, MSG_NOSIGNAL);
    } while (sent < 0 && errno == EINTR);
    // A structure goes into an empty socket buffer whole or not at all.
    return sent == static_cast<ssize_t>(count);
}

bool receive_with_file(int socket, void* bytes, std::size_t count, FileDescriptor& file) {
    iovec part = {bytes, count};
    Ancillary ancillary{};
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = &ancillary;
    message.msg_controllen = sizeof(ancillary.bytes);
    ssize_t got = 0;
    do {
        got = ::recvmsg(socket, &message, MSG_CMSG_CLOEXEC | MSG_WAITALL);
    } while (got < 0 && errno == EINTR);
    if (got < 0) return false;
    const cmsghdr* header = CMSG_FIRSTHDR(&message);
    if (header != nullptr && header->cmsg_level == SOL_SOCKET &&
        header->cmsg_type == SCM_RIGHTS && header->cmsg_len == CMSG_LEN(sizeof(int))) {
        int number = -1;
        std::memcpy(&number, CMSG_DATA(header), sizeof(int));
        file = FileDescriptor(number);
    }
    return got == static_cast<ssize_t>(count);
}

}  // namespace haarmony::ingest
