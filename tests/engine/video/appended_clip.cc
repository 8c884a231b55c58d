#include "tests/engine/video/appended_clip.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "engine/video/append.h"
#include "engine/video/build.h"
#include "engine/video/mrv_format.h"
#include "engine/video/mrv_writer.h"
#include "tests/engine/video/raw_source.h"

namespace haarmony::video::testing {

Result<void> GrowingBytes::write(std::uint64_t offset, std::span<const std::byte> bytes) {
    if (fail_at_ == static_cast<int>(writes_.size()))
        return Error{ErrorCode::kIo, "disk full"};
    assert(offset <= bytes_.size());
    bytes_.resize(std::max<std::size_t>(bytes_.size(), offset + bytes.size()));
    std::copy(
        bytes.begin(), bytes.end(), bytes_.begin() + static_cast<std::ptrdiff_t>(offset));
    writes_.push_back({offset, {bytes.begin(), bytes.end()}});
    return {};
}

Result<void> GrowingBytes::sync() {
    if (fail_at_ == static_cast<int>(writes_.size()))
        return Error{ErrorCode::kIo, "disk gone"};
    writes_.push_back({0, {}});
    return {};
}

RawClip part(const RawClip& clip, std::size_t first, std::size_t end) {
    return {clip.format,
            {clip.frames.begin() + static_cast<std::ptrdiff_t>(first),
             clip.frames.begin() + static_cast<std::ptrdiff_t>(end)}};
}

std::vector<std::byte> built_bytes(const RawClip& clip) {
    RawSource source(clip);
    MemorySpool frames;
    MemorySpool waiting;
    MemorySpool file;
    MrvWriter writer(waiting, file);
    bool written = build(source, frames, writer).has_value();
    std::vector<std::byte> bytes(writer.file_bytes());
    written = written && file.read(0, bytes).has_value();
    assert(written);
    return bytes;
}

std::unique_ptr<MrvClip> opened(const std::vector<std::byte>& file) {
    Result<std::unique_ptr<MrvClip>> clip = MrvClip::open(file, std::size_t{1} << 30);
    return clip ? *std::move(clip) : nullptr;
}

Result<void> append_to(GrowingBytes& file, const RawClip& more) {
    const std::vector<std::byte> before = file.bytes();
    const std::unique_ptr<MrvClip> clip = opened(before);
    assert(clip != nullptr);
    RawSource source(more);
    MemorySpool frames;
    MemorySpool waiting;
    MrvWriter writer(clip->front(), waiting, file);
    const Result<ClipShape> shape = append(*clip, source, frames, writer);
    if (!shape) return shape.error();
    return {};
}

std::vector<std::byte> appended_bytes(const RawClip& clip,
                                      const std::vector<std::size_t>& counts) {
    assert(std::accumulate(counts.begin(), counts.end(), std::size_t{0}) ==
           clip.frames.size());
    std::size_t end = counts.front();
    GrowingBytes file(built_bytes(part(clip, 0, end)));
    for (std::size_t i = 1; i < counts.size(); ++i) {
        [[maybe_unused]] const Result<void> appended =
            append_to(file, part(clip, end, end + counts[i]));
        assert(appended);
        end += counts[i];
    }
    return file.bytes();
}

}  // namespace haarmony::video::testing
