#include "ingest/sniff.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <string>

#include "ingest/byte_reader.h"

namespace haarmony::ingest {
namespace {

using std::string_view_literals::operator""sv;

constexpr std::array kFormats = {
    FormatDescription{Format::kJpeg, "JPEG", "image/jpeg", "jpg jpeg jpe jfif"},
    FormatDescription{Format::kPng, "PNG", "image/png", "png apng"},
    FormatDescription{Format::kGif, "GIF", "image/gif", "gif"},
    FormatDescription{Format::kWebp, "WebP", "image/webp", "webp"},
    FormatDescription{Format::kTiff, "TIFF", "image/tiff", "tif tiff"},
    FormatDescription{Format::kHeif, "HEIF", "image/heic", "heic heif hif"},
    FormatDescription{Format::kAvif, "AVIF", "image/avif", "avif"},
    FormatDescription{Format::kBmp, "BMP", "image/bmp", "bmp dib"},
    FormatDescription{Format::kJpeg2000, "JPEG 2000", "image/jp2", "jp2 j2k j2c jpc jpx"},
    FormatDescription{Format::kOpenExr, "OpenEXR", "image/x-exr", "exr"},
};

struct Magic {
    std::size_t offset;
    std::string_view bytes;
    FileType type;
};

constexpr FileType readable(Format format) {
    const FormatDescription& entry = kFormats[static_cast<std::size_t>(format)];
    return {entry.name, entry.media_type, format};
}

constexpr FileType refused(std::string_view name, std::string_view media_type) {
    return {name, media_type, std::nullopt};
}

// The first that fits wins, so the longer of two with a common beginning comes first.
constexpr std::array kMagics = {
    Magic{0, "\xff\xd8\xff"sv, readable(Format::kJpeg)},
    Magic{0, "\x89PNG\r\n\x1a\n"sv, readable(Format::kPng)},
    Magic{0, "GIF87a"sv, readable(Format::kGif)},
    Magic{0, "GIF89a"sv, readable(Format::kGif)},
    Magic{8, "CR\x02"sv, refused("Canon raw picture", "image/x-canon-cr2")},
    Magic{0, "II*\0"sv, readable(Format::kTiff)},
    Magic{0, "MM\0*"sv, readable(Format::kTiff)},
    Magic{0, "II+\0\x08\0"sv, readable(Format::kTiff)},
    Magic{0, "MM\0+\0\x08"sv, readable(Format::kTiff)},
    Magic{0, "\0\0\0\x0cjP  \r\n\x87\n"sv, readable(Format::kJpeg2000)},
    Magic{0, "\xff\x4f\xff\x51\0"sv, readable(Format::kJpeg2000)},
    Magic{0, "\x76\x2f\x31\x01"sv, readable(Format::kOpenExr)},
    Magic{0, "%PDF-"sv, refused("PDF document", "application/pdf")},
    Magic{0, "%!PS"sv, refused("PostScript document", "application/postscript")},
    Magic{0, "8BPS"sv, refused("Photoshop document", "image/vnd.adobe.photoshop")},
    Magic{0, "gimp xcf"sv, refused("GIMP picture", "image/x-xcf")},
    Magic{0, "#?RADIANCE"sv, refused("Radiance picture", "image/vnd.radiance")},
    Magic{0, "\xff\x0a"sv, refused("JPEG XL picture", "image/jxl")},
    Magic{0, "\0\0\0\x0cJXL \r\n\x87\n"sv, refused("JPEG XL picture", "image/jxl")},
    Magic{0, "AT&TFORM"sv, refused("DjVu document", "image/vnd.djvu")},
    Magic{0, "\0\0\x01\0"sv, refused("Windows icon", "image/vnd.microsoft.icon")},
    Magic{0, "PK\x03\x04"sv, refused("ZIP archive", "application/zip")},
    Magic{0, "\x1f\x8b"sv, refused("gzip file", "application/gzip")},
    Magic{0, "BZh"sv, refused("bzip2 file", "application/x-bzip2")},
    Magic{0,
          "\xfd"
          "7zXZ\0"sv,
          refused("xz file", "application/x-xz")},
    Magic{0, "\x28\xb5\x2f\xfd"sv, refused("Zstandard file", "application/zstd")},
    Magic{0,
          "7z\xbc\xaf\x27\x1c"sv,
          refused("7-Zip archive", "application/x-7z-compressed")},
    Magic{0, "Rar!\x1a\x07"sv, refused("RAR archive", "application/vnd.rar")},
    Magic{0, "\x1a\x45\xdf\xa3"sv, refused("Matroska video", "video/x-matroska")},
    Magic{0, "OggS"sv, refused("Ogg file", "application/ogg")},
    Magic{0, "fLaC"sv, refused("FLAC sound", "audio/flac")},
    Magic{0, "ID3"sv, refused("MP3 sound", "audio/mpeg")},
    Magic{0,
          "\x7f"
          "ELF"sv,
          refused("executable", "application/x-executable")},
    Magic{0,
          "SQLite format 3\0"sv,
          refused("SQLite database", "application/vnd.sqlite3")},
};

// Anything may call itself RIFF; the word eight bytes in says what it is.
std::optional<FileType> sniff_riff(const ByteReader& reader) {
    if (!reader.has(0, "RIFF")) return std::nullopt;
    if (reader.has(8, "WEBP")) return readable(Format::kWebp);
    if (reader.has(8, "AVI ")) return refused("AVI video", "video/x-msvideo");
    if (reader.has(8, "WAVE")) return refused("WAV sound", "audio/wav");
    return std::nullopt;
}

// ISO base media: HEIF, AVIF and MP4 share the container; the brands tell them apart. The
// major brand may be the neutral "mif1", so the compatible ones are read as well.
std::optional<FileType> sniff_brands(const ByteReader& reader) {
    if (!reader.has(4, "ftyp")) return std::nullopt;
    const std::uint64_t end =
        std::min<std::uint64_t>(reader.number(0, 4).value_or(0), reader.size());
    bool heif = false;
    for (std::uint64_t at = 8; at + 4 <= end; at += at == 8 ? 8 : 4) {
        if (reader.has(at, "avif") || reader.has(at, "avis"))
            return readable(Format::kAvif);
        for (const std::string_view brand :
             {"heic", "heix", "hevc", "hevx", "heim", "heis", "hevm", "hevs"}) {
            heif = heif || reader.has(at, brand);
        }
    }
    if (heif || reader.has(8, "mif1") || reader.has(8, "msf1")) {
        return readable(Format::kHeif);
    }
    if (reader.has(8, "qt  ")) return refused("QuickTime video", "video/quicktime");
    if (reader.has(8, "crx ")) return refused("Canon raw picture", "image/x-canon-cr3");
    return refused("MP4 video", "video/mp4");
}

// "BM" alone is the beginning of many words: the size of the second header must be one of
// those that exist.
std::optional<FileType> sniff_bmp(std::span<const std::uint8_t> bytes) {
    const ByteReader reader(bytes, ByteOrder::kLittle);
    if (!reader.has(0, "BM")) return std::nullopt;
    const std::uint64_t header = reader.u32(14).value_or(0);
    const std::array<std::uint64_t, 7> known = {12, 40, 52, 56, 64, 108, 124};
    if (std::find(known.begin(), known.end(), header) == known.end()) return std::nullopt;
    return readable(Format::kBmp);
}

// Text: no control characters but the white ones. Markup is recognised by its first tag.
std::optional<FileType> sniff_text(std::span<const std::uint8_t> bytes) {
    std::string text;
    for (const std::uint8_t byte : bytes.first(std::min(bytes.size(), kSniffBytes))) {
        if (byte == 0x7f || (byte < 0x20 && byte != '\t' && byte != '\n' &&
                             byte != '\r' && byte != '\f')) {
            return std::nullopt;
        }
        const bool upper = byte >= 'A' && byte <= 'Z';
        text.push_back(static_cast<char>(upper ? byte + ('a' - 'A') : byte));
    }
    if (text.empty()) return std::nullopt;
    if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
    const std::size_t begin = text.find_first_not_of(" \t\r\n\f");
    const std::string_view rest =
        std::string_view(text).substr(std::min(begin, text.size()));
    if (rest.starts_with("<!doctype html") || rest.starts_with("<html")) {
        return refused("HTML page", "text/html");
    }
    if (rest.starts_with("<") && rest.find("<svg") != std::string_view::npos) {
        return refused("SVG drawing", "image/svg+xml");
    }
    if (rest.starts_with("<") && rest.find("<html") != std::string_view::npos) {
        return refused("HTML page", "text/html");
    }
    if (rest.starts_with("<?xml")) return refused("XML document", "application/xml");
    // Latin-1 and UTF-8 letters lie above 0x7f, and so do half of all random bytes: a text
    // is believed when at most a third of it lies there.
    const auto high = std::count_if(text.begin(), text.end(), [](char c) {
        return static_cast<std::uint8_t>(c) >= 0x80;
    });
    if (high * 3 > static_cast<std::ptrdiff_t>(text.size())) return std::nullopt;
    return refused("text", "text/plain");
}

}  // namespace

std::span<const FormatDescription> formats() { return kFormats; }

const FormatDescription& describe_format(Format format) {
    const std::size_t index = static_cast<std::size_t>(format);
    assert(index < kFormats.size() && kFormats[index].format == format);
    return kFormats[index];
}

std::optional<FileType> sniff(std::span<const std::uint8_t> bytes) {
    const ByteReader reader(bytes, ByteOrder::kBig);
    for (const Magic& magic : kMagics) {
        if (reader.has(magic.offset, magic.bytes)) return magic.type;
    }
    if (const auto riff = sniff_riff(reader)) return riff;
    if (const auto brands = sniff_brands(reader)) return brands;
    if (const auto bmp = sniff_bmp(bytes)) return bmp;
    return sniff_text(bytes);
}

bool has_picture_extension(std::string_view file_name) {
    const std::size_t dot = file_name.rfind('.');
    if (dot == std::string_view::npos || dot + 1 == file_name.size()) return false;
    std::string extension;
    for (const char c : file_name.substr(dot + 1)) {
        if (c == ' ') return false;
        extension.push_back(c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A'))
                                                 : c);
    }
    const std::string word = " " + extension + " ";
    return std::any_of(
        kFormats.begin(), kFormats.end(), [&](const FormatDescription& entry) {
            return (" " + std::string(entry.extensions) + " ").find(word) !=
                   std::string::npos;
        });
}

}  // namespace haarmony::ingest
