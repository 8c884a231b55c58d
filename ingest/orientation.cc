#include "ingest/orientation.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <optional>
#include <utility>

#include "ingest/byte_reader.h"
#include "ingest/tiff_directory.h"

namespace haarmony::ingest {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::string_view kExifName("Exif\0\0", 6);

std::optional<std::uint64_t> in_exif(Bytes block) {
    const ByteReader reader(block, ByteOrder::kBig);
    if (reader.has(0, kExifName)) block = block.subspan(kExifName.size());
    return first_directory_value(block, TiffTag::kOrientation);
}

// Segments up to the first scan; the first EXIF block counts.
std::optional<std::uint64_t> in_jpeg(Bytes bytes) {
    const ByteReader reader(bytes, ByteOrder::kBig);
    std::uint64_t at = 2;
    while (reader.u8(at) == 0xff) {
        const std::uint64_t marker = reader.u8(at + 1).value_or(0);
        if (marker == 0xff) {  // a fill byte
            ++at;
            continue;
        }
        const std::uint64_t length = reader.u16(at + 2).value_or(0);
        if (marker == 0xda || marker == 0xd9 || length < 2) return std::nullopt;
        if (marker == 0xe1 && reader.has(at + 4, kExifName)) {
            return in_exif(reader.slice(at + 4, length - 2));
        }
        at += 2 + length;
    }
    return std::nullopt;
}

std::optional<std::uint64_t> in_png(Bytes bytes) {
    const ByteReader reader(bytes, ByteOrder::kBig);
    std::uint64_t at = 8;
    while (const auto length = reader.u32(at)) {
        if (reader.has(at + 4, "eXIf")) return in_exif(reader.slice(at + 8, *length));
        at += 12 + *length;
    }
    return std::nullopt;
}

std::optional<std::uint64_t> in_webp(Bytes bytes) {
    const ByteReader reader(bytes, ByteOrder::kLittle);
    std::uint64_t at = 12;
    while (const auto length = reader.u32(at + 4)) {
        if (reader.has(at, "EXIF")) return in_exif(reader.slice(at + 8, *length));
        at += 8 + *length + (*length & 1);
    }
    return std::nullopt;
}

// Copies pixel (x, y) of `from` to the place that `place` names in `to`.
template <typename Place>
void move_pixels(const Raster& from, Raster& to, const Place& place) {
    const std::size_t depth = static_cast<std::size_t>(from.channels);
    for (int y = 0; y < from.height; ++y) {
        const std::uint8_t* source = from.row(y);
        for (int x = 0; x < from.width; ++x, source += depth) {
            const std::pair<int, int> target = place(x, y);
            std::memcpy(to.row(target.second) + target.first * depth, source, depth);
        }
    }
}

}  // namespace

int exif_orientation(Format format, Bytes bytes) {
    std::optional<std::uint64_t> value;
    switch (format) {
        case Format::kJpeg:
            value = in_jpeg(bytes);
            break;
        case Format::kPng:
            value = in_png(bytes);
            break;
        case Format::kWebp:
            value = in_webp(bytes);
            break;
        case Format::kTiff:
            value = first_directory_value(bytes, TiffTag::kOrientation);
            break;
        case Format::kGif:
        case Format::kHeif:
        case Format::kAvif:
        case Format::kBmp:
        case Format::kJpeg2000:
        case Format::kOpenExr:
            break;
    }
    return value && *value >= 1 && *value <= 8 ? static_cast<int>(*value) : 1;
}

Raster upright(Raster raster, int orientation) {
    assert(orientation >= 1 && orientation <= 8);
    if (orientation == 1) return raster;
    const bool swaps = orientation >= 5;
    Raster turned(swaps ? raster.height : raster.width,
                  swaps ? raster.width : raster.height,
                  raster.channels);
    const int right = turned.width - 1;
    const int bottom = turned.height - 1;
    // The tag names where the stored row 0 and column 0 belong: 2 top right, 3 bottom
    // right, 4 bottom left; 5 to 8 the same with rows and columns exchanged.
    switch (orientation) {
        case 2:
            move_pixels(
                raster, turned, [=](int x, int y) { return std::pair(right - x, y); });
            break;
        case 3:
            move_pixels(raster, turned, [=](int x, int y) {
                return std::pair(right - x, bottom - y);
            });
            break;
        case 4:
            move_pixels(
                raster, turned, [=](int x, int y) { return std::pair(x, bottom - y); });
            break;
        case 5:
            move_pixels(raster, turned, [](int x, int y) { return std::pair(y, x); });
            break;
        case 6:
            move_pixels(
                raster, turned, [=](int x, int y) { return std::pair(right - y, x); });
            break;
        case 7:
            move_pixels(raster, turned, [=](int x, int y) {
                return std::pair(right - y, bottom - x);
            });
            break;
        default:
            move_pixels(
                raster, turned, [=](int x, int y) { return std::pair(y, bottom - x); });
            break;
    }
    return turned;
}

}  // namespace haarmony::ingest
