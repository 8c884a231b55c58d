// Where a segment's builder has its pictures' coefficients from.
//   record.h, segment_pictures.h -> [picture_source.h] -> segment_builder.h
//
// Shape   pictures have places, 0 .. count - 1, in rising order of id.
// Errors  none.
// Threads const-thread-safe.
// Source  sec. 4.3.1 (search arrays).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>

#include "engine/image/record.h"
#include "engine/image/signature.h"

namespace haarmony::image {

// Of each channel the signed indices of a picture, in falling order of magnitude, so that a
// coefficient's rank is its place here.
using PictureCoefficients = std::array<std::span<const std::int16_t>, kChannels>;
// What it is given lives until it returns.
using PictureSink =
    std::function<void(std::uint32_t place, const PictureCoefficients& coefficients)>;

class PictureSource {
  public:
    PictureSource() = default;
    PictureSource(const PictureSource&) = delete;
    PictureSource& operator=(const PictureSource&) = delete;
    virtual ~PictureSource() = default;

    // Every picture once, in the order that costs least.
    virtual void give_all(const PictureSink& sink) const = 0;
    // The pictures of these places, in this order.
    virtual void give(std::span<const std::uint32_t> places,
                      const PictureSink& sink) const = 0;
};

// The index_m largest coefficients of records, each at its place.
class RecordPictures final : public PictureSource {
  public:
    // The records outlive this.
    RecordPictures(std::span<const Record* const> records, int index_m)
        : records_(records), index_m_(index_m) {}

    void give_all(const PictureSink& sink) const override;
    void give(std::span<const std::uint32_t> places,
              const PictureSink& sink) const override;

  private:
    [[nodiscard]] PictureCoefficients coefficients(std::uint32_t place) const;

    std::span<const Record* const> records_;
    int index_m_;
};

}  // namespace haarmony::image
