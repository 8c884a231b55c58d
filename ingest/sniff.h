// What kind of file some bytes are, by their first bytes alone: a name proves nothing
// (ingest, first guard of step 2): [sniff] -> dimensions -> jpeg or oiio.
//
// Shape   the first kSniffBytes bytes decide; more are welcome, fewer too.
// Errors  none: bytes of no known kind have no FileType.
// Threads const-safe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace haarmony::ingest {

inline constexpr std::size_t kSniffBytes = 512;

// The allow-list: what a decoder is ever shown.
enum class Format : std::uint8_t {
    kJpeg,
    kPng,
    kGif,
    kWebp,
    kTiff,
    kHeif,
    kAvif,
    kBmp,
    kJpeg2000,
    kOpenExr,
};

struct FormatDescription {
    Format format;
    std::string_view name;        // "JPEG"
    std::string_view media_type;  // "image/jpeg"
    std::string_view extensions;  // lower case, separated by blanks: "jpg jpeg"
};

// Every format that can be read, in the order of the enumeration.
[[nodiscard]] std::span<const FormatDescription> formats();
[[nodiscard]] const FormatDescription& describe_format(Format format);

struct FileType {
    std::string_view name;         // "PDF document"
    std::string_view media_type;   // "application/pdf"
    std::optional<Format> format;  // empty: recognised, and not read here
};

[[nodiscard]] std::optional<FileType> sniff(std::span<const std::uint8_t> bytes);

// Whether the name ends in an extension of a format that can be read, in any case.
[[nodiscard]] bool has_picture_extension(std::string_view file_name);

}  // namespace haarmony::ingest
