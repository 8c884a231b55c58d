#include "ingest/video_format.h"

#include <array>
#include <cassert>
#include <cstddef>

#include "ingest/byte_reader.h"
#include "ingest/sniff.h"

namespace haarmony::ingest {
namespace {

using std::string_view_literals::operator""sv;

constexpr std::array<std::string_view, kVideoFormats> kNames = {
    "MP4 video",
    "Matroska video",
    "AVI video",
    "MPEG program stream",
    "MPEG transport stream",
    "MPEG video",
    "Ogg video",
    "Flash video",
    "YUV4MPEG2 video",
    "GIF",
    "PNG",
    "WebP",
};

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

std::string_view name_of(VideoFormat format) {
    const auto index = static_cast<std::size_t>(format);
    assert(index < kNames.size());
    return kNames[index];
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
