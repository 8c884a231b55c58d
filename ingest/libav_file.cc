#include "ingest/libav_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>

namespace haarmony::ingest {
namespace {

constexpr int kReadAhead = 64 << 10;

}  // namespace

LibavFile::LibavFile(int descriptor) : descriptor_(descriptor) {
    struct stat look {};
    if (::fstat(descriptor_, &look) == 0) size_ = look.st_size;
    auto* buffer = static_cast<std::uint8_t*>(av_malloc(kReadAhead));
    if (buffer == nullptr) throw std::bad_alloc();
    io_.reset(avio_alloc_context(
        buffer, kReadAhead, 0, this, &LibavFile::read, nullptr, &LibavFile::seek));
    if (!io_) {
        av_free(buffer);
        throw std::bad_alloc();
    }
}

std::int64_t LibavFile::read_at(std::int64_t offset,
                                std::uint8_t* to,
                                std::int64_t count) const {
    ssize_t got = 0;
    do {
        got = ::pread(descriptor_, to, static_cast<std::size_t>(count), offset);
    } while (got < 0 && errno == EINTR);
    return got;
}

int LibavFile::read(void* self, std::uint8_t* to, int count) {
    auto* file = static_cast<LibavFile*>(self);
    const std::int64_t got = file->read_at(file->position_, to, count);
    if (got < 0) return AVERROR(EIO);
    if (got == 0) return AVERROR_EOF;
    file->position_ += got;
    return static_cast<int>(got);
}

std::int64_t LibavFile::seek(void* self, std::int64_t offset, int whence) {
    auto* file = static_cast<LibavFile*>(self);
    std::int64_t base = 0;
    switch (whence & ~AVSEEK_FORCE) {
        case AVSEEK_SIZE:
            return file->size_;
        case SEEK_SET:
            break;
        case SEEK_CUR:
            base = file->position_;
            break;
        case SEEK_END:
            base = file->size_;
            break;
        default:
            return AVERROR(EINVAL);
    }
    // Damaged files seek anywhere.
    if (offset < -base || offset > file->size_ - base) return AVERROR(EINVAL);
    return file->position_ = base + offset;
}

std::optional<PngAnimation> png_animation(const LibavFile& png) {
    constexpr std::int64_t kSignature = 8;
    constexpr std::int64_t kAroundChunk = 12;  // length, type, checksum
    constexpr int kUnsaidDenominator = 100;
    // A chunk up to the end of the delay in an fcTL.
    std::array<std::uint8_t, 32> head{};
    const auto number = [&head](std::size_t at, std::size_t bytes) {
        std::int64_t value = 0;
        for (std::size_t i = at; i < at + bytes; ++i) value = value << 8 | head[i];
        return value;
    };
    std::optional<PngAnimation> animation;
    bool uniform = true;
    std::int64_t at = kSignature;
    while (png.read_at(at, head.data(), head.size()) >= kAroundChunk) {
        const auto is = [&head](const char* type) {
            return std::memcmp(head.data() + 4, type, 4) == 0;
        };
        if (is("acTL") && !animation) animation = PngAnimation{number(8, 4), {}};
        if (is("IDAT") && !animation) return std::nullopt;
        if (is("fcTL") && animation) {
            const auto seconds = static_cast<std::int32_t>(number(28, 2));
            const auto parts = static_cast<std::int32_t>(number(30, 2));
            const video::FrameRate rate = {parts == 0 ? kUnsaidDenominator : parts,
                                           seconds};
            uniform = uniform && seconds > 0 && rate == animation->rate.value_or(rate);
            animation->rate = rate;
        }
        at += kAroundChunk + number(0, 4);
    }
    if (animation && !uniform) animation->rate.reset();
    return animation;
}

}  // namespace haarmony::ingest
