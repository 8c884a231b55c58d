// haarmony-decode BYTES: decodes pictures for haarmonyd and haarmony-ingest, one after the
// other, with at most BYTES of address space. Started by them with a socket as descriptor 0
// (decoder_wire.h); of no use by hand.
#include <cstdint>
#include <cstdio>
#include <new>
#include <string>

#include "ingest/confine.h"
#include "ingest/decoder_wire.h"
#include "ingest/mapping.h"
#include "ingest/oiio.h"
#include "ingest/webp.h"

namespace {

using haarmony::Error;
using haarmony::ErrorCode;
using haarmony::Result;
using namespace haarmony::ingest;

constexpr int kSocket = 0;

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
    const std::uint64_t address_space = address_space_argument(argc, argv);
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
