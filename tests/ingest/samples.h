// Pictures for the tests of decoding, and files made of them: through OpenImageIO's and
// libjpeg's writers, libwebp's encoder, or byte by byte.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ingest/decode.h"
#include "ingest/raster.h"
#include "ingest/sniff.h"

namespace haarmony::ingest {

using Bytes = std::vector<std::uint8_t>;

// Smooth, and different from each of its mirrors and turns: red grows to the right, green
// downwards, and a blue patch lies at the top left. Grey (1 channel): red's ramp and the
// patch. Alpha (4 channels) grows to the right from 64 to 255.
[[nodiscard]] Raster sample_picture(int width, int height, int channels);

// Bytes that count for a constant colour.
[[nodiscard]] Raster flat_picture(int width, int height, std::vector<std::uint8_t> color);

// The largest difference of two samples; the test fails where shapes differ.
[[nodiscard]] int largest_difference(const Raster& a, const Raster& b);
[[nodiscard]] double mean_difference(const Raster& a, const Raster& b);

// How OpenImageIO's writer is asked.
struct OiioFile {
    std::string extension;  // "png"
    std::string type = "uint8";
    std::string compression = {};
    bool straight_alpha = true;
    int orientation = 0;  // 0: no tag
    std::string color_space = {};
    int tile_side = 0;
    int frames = 1;  // the same picture, each frame darker than the one before
};
[[nodiscard]] Bytes write_with_oiio(const Raster& picture, const OiioFile& file);
// Linear samples as they are, e.g. for OpenEXR.
[[nodiscard]] Bytes write_floats_with_oiio(const std::vector<float>& samples,
                                           int width,
                                           int height,
                                           int channels,
                                           const OiioFile& file);

struct JpegFile {
    int quality = 95;
    bool progressive = false;
    bool cmyk = false;         // the picture has 4 channels: inks, 0 = none
    bool adobe_marker = true;  // inverted inks and the marker that says so
    bool ycck = false;
    Bytes exif = {};      // content of APP1
    int scans = 0;        // > 0: a progressive script of that many scans
    int subsampling = 2;  // 1: none, 2: 4:2:0
};
[[nodiscard]] Bytes write_jpeg(const Raster& picture, const JpegFile& file);

// VP8L inside RIFF; 3 or 4 channels, exact.
[[nodiscard]] Bytes write_webp(const Raster& picture);
// The extended container: an EXIF block (may be empty).
[[nodiscard]] Bytes write_webp_with_exif(const Raster& picture, const Bytes& exif);
// Frames at (2, 2) of a canvas.
[[nodiscard]] Bytes write_animated_webp(const std::vector<Raster>& frames,
                                        int canvas_width,
                                        int canvas_height);

// A TIFF structure that holds the orientation tag and another before it.
[[nodiscard]] Bytes exif_tiff(int orientation, bool big_endian);
// The same as the content of a JPEG's APP1.
[[nodiscard]] Bytes exif_segment(int orientation, bool big_endian);

// A PNG chunk in front of the first IDAT.
[[nodiscard]] Bytes insert_png_chunk(const Bytes& png,
                                     std::string_view type,
                                     const Bytes& content);
// Signature and IHDR and nothing else.
[[nodiscard]] Bytes png_header(std::uint32_t width, std::uint32_t height);

// One small valid file of each format, named for messages.
struct SampleFile {
    Format format;
    Bytes bytes;
};
[[nodiscard]] const std::vector<SampleFile>& sample_files();

// Default limits; its child is started once for all tests of a process.
[[nodiscard]] Decoder& shared_decoder();
[[nodiscard]] Raster raster_of(const Picture& picture);

// Numbers as bytes.
void append(Bytes& bytes, std::uint64_t value, int count, bool big_endian);
[[nodiscard]] Bytes text_bytes(std::string_view text);

// A folder that goes away with the test.
class ScratchFolder {
  public:
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    [[nodiscard]] std::string path(std::string_view name) const;

  private:
    std::string folder_;
};

}  // namespace haarmony::ingest
