// The signature of what libvips' thumbnailer makes of a picture, where libvips is installed.
//
// Threads one thread calls; libvips is told to use one worker.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace haarmony::bench {

// False where the program was built without libvips.
[[nodiscard]] bool start_vips();

// vips_thumbnail_buffer to 128 x 128, whatever the shape, then make_signature(). Returns what
// went wrong, or nothing. Requires: start_vips() returned true.
[[nodiscard]] std::string sign_with_vips_thumbnail(std::span<const std::uint8_t> bytes);

}  // namespace haarmony::bench
