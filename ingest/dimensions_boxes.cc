// Dimensions of the formats whose header is a tree of boxes or a list of attributes:
// HEIF and AVIF (ISO 23008-12), JPEG 2000 (ISO 15444-1), OpenEXR.
#include <algorithm>
#include <cstring>
#include <string_view>

#include "ingest/byte_reader.h"
#include "ingest/dimensions.h"

namespace haarmony::ingest {
namespace {

using Bytes = std::span<const std::uint8_t>;

struct Box {
    std::string_view type;
    Bytes content;
    std::uint64_t next = 0;  // offset behind the box
};

std::optional<Box> read_box(const ByteReader& reader, std::uint64_t at) {
    std::uint64_t header = 8;
    const auto short_size = reader.u32(at);
    const Bytes type = reader.slice(at + 4, 4);
    if (!short_size || type.size() < 4) return std::nullopt;
    std::uint64_t size = *short_size;
    if (size == 0) size = reader.size() - at;  // to the end of the file
    if (size == 1) {
        header = 16;
        size = reader.u64(at + 8).value_or(0);
    }
    if (size < header || size > reader.size() - at) return std::nullopt;
    return Box{{reinterpret_cast<const char*>(type.data()), 4},
               reader.slice(at + header, size - header),
               at + size};
}

// The content of the first box of that type at this level.
std::optional<Bytes> find_box(Bytes level, std::string_view type) {
    const ByteReader reader(level, ByteOrder::kBig);
    std::uint64_t at = 0;
    while (const auto box = read_box(reader, at)) {
        if (box->type == type) return box->content;
        at = box->next;
    }
    return std::nullopt;
}

std::optional<Dimensions> checked(std::optional<std::uint64_t> width,
                                  std::optional<std::uint64_t> height) {
    constexpr std::uint64_t kMax = 0x7fff'ffff;
    if (!width || !height || *width > kMax || *height > kMax) return std::nullopt;
    return Dimensions{static_cast<std::int64_t>(*width),
                      static_cast<std::int64_t>(*height)};
}

// SIZ: the reference grid and the offset of the picture in it.
std::optional<Dimensions> codestream_dimensions(const ByteReader& reader) {
    const auto right = reader.u32(8);
    const auto bottom = reader.u32(12);
    const auto left = reader.u32(16);
    const auto top = reader.u32(20);
    if (!right || !bottom || !left || !top || *left > *right || *top > *bottom) {
        return std::nullopt;
    }
    return checked(*right - *left, *bottom - *top);
}

}  // namespace

std::optional<Dimensions> heif_dimensions(Bytes bytes) {
    const auto meta = find_box(bytes, "meta");
    if (!meta || meta->size() < 4) return std::nullopt;
    const auto properties =
        find_box(meta->subspan(4), "iprp");  // version and flags first
    const auto container = properties ? find_box(*properties, "ipco") : properties;
    if (!container) return std::nullopt;
    // Tiles and thumbnails have extents of their own; the picture is the largest.
    std::optional<Dimensions> largest;
    const ByteReader reader(*container, ByteOrder::kBig);
    std::uint64_t at = 0;
    while (const auto box = read_box(reader, at)) {
        at = box->next;
        if (box->type != "ispe") continue;
        const ByteReader extent(box->content, ByteOrder::kBig);
        const auto found = checked(extent.u32(4), extent.u32(8));
        if (!found) return std::nullopt;
        if (!largest || found->width * found->height > largest->width * largest->height) {
            largest = found;
        }
    }
    return largest;
}

std::optional<Dimensions> jpeg2000_dimensions(Bytes bytes) {
    const ByteReader whole(bytes, ByteOrder::kBig);
    if (whole.has(0, "\xff\x4f\xff\x51")) return codestream_dimensions(whole);
    // The decoder believes the codestream, the box header may say otherwise: the larger
    // of the two is what must fit.
    const auto header = find_box(bytes, "jp2h");
    const auto image_header = header ? find_box(*header, "ihdr") : header;
    const auto codestream = find_box(bytes, "jp2c");
    if (!image_header || !codestream) return std::nullopt;
    const ByteReader fields(*image_header, ByteOrder::kBig);
    const auto said = checked(fields.u32(4), fields.u32(0));
    const ByteReader stream(*codestream, ByteOrder::kBig);
    if (!said || !stream.has(0, "\xff\x4f\xff\x51")) return std::nullopt;
    const auto coded = codestream_dimensions(stream);
    if (!coded) return std::nullopt;
    return Dimensions{std::max(said->width, coded->width),
                      std::max(said->height, coded->height)};
}

std::optional<Dimensions> openexr_dimensions(Bytes bytes) {
    const ByteReader reader(bytes, ByteOrder::kLittle);
    // Attributes: name, 0, type, 0, size, value; an empty name ends the header.
    const auto word_end = [&](std::uint64_t from) -> std::optional<std::uint64_t> {
        const Bytes rest = reader.slice(from, 256);
        const auto zero = std::find(rest.begin(), rest.end(), std::uint8_t{0});
        if (zero == rest.end()) return std::nullopt;
        return from + static_cast<std::uint64_t>(zero - rest.begin());
    };
    std::uint64_t at = 8;
    while (true) {
        const auto name_end = word_end(at);
        if (!name_end || *name_end == at) return std::nullopt;
        const auto type_end = word_end(*name_end + 1);
        if (!type_end) return std::nullopt;
        const std::uint64_t value = *type_end + 5;
        const auto size = reader.u32(*type_end + 1);
        if (!size) return std::nullopt;
        if (reader.has(at, std::string_view("dataWindow\0box2i\0", 17))) {
            const auto corner = [&](int i) -> std::optional<std::int64_t> {
                const auto raw = reader.u32(value + 4 * static_cast<std::uint64_t>(i));
                if (!raw) return std::nullopt;
                return static_cast<std::int32_t>(static_cast<std::uint32_t>(*raw));
            };
            const auto left = corner(0), top = corner(1), right = corner(2),
                       bottom = corner(3);
            if (!left || !top || !right || !bottom) return std::nullopt;
            if (*right < *left || *bottom < *top) return std::nullopt;
            return checked(static_cast<std::uint64_t>(*right - *left + 1),
                           static_cast<std::uint64_t>(*bottom - *top + 1));
        }
        at = value + *size;
    }
}

}  // namespace haarmony::ingest
