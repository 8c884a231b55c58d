// A small JPEG of a picture, for lists of results.
//
// Shape   longest side kThumbnailSide, never enlarged; alpha over white; quality 80.
// Threads const-safe.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/image_view.h"
#include "engine/core/result.h"

namespace haarmony::ingest {

inline constexpr int kThumbnailSide = 256;

[[nodiscard]] Result<std::vector<std::uint8_t>> make_thumbnail(const ImageView& picture);

// A baseline JPEG of the view's size. Requires: 1, 3 or 4 channels; quality 1..100.
[[nodiscard]] Result<std::vector<std::uint8_t>> encode_jpeg(const ImageView& picture,
                                                            int quality);

}  // namespace haarmony::ingest
