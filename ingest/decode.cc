#include "ingest/decode.h"

#include <chrono>
#include <optional>
#include <string>
#include <utility>

#include "ingest/decoder_child.h"
#include "ingest/dimensions.h"
#include "ingest/jpeg.h"
#include "ingest/orientation.h"
#include "ingest/png.h"
#include "ingest/sniff.h"
#include "ingest/unsupported.h"

namespace haarmony::ingest {
Decoder::Decoder(const DecodeLimits& limits) : limits_(limits) {}

Decoder::~Decoder() = default;

Result<Picture> Decoder::decode(std::span<const std::uint8_t> bytes) {
    const std::optional<FileType> type = sniff(bytes);
    if (!type || !type->format) return unsupported_format(bytes, "picture");
    const Format format = *type->format;
    const Result<Dimensions> dimensions = read_dimensions(format, bytes);
    if (!dimensions) return dimensions.error();
    const Result<void> fits = check_pixels(*dimensions, limits_.max_pixels);
    if (!fits) return fits.error();

    Result<Raster> raster = decode_raster(format, bytes);
    if (!raster) return std::move(raster).error();
    const int orientation = exif_orientation(format, bytes);
    // A JPEG may come back smaller than it is; the other decoders know best.
    std::pair<int, int> size = {raster->width, raster->height};
    if (format == Format::kJpeg) {
        size = {static_cast<int>(dimensions->width),
                static_cast<int>(dimensions->height)};
    }
    if (orientation >= 5) std::swap(size.first, size.second);
    Raster turned = upright(std::move(raster).value(), orientation);

    Picture picture;
    picture.pixels = std::move(turned.pixels);
    picture.pixel_width = turned.width;
    picture.pixel_height = turned.height;
    picture.channels = turned.channels;
    picture.width = size.first;
    picture.height = size.second;
    picture.media_type = std::string(type->media_type);
    return picture;
}

Result<Raster> Decoder::decode_raster(Format format,
                                      std::span<const std::uint8_t> bytes) {
    if (format == Format::kJpeg) return decode_jpeg(bytes, limits_.min_side);
    if (format == Format::kPng) return decode_png(bytes);
    if (!child_) {
        ChildOptions options;
        options.program = limits_.child_program.empty() ? find_decoder_program()
                                                        : limits_.child_program;
        options.address_space = limits_.child_bytes;
        options.cpu_seconds = limits_.child_seconds;
        options.patience = std::chrono::seconds(limits_.child_wall_seconds);
        options.max_pixels = limits_.max_pixels;
        child_ = std::make_unique<DecoderChild>(std::move(options));
    }
    return child_->decode(format, bytes);
}

}  // namespace haarmony::ingest
