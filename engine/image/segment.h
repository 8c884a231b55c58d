// An immutable block of at most kMaxSegmentSlots pictures, ready to be searched.
//   segment_builder.h, segment_layout.h -> [segment.h] -> segment_search.h, collection.h
//
// Shape   one piece of memory, built here or mapped from a file (segment_layout.h); slots
//         are in the order of picture_order.h.
// Errors  none; a wrong shape is a caller's bug and asserts.
// Threads const-thread-safe.
// Source  sec. 4.3.1, 4.3.2; Figure 4.2.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/core/ids.h"
#include "engine/image/record.h"
#include "engine/image/segment_builder.h"
#include "engine/image/segment_layout.h"
#include "engine/image/tombstones.h"

namespace haarmony::image {

class PackedPictures;
class Segment;

// A segment and those of its pictures that are gone.
struct LiveSegment {
    std::shared_ptr<const Segment> segment;
    TombstonesPtr removed;

    [[nodiscard]] int live() const;
};

class Segment {
  public:
    // Requires: 1 <= size <= kMaxSegmentSlots, ids rising.
    [[nodiscard]] static std::shared_ptr<const Segment> from_records(
        std::span<const Record* const> records,
        int index_m);

    // Requires: 1 <= size <= kMaxSegmentSlots.
    [[nodiscard]] static std::shared_ptr<const Segment> from_pictures(
        const PackedPictures& pictures);

    // The live pictures of `parts`, or null where there are none.
    // Requires: at most kMaxSegmentSlots of them, no id live in two parts, one index_m.
    // Cost: memory of the result, some 50 bytes a picture beside it, and 12 MB at index_m = 60
    // for the pictures in hand (segment_pictures.h).
    [[nodiscard]] static std::shared_ptr<const Segment> merge(
        std::span<const LiveSegment> parts);

    // A segment in bytes that are kept alive by `owner`.
    [[nodiscard]] static std::shared_ptr<const Segment> from_view(
        const SegmentView& view,
        std::shared_ptr<const void> owner);

    [[nodiscard]] const SegmentView& view() const { return view_; }
    [[nodiscard]] int size() const { return static_cast<int>(view_.counts.slots); }
    [[nodiscard]] ImageId id(int slot) const {
        return ImageId{view_.ids[std::size_t(slot)]};
    }
    [[nodiscard]] std::optional<int> find(ImageId id) const;

    // All bytes, and those that no search under m = 20, 40 or index_m leaves unread.
    [[nodiscard]] SegmentBytes bytes() const { return segment_bytes(view_.counts); }

  private:
    Segment(const SegmentView& view, std::shared_ptr<const void> owner)
        : view_(view), owner_(std::move(owner)) {}
    explicit Segment(BuiltSegment built);

    SegmentView view_;
    std::shared_ptr<const void> owner_;
};

}  // namespace haarmony::image
