#include "engine/video/stream_coder.h"

#include <zstd.h>

#include <algorithm>
#include <memory>
#include <new>
#include <string>

namespace haarmony::video {
namespace {

// Shorter streams are not made shorter by a frame.
constexpr std::size_t kLeastFrame = 16;
constexpr std::size_t kMostVarint = 10;

// Its name in zstd.h is there for programs that link zstd statically only.
constexpr ZSTD_cParameter kLiteralCompressionMode = ZSTD_c_experimentalParam5;

struct Free {
    void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
    void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

// One of each a thread: making one takes as long as a small chunk.
ZSTD_CCtx* compressor() {
    thread_local const std::unique_ptr<ZSTD_CCtx, Free> context(ZSTD_createCCtx());
    if (context == nullptr) throw std::bad_alloc();
    return context.get();
}
ZSTD_DCtx* decompressor() {
    thread_local const std::unique_ptr<ZSTD_DCtx, Free> context(ZSTD_createDCtx());
    if (context == nullptr) throw std::bad_alloc();
    return context.get();
}

Error damaged(const std::string& what) { return {ErrorCode::kUndecodable, what}; }

void set_up(ZSTD_CCtx* context, Redundancy redundancy) {
    ZSTD_CCtx_reset(context, ZSTD_reset_session_and_parameters);
    const int level = redundancy == Redundancy::kSearched ? 7 : 1;
    ZSTD_CCtx_setParameter(context, ZSTD_c_compressionLevel, level);
    if (redundancy != Redundancy::kFrequent) return;
    // Steps over so much that it finds no repetition: bytes are only counted (which is off by
    // itself where zstd is to be that fast).
    ZSTD_CCtx_setParameter(context, ZSTD_c_strategy, ZSTD_fast);
    ZSTD_CCtx_setParameter(context, ZSTD_c_targetLength, 1 << 17);
    ZSTD_CCtx_setParameter(context, ZSTD_c_hashLog, 6);
    ZSTD_CCtx_setParameter(context, kLiteralCompressionMode, 1);
}

}  // namespace

void put_stream(std::span<const std::uint8_t> stream,
                Redundancy redundancy,
                std::vector<std::byte>& out) {
    const std::size_t begin = out.size();
    if (stream.size() >= kLeastFrame) {
        ZSTD_CCtx* const context = compressor();
        set_up(context, redundancy);
        // Both varints are put once the frame's size is known; it stands behind them.
        const std::size_t bound = ZSTD_compressBound(stream.size());
        out.resize(begin + 2 * kMostVarint + bound);
        std::byte* const frame = out.data() + begin + 2 * kMostVarint;
        const std::size_t coded =
            ZSTD_compress2(context, frame, bound, stream.data(), stream.size());
        if (ZSTD_isError(coded) != 0) throw std::bad_alloc();
        if (coded < stream.size()) {
            std::vector<std::byte> front;
            put_varint(front, 2 * std::uint64_t{stream.size()} + 1);
            put_varint(front, coded);
            std::copy(front.begin(), front.end(), out.data() + begin);
            std::memmove(out.data() + begin + front.size(), frame, coded);
            out.resize(begin + front.size() + coded);
            return;
        }
        out.resize(begin);
    }
    put_varint(out, 2 * std::uint64_t{stream.size()});
    const auto bytes = std::as_bytes(stream);
    out.insert(out.end(), bytes.begin(), bytes.end());
}

Result<Stream> StreamReader::next(std::uint64_t most) {
    const std::uint64_t kind = in_.varint();
    const std::uint64_t size = kind >> 1;
    if (size > most) {
        return damaged("stream of " + std::to_string(size) + " bytes, at most " +
                       std::to_string(most) + " expected");
    }
    const bool framed = (kind & 1) != 0;
    const std::uint64_t coded = framed ? in_.varint() : size;
    if (in_.overrun() || coded > in_.rest().size()) return damaged("stream cut off");
    const std::span<const std::byte> bytes = in_.take(coded);
    // One frame that says its size, and nothing behind it.
    if (framed &&
        (ZSTD_getFrameContentSize(bytes.data(), bytes.size()) != size ||
         ZSTD_findFrameCompressedSize(bytes.data(), bytes.size()) != bytes.size())) {
        return damaged("frame of a stream of " + std::to_string(size) + " bytes");
    }
    Stream stream(size);
    if (!framed) {
        if (size > 0) std::memcpy(stream.data(), bytes.data(), size);
        return stream;
    }
    const std::size_t done = ZSTD_decompressDCtx(
        decompressor(), stream.data(), stream.size(), bytes.data(), bytes.size());
    if (ZSTD_isError(done) != 0 || done != size) {
        return damaged("stream of " + std::to_string(size) +
                       " bytes: " + ZSTD_getErrorName(done));
    }
    return stream;
}

}  // namespace haarmony::video
