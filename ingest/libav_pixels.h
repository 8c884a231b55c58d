// A decoded frame of any pixel format as straight RGBA
// (video, in the child): libav_source.h -> [libav_pixels.h] -> display_matrix.h.
//
// Shape   clear pixels canonical.
// Units   8 bits. The file's own colour matrix and range; where it has none, BT.709 from 720
//         lines on and BT.601 below, limited range.
// Errors  kUndecodable: a pixel format that swscale does not read.
// Threads one caller a converter.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/result.h"
#include "engine/video/picture.h"
#include "ingest/libav.h"

namespace haarmony::ingest {

class LibavPixels {
  public:
    // Requires: the frame has pixels.
    [[nodiscard]] Result<void> convert(const AVFrame& frame, video::Picture& picture);

  private:
    [[nodiscard]] Result<void> prepare(const AVFrame& frame);

    Libav<SwsContext> scaler_;
    std::vector<std::uint8_t> rows_;  // swscale writes beyond the end of a row
    int stride_ = 0;
    int width_ = 0;
    int height_ = 0;
    int pixel_format_ = -1;
    int matrix_ = -1;
    int range_ = -1;
};

}  // namespace haarmony::ingest
