#include "ingest/animated_png.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include "engine/video/picture.h"
#include "ingest/png_chunks.h"

namespace haarmony::ingest {
namespace {

// Chunks, and the numbers in them, hold 31 bits.
constexpr std::int64_t kMaxNumber = 0x7FFF'FFFF;

video::PixelBox difference(const video::Picture& before, const ImageView& now) {
    std::int32_t left = now.width;
    std::int32_t right = 0;
    std::int32_t top = now.height;
    std::int32_t bottom = 0;
    const std::size_t row_bytes = std::size_t{4} * static_cast<std::size_t>(now.width);
    for (std::int32_t y = 0; y < now.height; ++y) {
        const std::uint8_t* new_row = now.row(y);
        if (std::memcmp(&before.at(0, y), new_row, row_bytes) == 0) continue;
        top = std::min(top, y);
        bottom = y + 1;
        for (std::int32_t x = 0; x < now.width; ++x) {
            if (std::memcmp(&before.at(x, y), new_row + std::ptrdiff_t{4} * x, 4) == 0) {
                continue;
            }
            left = std::min(left, x);
            right = std::max(right, x + 1);
        }
    }
    if (right == 0) return {0, 0, 1, 1};
    return {left, top, right - left, bottom - top};
}

ImageView part_of(const ImageView& picture, const video::PixelBox& box) {
    return {picture.row(box.y) + std::ptrdiff_t{4} * box.x,
            box.width,
            box.height,
            4,
            picture.row_stride};
}

class AnimatedPng : public VideoSink {
  public:
    AnimatedPng(const VideoSinkOptions& options, FilmOutput output)
        : options_(options), output_(std::move(output)) {
        // Longer numbers than the file has lose their last bits.
        delay_ = options_.format.rate;
        while (std::max(delay_.numerator, delay_.denominator) > 0xFFFF) {
            delay_.numerator = std::max(delay_.numerator / 2, 1);
            delay_.denominator = std::max(delay_.denominator / 2, 1);
        }
    }

    [[nodiscard]] Result<void> add(const ImageView& picture) override;
    [[nodiscard]] Result<void> finish() override {
        Bytes end;
        append_chunk(end, "IEND", {});
        return output_(end);
    }

  private:
    void begin(const Bytes& first_file, Bytes& bytes) const;
    void append_control(const video::PixelBox& box, Bytes& bytes);
    void remember(const ImageView& picture);

    VideoSinkOptions options_;
    FilmOutput output_;
    video::FrameRate delay_;
    video::Picture before_;
    std::int64_t frames_ = 0;
    std::uint32_t sequence_ = 0;
};

void AnimatedPng::begin(const Bytes& first_file, Bytes& bytes) const {
    bytes.assign(kPngSignature.begin(), kPngSignature.end());
    append_chunk(bytes, "IHDR", chunk_content(first_file, "IHDR"));
    append_chunk(bytes, "sRGB", chunk_content(first_file, "sRGB"));
    Bytes control;
    append_u32(control, static_cast<std::uint32_t>(options_.frames));
    append_u32(control, 0);  // plays: for ever
    append_chunk(bytes, "acTL", control);
}

void AnimatedPng::append_control(const video::PixelBox& box, Bytes& bytes) {
    Bytes control;
    append_u32(control, sequence_++);
    append_u32(control, static_cast<std::uint32_t>(box.width));
    append_u32(control, static_cast<std::uint32_t>(box.height));
    append_u32(control, static_cast<std::uint32_t>(box.x));
    append_u32(control, static_cast<std::uint32_t>(box.y));
    append_u16(control, static_cast<std::uint32_t>(delay_.denominator));
    append_u16(control, static_cast<std::uint32_t>(delay_.numerator));
    append_u16(control, 0);  // leave it as it is; replace what is there
    append_chunk(bytes, "fcTL", control);
}

void AnimatedPng::remember(const ImageView& picture) {
    if (frames_ == 0) before_ = video::Picture(picture.width, picture.height);
    const std::size_t row_bytes =
        std::size_t{4} * static_cast<std::size_t>(picture.width);
    for (std::int32_t y = 0; y < picture.height; ++y) {
        std::memcpy(&before_.at(0, y), picture.row(y), row_bytes);
    }
}

Result<void> AnimatedPng::add(const ImageView& picture) {
    const bool first = frames_ == 0;
    const video::PixelBox box = first
                                    ? video::PixelBox{0, 0, picture.width, picture.height}
                                    : difference(before_, picture);
    const Result<Bytes> file = png_file(part_of(picture, box));
    if (!file) return file.error();
    Bytes bytes;
    if (first) begin(*file, bytes);
    append_control(box, bytes);
    const Bytes pixels = chunk_content(*file, "IDAT");
    if (static_cast<std::int64_t>(pixels.size()) > kMaxNumber - 4 ||
        sequence_ >= kMaxNumber) {
        return Error{ErrorCode::kTooLarge,
                     "frame " + std::to_string(frames_) +
                         " of an APNG has more bytes or parts than 31 bits can count"};
    }
    if (first) {
        append_chunk(bytes, "IDAT", pixels);
    } else {
        Bytes numbered;
        numbered.reserve(4 + pixels.size());
        append_u32(numbered, sequence_++);
        numbered.insert(numbered.end(), pixels.begin(), pixels.end());
        append_chunk(bytes, "fdAT", numbered);
    }
    remember(picture);
    ++frames_;
    return output_(bytes);
}

}  // namespace

Result<std::unique_ptr<VideoSink>> open_animated_png(const VideoSinkOptions& options,
                                                     FilmOutput output) {
    // Two numbered parts a frame.
    if (options.frames > kMaxNumber / 2) {
        return Error{ErrorCode::kTooLarge,
                     "an APNG has at most " + std::to_string(kMaxNumber / 2) +
                         " frames, not " + std::to_string(options.frames),
                     "frames"};
    }
    return std::unique_ptr<VideoSink>(
        std::make_unique<AnimatedPng>(options, std::move(output)));
}

}  // namespace haarmony::ingest
