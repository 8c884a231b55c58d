// Builds the bytes of a segment from the postings of its pictures.
//   picture_order.h -> [segment_builder.h] -> segment_layout.h
//
// Shape   pictures have places, 0 .. count - 1, in rising order of id; their slots follow
//         from picture_order.h.
// Errors  none; a wrong shape is a caller's bug and asserts.
// Threads const-thread-safe: a segment is built by one thread, several at a time.
// Source  sec. 4.3.1 (search arrays).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "engine/core/ids.h"
#include "engine/image/segment_layout.h"

namespace haarmony::image {

struct PlacedPosting {
    std::uint32_t key = 0;
    std::uint32_t place = 0;  // of the picture
    std::uint8_t rank = 0;    // 0..index_m - 1
};

struct PictureColumns {
    std::vector<ImageId> ids;  // rising
    std::vector<PictureTerms> terms;
};

// Gives every posting, some at a time, in any order; best list by list, or picture by picture
// in the order of `places`, so that neighbouring writes meet.
using PostingSink = std::function<void(std::span<const PlacedPosting>)>;
using PostingSource =
    std::function<void(std::span<const std::uint32_t> places, const PostingSink& sink)>;

// Memory that is aligned as segments want it.
struct AlignedBytesDeleter {
    void operator()(std::byte* bytes) const;
};
struct AlignedBytes {
    std::unique_ptr<std::byte[], AlignedBytesDeleter> bytes;
    std::size_t size = 0;

    [[nodiscard]] std::span<std::byte> span() const { return {bytes.get(), size}; }
};

struct BuiltSegment {
    SegmentCounts counts;
    AlignedBytes bytes;
};

// Requires: 1 .. kMaxSegmentSlots pictures. Cost: the source is asked three times, seldom
// once more.
[[nodiscard]] BuiltSegment build_segment(int index_m,
                                         const PictureColumns& columns,
                                         const PostingSource& postings);

}  // namespace haarmony::image
