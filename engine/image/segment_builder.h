// Builds the bytes of a segment from the coefficients of its pictures.
//   picture_source.h, picture_order.h, row_writer.h -> [segment_builder.h] -> segment_layout.h
//
// Pictures are looked at twice: as they come, to count the lists and to find their order,
// and then in that order. So all bytes are written from the front to the back, a block of
// pictures at a time, and none is read again.
//
// Shape   pictures have places, 0 .. count - 1, in rising order of id; their slots follow
//         from picture_order.h.
// Errors  none; a wrong shape is a caller's bug and asserts.
// Threads const-thread-safe: a segment is built by one thread, several at a time.
// Source  sec. 4.3.1 (search arrays).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/core/ids.h"
#include "engine/image/picture_source.h"
#include "engine/image/segment_layout.h"

namespace haarmony::image {

struct PictureColumns {
    std::vector<ImageId> ids;  // rising
    std::vector<PictureTerms> terms;
};

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

// Requires: 1 .. kMaxSegmentSlots pictures, with at most index_m coefficients of each
// channel. Cost: memory of the segment, and some 50 bytes a picture while it is built.
[[nodiscard]] BuiltSegment build_segment(int index_m,
                                         const PictureColumns& columns,
                                         const PictureSource& pictures);

}  // namespace haarmony::image
