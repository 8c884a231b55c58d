#include "ingest/png_chunks.h"

#include <png.h>
#include <zlib.h>

#include <cassert>
#include <cstddef>
#include <string>

#include "ingest/byte_reader.h"
#include "ingest/one_line.h"

namespace haarmony::ingest {

Result<Bytes> png_file(const ImageView& picture) {
    assert(picture.channels == 4);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(picture.width);
    image.height = static_cast<png_uint_32>(picture.height);
    image.format = PNG_FORMAT_RGBA;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    Bytes file(size);
    const auto stride = static_cast<png_int_32>(picture.row_stride);
    if (png_image_write_to_memory(
            &image, file.data(), &size, 0, picture.pixels, stride, nullptr) == 0) {
        return Error{ErrorCode::kTooLarge,
                     "a PNG of " + std::to_string(picture.width) + " x " +
                         std::to_string(picture.height) +
                         " pixels: " + one_line(image.message)};
    }
    file.resize(size);
    return file;
}

Bytes chunk_content(std::span<const std::uint8_t> file, std::string_view type) {
    const ByteReader reader(file, ByteOrder::kBig);
    Bytes content;
    std::uint64_t at = kPngSignature.size();
    while (const auto length = reader.u32(at)) {
        if (reader.has(at + 4, type)) {
            const auto part = reader.slice(at + 8, *length);
            content.insert(content.end(), part.begin(), part.end());
        }
        at += 12 + *length;
    }
    return content;
}

void append_u16(Bytes& bytes, std::uint32_t number) {
    bytes.push_back(static_cast<std::uint8_t>(number >> 8));
    bytes.push_back(static_cast<std::uint8_t>(number));
}

void append_u32(Bytes& bytes, std::uint32_t number) {
    append_u16(bytes, number >> 16);
    append_u16(bytes, number);
}

void append_chunk(Bytes& bytes,
                  std::string_view type,
                  std::span<const std::uint8_t> content) {
    append_u32(bytes, static_cast<std::uint32_t>(content.size()));
    const std::size_t begin = bytes.size();
    bytes.insert(bytes.end(), type.begin(), type.end());
    bytes.insert(bytes.end(), content.begin(), content.end());
    const std::size_t covered = bytes.size() - begin;
    append_u32(bytes,
               static_cast<std::uint32_t>(crc32_z(0, bytes.data() + begin, covered)));
}

}  // namespace haarmony::ingest
