#include "ingest/dimensions.h"

#include <limits>
#include <string>

#include "ingest/byte_reader.h"
#include "ingest/tiff_directory.h"

namespace haarmony::ingest {
namespace {

using Bytes = std::span<const std::uint8_t>;

std::optional<Dimensions> both(std::optional<std::uint64_t> width,
                               std::optional<std::uint64_t> height) {
    constexpr std::uint64_t kMax = std::numeric_limits<std::int32_t>::max();
    if (!width || !height || *width > kMax || *height > kMax) return std::nullopt;
    return Dimensions{static_cast<std::int64_t>(*width),
                      static_cast<std::int64_t>(*height)};
}

std::optional<Dimensions> png_dimensions(Bytes bytes) {
    const ByteReader reader(bytes, ByteOrder::kBig);
    if (!reader.has(12, "IHDR")) return std::nullopt;
    return both(reader.u32(16), reader.u32(20));
}

std::optional<Dimensions> gif_dimensions(Bytes bytes) {
    const ByteReader reader(bytes, ByteOrder::kLittle);
    return both(reader.u16(6), reader.u16(8));
}

std::optional<Dimensions> bmp_dimensions(Bytes bytes) {
    const ByteReader reader(bytes, ByteOrder::kLittle);
    if (reader.u32(14) == 12) return both(reader.u16(18), reader.u16(20));
    auto height = reader.u32(22);
    // A negative height means rows from the top down.
    if (height && *height >= 0x8000'0000u) height = 0x1'0000'0000u - *height;
    return both(reader.u32(18), height);
}

std::optional<Dimensions> tiff_dimensions(Bytes bytes) {
    return both(first_directory_value(bytes, TiffTag::kImageWidth),
                first_directory_value(bytes, TiffTag::kImageLength));
}

std::optional<Dimensions> parse(Format format, Bytes bytes) {
    switch (format) {
        case Format::kJpeg:
            return jpeg_dimensions(bytes);
        case Format::kPng:
            return png_dimensions(bytes);
        case Format::kGif:
            return gif_dimensions(bytes);
        case Format::kWebp:
            return webp_dimensions(bytes);
        case Format::kTiff:
            return tiff_dimensions(bytes);
        case Format::kHeif:
        case Format::kAvif:
            return heif_dimensions(bytes);
        case Format::kBmp:
            return bmp_dimensions(bytes);
        case Format::kJpeg2000:
            return jpeg2000_dimensions(bytes);
        case Format::kOpenExr:
            return openexr_dimensions(bytes);
    }
    return std::nullopt;
}

}  // namespace

std::optional<Dimensions> jpeg_dimensions(Bytes bytes) {
    const ByteReader reader(bytes, ByteOrder::kBig);
    std::uint64_t at = 2;
    while (const auto lead = reader.u8(at)) {
        if (*lead != 0xff) return std::nullopt;
        const auto marker = reader.u8(at + 1);
        if (!marker) return std::nullopt;
        if (*marker == 0xff) {  // a fill byte
            ++at;
            continue;
        }
        const bool frame = *marker >= 0xc0 && *marker <= 0xcf && *marker != 0xc4 &&
                           *marker != 0xc8 && *marker != 0xcc;
        if (frame) return both(reader.u16(at + 7), reader.u16(at + 5));
        const bool alone = *marker == 0x01 || (*marker >= 0xd0 && *marker <= 0xd7);
        const bool scan_or_end = *marker == 0xda || *marker == 0xd9 || *marker == 0x00;
        if (scan_or_end) return std::nullopt;
        const std::uint64_t length = alone ? 0 : reader.u16(at + 2).value_or(0);
        if (!alone && length < 2) return std::nullopt;
        at += 2 + length;
    }
    return std::nullopt;
}

std::optional<Dimensions> webp_dimensions(Bytes bytes) {
    const ByteReader reader(bytes, ByteOrder::kLittle);
    if (reader.has(12, "VP8X")) {
        const auto width = reader.u24(24);
        const auto height = reader.u24(27);
        if (!width || !height) return std::nullopt;
        return both(*width + 1, *height + 1);
    }
    if (reader.has(12, "VP8L")) {
        const auto bits = reader.u32(21);
        if (reader.u8(20) != 0x2f || !bits) return std::nullopt;
        return both((*bits & 0x3fff) + 1, (*bits >> 14 & 0x3fff) + 1);
    }
    if (!reader.has(12, "VP8 ") || !reader.has(23, "\x9d\x01\x2a")) return std::nullopt;
    const auto width = reader.u16(26);
    const auto height = reader.u16(28);
    if (!width || !height) return std::nullopt;
    return both(*width & 0x3fff, *height & 0x3fff);
}

Result<Dimensions> read_dimensions(Format format, Bytes bytes) {
    const std::string name(describe_format(format).name);
    const std::optional<Dimensions> found = parse(format, bytes);
    if (!found) {
        return Error{ErrorCode::kUndecodable,
                     "the header of this " + name + " is cut off or damaged (" +
                         std::to_string(bytes.size()) + " bytes)"};
    }
    if (found->width < 1 || found->height < 1) {
        return Error{ErrorCode::kUndecodable,
                     "the header of this " + name + " says " +
                         std::to_string(found->width) + " x " +
                         std::to_string(found->height) + " pixels"};
    }
    return *found;
}

Result<void> check_pixels(const Dimensions& dimensions, std::int64_t max_pixels) {
    // Both sides are below 2^31, so the product fits.
    const std::int64_t pixels = dimensions.width * dimensions.height;
    if (pixels <= max_pixels) return {};
    return Error{ErrorCode::kTooLarge,
                 "the picture has " + std::to_string(pixels) + " pixels (" +
                     std::to_string(dimensions.width) + " x " +
                     std::to_string(dimensions.height) + "), the limit is " +
                     std::to_string(max_pixels)};
}

}  // namespace haarmony::ingest
