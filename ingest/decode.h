// From bytes of unknown origin to pixels, or to the reason why not
// (ingest, step 2 of 4): walk -> [decode] -> describe -> store.
//
// The format is what the first bytes say (sniff.h), never a name; dimensions are read from
// the header and checked against the limits before a decoder sees the bytes. JPEG and PNG
// are decoded in this process, everything else in a child with resource limits.
//
// Shape   pixels upright (EXIF orientation applied), 1, 3 or 4 channels, tightly packed.
// Units   sRGB bytes, straight alpha. 16-bit, float and linear sources are converted.
// Scale   JPEGs may come back smaller than they are (a power of two, never below
//         `min_side` on either side); width and height tell the picture's own size.
// Errors  kUnsupportedFormat (names the detected type where one is known), kUndecodable
//         (truncated, damaged, crashed its decoder), kTooLarge (names pixels and limit).
// Threads one Decoder a thread.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/core/image_view.h"
#include "engine/core/result.h"
#include "ingest/raster.h"
#include "ingest/sniff.h"

namespace haarmony::ingest {

class DecoderChild;

// Changes whenever the same bytes may give other pixels; kept with every signature.
inline constexpr int kDecodeRule = 1;

struct DecodeLimits {
    std::int64_t max_pixels = 100'000'000;
    int min_side = 256;           // scaled decoding keeps at least this on each side
    int child_seconds = 20;       // processor time a child may take for one picture
    int child_wall_seconds = 60;  // time by the clock before a child is killed
    std::int64_t child_bytes = std::int64_t{2} << 30;  // address space of a child
    std::string child_program = {};  // empty: haarmony-decode beside us or in ../libexec
};

struct Picture {
    std::vector<std::uint8_t> pixels;
    int pixel_width = 0;  // of `pixels`
    int pixel_height = 0;
    int channels = 0;
    int width = 0;  // of the original, upright
    int height = 0;
    std::string media_type;  // as sniffed, e.g. "image/jpeg"

    [[nodiscard]] ImageView view() const {
        return {pixels.data(),
                pixel_width,
                pixel_height,
                channels,
                static_cast<std::ptrdiff_t>(pixel_width) * channels};
    }
};

class Decoder {
  public:
    explicit Decoder(const DecodeLimits& limits);
    ~Decoder();
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;

    [[nodiscard]] Result<Picture> decode(std::span<const std::uint8_t> bytes);

  private:
    [[nodiscard]] Result<Raster> decode_raster(Format format,
                                               std::span<const std::uint8_t> bytes);

    DecodeLimits limits_;
    std::unique_ptr<DecoderChild> child_;  // started for the first risky picture, kept
};

}  // namespace haarmony::ingest
