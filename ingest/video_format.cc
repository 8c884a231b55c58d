#include "ingest/video_format.h"

#include <array>
#include <cassert>
#include <cstddef>
#include <string>

#include "ingest/byte_reader.h"
#include "ingest/sniff.h"

namespace haarmony::ingest {
namespace {

using std::string_view_literals::operator""sv;

struct Description {
    std::string_view name;
    std::string_view media_type;
    bool film;
};

constexpr std::array<Description, kVideoFormats> kDescriptions = {{
    {"MP4 video", "video/mp4", true},
    {"Matroska video", "video/x-matroska", true},
    {"AVI video", "video/x-msvideo", true},
    {"MPEG program stream", "video/mpeg", true},
    {"MPEG transport stream", "video/mp2t", true},
    {"MPEG video", "video/mpeg", true},
    {"Ogg video", "video/ogg", true},
    {"Flash video", "video/x-flv", true},
    {"YUV4MPEG2 video", "video/x-yuv4mpeg", true},
    {"GIF", "image/gif", false},
    {"PNG", "image/png", false},
    {"WebP", "image/webp", false},
}};

// "ts" and "mts" are source text more often: these are known by their bytes alone.
constexpr std::string_view kFilmExtensions =
    " 3gp avi flv m2ts m4v mkv mov mp4 mpeg mpg ogv qt webm y4m ";
constexpr std::string_view kSoundExtensions = " m4a m4b mka oga ogg opus spx weba ";

const Description& description_of(VideoFormat format) {
    const auto index = static_cast<std::size_t>(format);
    assert(index < kDescriptions.size());
    return kDescriptions[index];
}

bool has_extension(std::string_view file_name, std::string_view extensions) {
    const std::size_t dot = file_name.rfind('.');
    if (dot == std::string_view::npos || dot + 1 == file_name.size()) return false;
    std::string word = " ";
    for (const char c : file_name.substr(dot + 1)) {
        if (c == ' ') return false;
        word.push_back(c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c);
    }
    word += ' ';
    return extensions.find(word) != std::string_view::npos;
}

struct Magic {
    std::size_t offset;
    std::string_view bytes;
    VideoFormat format;
};

constexpr std::array kMagics = {
    Magic{0, "\x1a\x45\xdf\xa3"sv, VideoFormat::kMatroska},
    Magic{0, "\0\0\x01\xba"sv, VideoFormat::kMpegProgram},
    Magic{0, "\0\0\x01\xb3"sv, VideoFormat::kMpegVideo},
    Magic{0, "OggS"sv, VideoFormat::kOgg},
    Magic{0, "FLV\x01"sv, VideoFormat::kFlash},
    Magic{0, "YUV4MPEG2 "sv, VideoFormat::kYuv4Mpeg},
    Magic{0, "GIF87a"sv, VideoFormat::kGif},
    Magic{0, "GIF89a"sv, VideoFormat::kGif},
    Magic{0, "\x89PNG\r\n\x1a\n"sv, VideoFormat::kPng},
    // QuickTime from before there were brands begins with any of its boxes.
    Magic{4, "moov"sv, VideoFormat::kMp4},
    Magic{4, "mdat"sv, VideoFormat::kMp4},
    Magic{4, "wide"sv, VideoFormat::kMp4},
};

// A packet is 188 bytes and begins with 0x47.
bool is_transport_stream(const ByteReader& reader) {
    return reader.has(0, "\x47") && reader.has(188, "\x47") && reader.has(376, "\x47");
}

}  // namespace

std::string_view name_of(VideoFormat format) { return description_of(format).name; }

std::string_view media_type_of(VideoFormat format) {
    return description_of(format).media_type;
}

bool is_film(VideoFormat format) { return description_of(format).film; }

bool has_film_extension(std::string_view file_name) {
    return has_extension(file_name, kFilmExtensions);
}

bool has_sound_extension(std::string_view file_name) {
    return has_extension(file_name, kSoundExtensions);
}

std::optional<VideoFormat> sniff_video(std::span<const std::uint8_t> bytes) {
    const ByteReader reader(bytes, ByteOrder::kBig);
    for (const Magic& magic : kMagics) {
        if (reader.has(magic.offset, magic.bytes)) return magic.format;
    }
    if (reader.has(0, "RIFF") && reader.has(8, "AVI ")) return VideoFormat::kAvi;
    if (reader.has(0, "RIFF") && reader.has(8, "WEBP")) return VideoFormat::kWebp;
    if (is_transport_stream(reader)) return VideoFormat::kMpegTransport;
    if (!reader.has(4, "ftyp")) return std::nullopt;
    // The same container holds pictures: sniff() tells them apart by their brands.
    const std::optional<FileType> type = sniff(bytes);
    const bool film = type && (type->media_type == "video/mp4" ||
                               type->media_type == "video/quicktime");
    return film ? std::optional(VideoFormat::kMp4) : std::nullopt;
}

}  // namespace haarmony::ingest
