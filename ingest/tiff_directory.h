// The first directory of a TIFF structure: the header of TIFF files, and the inside of
// every EXIF block whatever file it sits in.
//
// Shape   classic TIFF and BigTIFF, either byte order; only the first directory.
// Errors  what is damaged or out of range is absent.
// Threads const-safe.
// Source  TIFF 6.0, section 2; EXIF 2.3, section 4.5.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace haarmony::ingest {

enum class TiffTag : std::uint16_t {
    kImageWidth = 256,
    kImageLength = 257,
    kOrientation = 274,
};

// The first value of a BYTE, SHORT, LONG or LONG8 entry.
[[nodiscard]] std::optional<std::uint64_t> first_directory_value(
    std::span<const std::uint8_t> tiff,
    TiffTag tag);

}  // namespace haarmony::ingest
