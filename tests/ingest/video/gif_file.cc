#include "tests/ingest/video/gif_file.h"

#include <algorithm>
#include <string_view>

namespace haarmony::ingest::testing {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr int kColors = 128;
constexpr std::uint8_t kCodeBits =
    7;  // codes of 8 bits: a byte each, until a table grows
constexpr std::uint8_t kClearCode = 128;
constexpr std::uint8_t kEndCode = 129;
constexpr std::size_t kCodesBetweenClears = 100;  // 126 more and codes would have 9 bits

void u16(Bytes& bytes, int number) {
    bytes.push_back(static_cast<std::uint8_t>(number));
    bytes.push_back(static_cast<std::uint8_t>(number >> 8));
}

void append_image(Bytes& file, const GifFrame& frame) {
    // The graphic control extension: disposal, transparent index 0.
    file.insert(file.end(), {0x21, 0xf9, 4});
    file.push_back(
        static_cast<std::uint8_t>(static_cast<std::uint8_t>(frame.disposal) << 2 | 1));
    u16(file, frame.delay_cs);
    file.insert(file.end(), {0, 0});
    file.push_back(0x2c);
    for (const int number :
         {frame.box.x, frame.box.y, frame.box.width, frame.box.height}) {
        u16(file, number);
    }
    file.push_back(0);
    file.push_back(kCodeBits);
    for (std::size_t at = 0; at < frame.indices.size(); at += kCodesBetweenClears) {
        const std::size_t count =
            std::min(kCodesBetweenClears, frame.indices.size() - at);
        file.push_back(static_cast<std::uint8_t>(1 + count));
        file.push_back(kClearCode);
        const auto begin = frame.indices.begin() + static_cast<std::ptrdiff_t>(at);
        file.insert(file.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
    }
    file.insert(file.end(), {1, kEndCode, 0});
}

}  // namespace

video::Rgba gif_color(std::uint8_t index) {
    return {static_cast<std::uint8_t>(2 * index),
            static_cast<std::uint8_t>(255 - index),
            static_cast<std::uint8_t>(index * 37),
            255};
}

Bytes write_gif(const Gif& gif) {
    constexpr std::string_view kSignature = "GIF89a";
    Bytes file(kSignature.begin(), kSignature.end());
    u16(file, gif.width);
    u16(file, gif.height);
    file.insert(file.end(), {0xf6, 0, 0});  // 128 colours for all frames
    for (int i = 0; i < kColors; ++i) {
        const video::Rgba color = gif_color(static_cast<std::uint8_t>(i));
        file.insert(file.end(), {color.r, color.g, color.b});
    }
    for (const GifFrame& frame : gif.frames) append_image(file, frame);
    file.push_back(0x3b);
    return file;
}

std::vector<video::Picture> draw_gif(const Gif& gif) {
    std::vector<video::Picture> shown;
    video::Picture canvas(gif.width, gif.height);
    for (const GifFrame& frame : gif.frames) {
        const video::Picture before = canvas;
        const video::PixelBox& box = frame.box;
        for (int i = 0; i < box.width * box.height; ++i) {
            const std::uint8_t index = frame.indices[static_cast<std::size_t>(i)];
            if (index == 0) continue;
            canvas.at(box.x + i % box.width, box.y + i / box.width) = gif_color(index);
        }
        shown.push_back(canvas);
        if (frame.disposal == Disposal::kRestore) canvas = before;
        if (frame.disposal == Disposal::kClear) {
            for (int i = 0; i < box.width * box.height; ++i) {
                canvas.at(box.x + i % box.width, box.y + i / box.width) = video::kClear;
            }
        }
    }
    return shown;
}

}  // namespace haarmony::ingest::testing
