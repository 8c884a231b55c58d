// What kind of clip some bytes are, by their beginning alone (video, first guard of step 1).
//
// Shape   the first kSniffBytes (sniff.h) decide; fewer are welcome.
// Errors  none: bytes of no kind that is read here have no format.
// Threads const-safe.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace haarmony::ingest {

// The allow-list: what a reader of clips is ever shown. Stills are clips of one frame.
enum class VideoFormat : std::uint32_t {
    kMp4,  // and QuickTime
    kMatroska,
    kAvi,
    kMpegProgram,
    kMpegTransport,
    kMpegVideo,
    kOgg,
    kFlash,
    kYuv4Mpeg,
    kGif,
    kPng,
    kWebp,
};
inline constexpr std::uint32_t kVideoFormats = 12;

[[nodiscard]] std::string_view name_of(VideoFormat format);        // "MP4 video"
[[nodiscard]] std::string_view media_type_of(VideoFormat format);  // "video/mp4"
// Whether it is moving pictures alone, and not what pictures are stored in as well.
[[nodiscard]] bool is_film(VideoFormat format);
[[nodiscard]] std::optional<VideoFormat> sniff_video(std::span<const std::uint8_t> bytes);

// Whether the name ends in an extension of films, and of films alone, in any case.
[[nodiscard]] bool has_film_extension(std::string_view file_name);
// The same of sound in the containers of films.
[[nodiscard]] bool has_sound_extension(std::string_view file_name);

}  // namespace haarmony::ingest
