// Width and height out of a picture's header, before any decoder sees the bytes
// (ingest, second guard of step 2): sniff -> [dimensions] -> jpeg or oiio.
//
// A picture of 60,000 x 60,000 pixels fits in a few bytes and would take the memory of the
// whole machine to decode; the readers behind us open it without a question.
//
// Shape   as stored: EXIF orientation is not applied. HEIF and AVIF hold several pictures;
//         the largest counts.
// Units   pixels.
// Errors  kUndecodable: the header is cut off, damaged, or says 0; kTooLarge: names the
//         pixels and the limit.
// Threads const-safe.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "engine/core/result.h"
#include "ingest/sniff.h"

namespace haarmony::ingest {

struct Dimensions {
    std::int64_t width = 0;
    std::int64_t height = 0;

    friend bool operator==(const Dimensions&, const Dimensions&) = default;
};

// Requires: `bytes` were sniffed as `format`. Neither side exceeds 2^31 - 1.
[[nodiscard]] Result<Dimensions> read_dimensions(Format format,
                                                 std::span<const std::uint8_t> bytes);

// kTooLarge above `max_pixels`.
[[nodiscard]] Result<void> check_pixels(const Dimensions& dimensions,
                                        std::int64_t max_pixels);

// Parsers of one container each; no answer where the header is damaged.
[[nodiscard]] std::optional<Dimensions> jpeg_dimensions(
    std::span<const std::uint8_t> bytes);
[[nodiscard]] std::optional<Dimensions> webp_dimensions(
    std::span<const std::uint8_t> bytes);
[[nodiscard]] std::optional<Dimensions> heif_dimensions(
    std::span<const std::uint8_t> bytes);
[[nodiscard]] std::optional<Dimensions> jpeg2000_dimensions(
    std::span<const std::uint8_t> bytes);
[[nodiscard]] std::optional<Dimensions> openexr_dimensions(
    std::span<const std::uint8_t> bytes);

}  // namespace haarmony::ingest
