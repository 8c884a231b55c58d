// haarmony-decode BYTES: decodes pictures for haarmonyd and haarmony-ingest, one after the
// other, with at most BYTES of address space. Started by them with a socket as descriptor 0
// (decoder_wire.h); of no use by hand.
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <new>
#include <span>
#include <string>

#include "ingest/decoder_wire.h"
#include "ingest/oiio.h"
#include "ingest/webp.h"

namespace {

using haarmony::Error;
using haarmony::ErrorCode;
using haarmony::Result;
using namespace haarmony::ingest;

constexpr int kSocket = 0;

bool limit(__rlimit_resource resource, rlim_t soft, rlim_t hard) {
    const rlimit value = {soft, hard};
    return ::setrlimit(resource, &value) == 0;
}

bool confine(std::uint64_t address_space) {
    bool done = limit(RLIMIT_CORE, 0, 0) && limit(RLIMIT_FSIZE, 0, 0) &&
                ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    // Their shadow memory alone takes terabytes of addresses.
    static_cast<void>(address_space);
#else
    done = done && limit(RLIMIT_AS, address_space, address_space);
#endif
    return done;
}

// The limit counts from the start of the process: it moves up for each picture.
bool allow_seconds(std::int64_t seconds) {
    rusage used{};
    if (::getrusage(RUSAGE_SELF, &used) != 0) return false;
    const auto spent =
        static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + 1;
    return limit(RLIMIT_CPU, spent + static_cast<rlim_t>(seconds), RLIM_INFINITY);
}

// The request's memory file, mapped while it is decoded.
class Mapping {
  public:
    Mapping(int fd, std::size_t size)
        : size_(size), start_(::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, fd, 0)) {}
    ~Mapping() {
        if (mapped()) ::munmap(start_, size_);
    }
    Mapping(const Mapping&) = delete;
    Mapping& operator=(const Mapping&) = delete;

    [[nodiscard]] bool mapped() const { return start_ != MAP_FAILED; }
    [[nodiscard]] std::span<const std::uint8_t> bytes() const {
        return {static_cast<const std::uint8_t*>(start_), size_};
    }

  private:
    std::size_t size_;
    void* start_;
};

Result<Raster> decode(const ReceivedRequest& received) {
    const Error no_memory = {ErrorCode::kTooLarge,
                             "decoding this picture needs more memory than it may have"};
    try {
        const Mapping mapping(received.memory.get(), received.request.size);
        if (!mapping.mapped()) return no_memory;
        const Format format = static_cast<Format>(received.request.format);
        if (format == Format::kWebp) return decode_webp(mapping.bytes());
        return decode_oiio({format, mapping.bytes(), received.memory.get()},
                           received.request.max_pixels);
    } catch (const std::bad_alloc&) {
        return no_memory;
    }
}

bool answer(const Result<Raster>& result) {
    WireReply reply;
    if (result) {
        reply.status = WireStatus::kPixels;
        reply.width = result->width;
        reply.height = result->height;
        reply.channels = result->channels;
        reply.length = result->pixels.size();
        return send_all(kSocket, &reply, sizeof(reply)) &&
               send_all(kSocket, result->pixels.data(), result->pixels.size());
    }
    std::string text = result.error().message;
    if (text.size() > kMaxWireMessage) text.resize(kMaxWireMessage);
    reply.status = result.error().code == ErrorCode::kTooLarge ? WireStatus::kTooLarge
                                                               : WireStatus::kUndecodable;
    reply.length = text.size();
    return send_all(kSocket, &reply, sizeof(reply)) &&
           send_all(kSocket, text.data(), text.size());
}

}  // namespace

int main(int argc, char** argv) {
    std::uint64_t address_space = 0;
    if (argc == 2) {
        std::from_chars(argv[1], argv[1] + std::strlen(argv[1]), address_space);
    }
    if (address_space == 0) {
        std::fputs(
            "haarmony-decode is started by haarmonyd and haarmony-ingest, not by hand.\n",
            stderr);
        return 2;
    }
    if (!confine(address_space)) return 3;
    while (auto received = receive_request(kSocket)) {
        if (!allow_seconds(received->request.cpu_seconds)) return 3;
        const Result<Raster> result = decode(*received);
        received->memory =
            FileDescriptor();  // before the answer: nothing is held between pictures
        if (!answer(result)) return 1;
    }
    return 0;
}
