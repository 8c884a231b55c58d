// Addresses of frames of films: the film's own address and a media fragment, which players
// jump to.
//
// Shape   "file:///films/a%20b.mp4#t=12.480": seconds with three decimals. An address from
//         file_uri() has no '#' of its own.
// Units   microseconds, rounded to milliseconds.
// Threads pure functions.
// Source  W3C Media Fragments URI 1.0, section 4.2.1.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace haarmony::ingest {

// Requires: `film` is an address of file_uri(); time_us >= 0.
[[nodiscard]] std::string key_frame_uri(std::string_view film, std::int64_t time_us);

// What the addresses of a film's key frames begin with, and no other address.
[[nodiscard]] std::string key_frame_prefix(std::string_view film);

[[nodiscard]] bool is_key_frame_uri(std::string_view uri);

// The address of the file alone.
[[nodiscard]] std::string_view without_fragment(std::string_view uri);

}  // namespace haarmony::ingest
