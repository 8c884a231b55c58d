// Pictures on their way into a segment, each with no more than a segment keeps of it, one
// after another in one piece of memory.
//   signature.h -> [packed_pictures.h] -> segment_builder.h
//
// Shape   of each picture index_m coefficients a channel at most: 360 bytes at index_m = 60,
//         where a Record takes 640.
// Errors  none; a wrong shape is a caller's bug and asserts.
// Threads const-thread-safe.
// Source  sec. 4.3.1 (search arrays).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/image/picture_source.h"
#include "engine/image/segment_builder.h"

namespace haarmony::image {

class PackedPictures final : public PictureSource {
  public:
    // Requires: 1 <= index_m <= kMaxCoefficients.
    explicit PackedPictures(int index_m);

    [[nodiscard]] int index_m() const { return index_m_; }
    [[nodiscard]] std::size_t size() const { return columns_.ids.size(); }
    [[nodiscard]] const PictureColumns& columns() const { return columns_; }

    void reserve(std::size_t pictures);
    // Requires: an id above all before.
    void add(ImageId id, const Signature& signature, std::int32_t log_aspect);
    // Forgets the pictures and keeps the memory.
    void clear();

    void give_all(const PictureSink& sink) const override;
    void give(std::span<const std::uint32_t> places,
              const PictureSink& sink) const override;

  private:
    // Of one picture: kChannels lists of index_m, which are not always full.
    [[nodiscard]] std::size_t stride() const {
        return std::size_t{kChannels} * std::size_t(index_m_);
    }
    [[nodiscard]] PictureCoefficients coefficients(std::uint32_t place) const;
    void fetch(std::uint32_t place) const;

    int index_m_;
    PictureColumns columns_;
    std::vector<std::array<std::uint8_t, kChannels>> counts_;  // [place]
    std::vector<std::int16_t> indices_;  // [place][channel][rank], index_m ranks each
};

}  // namespace haarmony::image
