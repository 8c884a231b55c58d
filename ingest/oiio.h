// Pixels of every format but JPEG, PNG and WebP, through OpenImageIO
// (ingest, step 2, in the child): sniff -> dimensions -> [oiio] -> orientation.
//
// Its readers are shown bytes in memory under a name of ours; libheif alone insists on a
// file and gets an unlinked one. Only the first picture of a file is read. Colour profiles
// are not applied.
//
// Shape   1, 3 or 4 channels; grey with alpha becomes 4. Channels beyond are dropped.
// Units   sRGB bytes, straight alpha: premultiplied, 16-bit, float and linear sources are
//         converted.
// Errors  kUndecodable with OpenImageIO's words; kTooLarge where the decoder finds more
//         pixels than the header said, or memory runs out.
// Threads const-safe; OpenImageIO starts no threads of its own.
#pragma once

#include <cstdint>
#include <span>

#include "engine/core/result.h"
#include "ingest/raster.h"
#include "ingest/sniff.h"

namespace haarmony::ingest {

// The same bytes twice: mapped, and as a descriptor for the reader that wants a file.
struct OiioSource {
    Format format = Format::kTiff;
    std::span<const std::uint8_t> bytes;
    int fd = -1;  // only used for HEIF and AVIF
};

[[nodiscard]] Result<Raster> decode_oiio(const OiioSource& source,
                                         std::int64_t max_pixels);

}  // namespace haarmony::ingest
