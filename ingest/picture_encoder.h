// Our own pixels as files without loss, quickly: what is drawn from a video on every request.
//
// The compression is the quickest of each library: at 256 x 256 pixels a reply leaves before
// a better one would have been half made.
//
// Shape   pixels straight RGBA or RGB; where none is transparent the file has no alpha.
// Errors  kInvalidArgument for what the format cannot say, with the library's words.
// Threads const-safe.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/image_view.h"
#include "engine/core/result.h"

namespace haarmony::ingest {

// Require: 3 or 4 channels; width, height >= 1.
[[nodiscard]] Result<std::vector<std::uint8_t>> encode_png(const ImageView& picture);
// At most 16,383 pixels a side.
[[nodiscard]] Result<std::vector<std::uint8_t>> encode_webp(const ImageView& picture);

// Whether some pixel is transparent, if only a little.
[[nodiscard]] bool has_transparency(const ImageView& picture);

}  // namespace haarmony::ingest
