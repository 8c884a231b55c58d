// GIF files written by hand, so that a test decides on delays, transparency and disposal.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/video/picture.h"

namespace haarmony::ingest::testing {

enum class Disposal : std::uint8_t { kLeave = 1, kClear = 2, kRestore = 3 };

// A rectangle of palette indices (below 128); index 0 is transparent.
struct GifFrame {
    video::PixelBox box;
    std::vector<std::uint8_t> indices;
    int delay_cs = 10;
    Disposal disposal = Disposal::kLeave;
};

struct Gif {
    std::int32_t width = 0;
    std::int32_t height = 0;
    std::vector<GifFrame> frames;
};

// Colour i of the palette.
[[nodiscard]] video::Rgba gif_color(std::uint8_t index);
[[nodiscard]] std::vector<std::uint8_t> write_gif(const Gif& gif);
// The canvas after each frame was drawn, by the definition (GIF89a, section 23).
[[nodiscard]] std::vector<video::Picture> draw_gif(const Gif& gif);

}  // namespace haarmony::ingest::testing
