// The coefficients of a segment's pictures, read back from its rows and lists: what a merge
// builds its result from.
//   segment_layout.h -> [segment_pictures.h] -> picture_source.h, segment_builder.h
//
// A segment is read block by block, row by row. Pictures that are wanted in another order
// are gathered kGathered at a time, so that no more of them is ever kept twice; the price is
// another pass over the blocks that have some of them.
//
// Errors  none; a wrong shape is a caller's bug and asserts.
// Threads const-thread-safe.
// Source  sec. 4.3.1 (search arrays).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/image/picture_source.h"
#include "engine/image/segment_layout.h"

namespace haarmony::image {

class SegmentPictures final : public PictureSource {
  public:
    // Says of a slot that its picture is left out.
    static constexpr std::int32_t kLeftOut = -1;
    // Pictures that are kept beside the segments at once.
    static constexpr std::size_t kGathered = 1 << 15;

    struct Part {
        SegmentView view;                    // outlives this
        std::vector<std::int32_t> place_of;  // [slot], or kLeftOut
    };

    // Requires: each place below `pictures` once; one index_m.
    SegmentPictures(std::vector<Part> parts, std::size_t pictures);

    void give_all(const PictureSink& sink) const override;
    // Cost: memory of kGathered pictures, at most 6 * index_m bytes each.
    void give(std::span<const std::uint32_t> places,
              const PictureSink& sink) const override;

  private:
    std::vector<Part> parts_;
    std::size_t pictures_;
    std::size_t index_m_;
};

}  // namespace haarmony::image
