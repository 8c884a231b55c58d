#include "ingest/decoder_child.h"

#include <utility>

#include "ingest/one_line.h"
#include "ingest/socket_wire.h"

namespace haarmony::ingest {
namespace {

using Clock = SocketChild::Clock;

constexpr const char* kProgramName = "haarmony-decode";

std::string name_of(Format format) { return std::string(describe_format(format).name); }

}  // namespace

std::string find_decoder_program() { return find_program(kProgramName); }

DecoderChild::DecoderChild(ChildOptions options) : options_(std::move(options)) {}

// A child that died since the last picture (killed when memory was short, say) is no fault
// of this one: it is replaced once.
Result<void> DecoderChild::request(Format format, std::span<const std::uint8_t> bytes) {
    Result<FileDescriptor> memory = sealed_memory(bytes);
    if (!memory) return memory.error();
    WireRequest message;
    message.format = static_cast<std::uint32_t>(format);
    message.size = bytes.size();
    message.max_pixels = options_.max_pixels;
    message.cpu_seconds = options_.cpu_seconds;
    for (int attempt = 0; attempt < 2; ++attempt) {
        if (!child_.running()) {
            auto started = child_.start(
                options_.program, "decodes this format", options_.address_space);
            if (!started) return started;
        }
        if (send_request(child_.socket(), message, memory->get())) return {};
        child_.kill_and_wait();
    }
    return Error{ErrorCode::kIo,
                 std::string(kProgramName) + " ends as soon as it starts"};
}

// The child is of no more use: `sign` is what we saw of it.
Error DecoderChild::bury(Format format, const std::string& sign) {
    return {ErrorCode::kUndecodable,
            "damaged " + name_of(format) + ": its decoder " +
                child_.bury(sign, options_.cpu_seconds)};
}

Result<Raster> DecoderChild::receive(Format format) {
    const Clock::time_point deadline = Clock::now() + options_.patience;
    const auto failure = [&](Received received) {
        if (received == Received::kEnd) return bury(format, "");
        return bury(
            format,
            "did not answer within " + std::to_string(options_.patience.count()) + " ms");
    };
    WireReply reply;
    Received received = child_.receive(&reply, sizeof(reply), deadline);
    if (received != Received::kAll) return failure(received);
    if (!check_reply(reply, options_.max_pixels)) {
        return bury(format, "crashed (its answer makes no sense)");
    }
    if (reply.status == WireStatus::kPixels) {
        Raster raster(reply.width, reply.height, reply.channels);
        received = child_.receive(raster.pixels.data(), raster.pixels.size(), deadline);
        if (received != Received::kAll) return failure(received);
        return raster;
    }
    std::string text(reply.length, '\0');
    received = child_.receive(text.data(), text.size(), deadline);
    if (received != Received::kAll) return failure(received);
    return Error{reply.status == WireStatus::kTooLarge ? ErrorCode::kTooLarge
                                                       : ErrorCode::kUndecodable,
                 one_line(text)};
}

Result<Raster> DecoderChild::decode(Format format, std::span<const std::uint8_t> bytes) {
    if (auto requested = request(format, bytes); !requested) return requested.error();
    return receive(format);
}

}  // namespace haarmony::ingest
