// PNG files of straight RGBA, and their parts.
//   [png_chunks.h] -> animated_png.h, png_zip.h
//
// Errors  kTooLarge with libpng's words.
// Threads const-safe.
// Source  PNG specification, 3rd edition, 5.3.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "engine/core/image_view.h"
#include "engine/core/result.h"

namespace haarmony::ingest {

using Bytes = std::vector<std::uint8_t>;

inline constexpr std::string_view kPngSignature{"\x89PNG\r\n\x1a\n", 8};

// The picture as a PNG file. All files have the same colour type, as the frames of an
// animation must. Requires: 4 channels.
[[nodiscard]] Result<Bytes> png_file(const ImageView& picture);

// The content of the file's chunks of that type, one after the other.
[[nodiscard]] Bytes chunk_content(std::span<const std::uint8_t> file,
                                  std::string_view type);

void append_u16(Bytes& bytes, std::uint32_t number);  // big-endian
void append_u32(Bytes& bytes, std::uint32_t number);
void append_chunk(Bytes& bytes,
                  std::string_view type,
                  std::span<const std::uint8_t> content);

}  // namespace haarmony::ingest
