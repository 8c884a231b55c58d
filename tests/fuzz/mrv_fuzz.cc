// Whatever is in a .mrv file: refused with a reason, or read as a clip that can be written and
// read again. As the bytes come, and as changes of a whole file with checksums that fit, so
// that what is behind them is reached.
//
// The first byte says which, and of which file: one that was built at once, or one that grew.
// Changes are five bytes each: where, and what is put there.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "engine/video/mrv_clip.h"
#include "engine/video/mrv_format.h"
#include "tests/engine/video/appended_clip.h"
#include "tests/engine/video/random_links.h"

namespace {

using namespace haarmony;
using namespace haarmony::video;

constexpr std::size_t kCacheBytes = 1U << 16;

void require(bool holds) {
    if (!holds) std::abort();
}

void read_all(std::span<const std::byte> file) {
    const Result<std::unique_ptr<MrvClip>> clip = MrvClip::open(file, kCacheBytes);
    if (!clip) {
        require(!clip.error().message.empty());
        return;
    }
    const Result<void> checked = (*clip)->verify();
    require(checked.has_value() || !checked.error().message.empty());
    require((*clip)->cached_bytes() <= kCacheBytes);
    if (!checked) return;
    // A clip that is whole gives frames.
    const ClipShape& shape = (*clip)->shape();
    const NodeAddress last{shape.time_levels(), shape.frames() - 1};
    require((*clip)->frame(last, shape.space_levels()).has_value());
}

// The chunks' checksums in their index, as a writer would have put them. An entry is found by
// what stands there: changes leave the index itself alone.
void seal_chunks(std::vector<std::byte>& file,
                 const MrvIndex& index,
                 std::uint64_t index_bytes) {
    const std::size_t end = index.chunk(0, 0).offset;
    for (int row = 0; row < index.rows(); ++row) {
        for (std::size_t i = 0; i < index.siblings(); ++i) {
            const MrvChunk& chunk = index.chunk(row, i);
            if (chunk.bytes == 0) continue;
            const std::uint64_t sum =
                mrv_checksum(std::span(file).subspan(chunk.offset, chunk.bytes));
            for (std::size_t at = end - index_bytes; at + 8 <= end; ++at) {
                if (std::memcmp(file.data() + at, &chunk.checksum, 8) != 0) continue;
                std::memcpy(file.data() + at, &sum, sizeof sum);
                break;
            }
        }
    }
}

struct Whole {
    std::vector<std::byte> bytes;
    MrvFront front;
};
const Whole& whole(bool grown) {
    const auto made = [](std::vector<std::byte> bytes) {
        MrvFront front = *decode_front(bytes);
        return Whole{std::move(bytes), std::move(front)};
    };
    static const Whole at_once =
        made(testing::mrv_bytes(testing::linked_clip(20, 17, 3, 12)));
    static const Whole appended =
        made(testing::appended_bytes(testing::random_clip(20, 17, 5, 12), {2, 1, 2}));
    return grown ? appended : at_once;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* input, std::size_t size) {
    if (size == 0) return 0;
    const bool changes = input[0] % 4 != 0;
    const bool in_chunks = input[0] % 4 != 1;
    if (!changes) {
        read_all(std::as_bytes(std::span(input + 1, size - 1)));
        return 0;
    }
    const Whole& clip = whole(input[0] % 8 >= 4);
    const std::size_t begin = in_chunks ? clip.front.index.chunk(0, 0).offset : 0;
    std::vector<std::byte> file = clip.bytes;
    for (std::size_t at = 1; at + 5 <= size; at += 5) {
        std::uint32_t place = 0;
        std::memcpy(&place, input + at, sizeof place);
        file[begin + place % (file.size() - begin)] = std::byte{input[at + 4]};
    }
    if (in_chunks) seal_chunks(file, clip.front.index, clip.front.index_bytes);
    testing::seal_front(file);
    read_all(file);
    return 0;
}
