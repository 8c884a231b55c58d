#include "ingest/webp_animation.h"

#include <webp/demux.h>

#include <cstddef>
#include <cstring>
#include <numeric>
#include <string>
#include <utility>

namespace haarmony::ingest {
namespace {

constexpr video::FrameRate kUntimedRate = {10, 1};  // as browsers show untimed animations
constexpr std::int64_t kMicrosecondsPerMs = 1000;

struct FreeWebp {
    void operator()(WebPDemuxer* demuxer) const { WebPDemuxDelete(demuxer); }
    void operator()(WebPAnimDecoder* decoder) const { WebPAnimDecoderDelete(decoder); }
};

Error damaged(const std::string& why) {
    return {ErrorCode::kUndecodable, "damaged WebP: " + why};
}

class WebpAnimation : public PictureSource {
  public:
    [[nodiscard]] Result<void> open(std::span<const std::uint8_t> bytes,
                                    std::int64_t max_pixels);
    [[nodiscard]] const video::FrameFormat& format() const override { return format_; }
    [[nodiscard]] Result<bool> next(TimedPicture& shown) override;

  private:
    [[nodiscard]] video::FrameRate rate_of(WebPDemuxer& demuxer) const;

    std::unique_ptr<WebPAnimDecoder, FreeWebp> decoder_;
    video::FrameFormat format_;
    std::int64_t announced_ = 0;  // frames
    std::int64_t shown_ = 0;
    std::int64_t end_ms_ = 0;  // of the frame shown last
};

video::FrameRate WebpAnimation::rate_of(WebPDemuxer& demuxer) const {
    std::int64_t duration_ms = 0;
    WebPIterator frame{};
    for (int more = WebPDemuxGetFrame(&demuxer, 1, &frame); more != 0;
         more = WebPDemuxNextFrame(&frame)) {
        duration_ms += frame.duration;
    }
    WebPDemuxReleaseIterator(&frame);
    if (duration_ms == 0) return kUntimedRate;
    const std::int64_t milliseconds = announced_ * 1000;
    std::int64_t divisor = std::gcd(milliseconds, duration_ms);
    // Four days of one frame: more precise than any clock.
    while (milliseconds / divisor > INT32_MAX || duration_ms / divisor > INT32_MAX) {
        divisor *= 2;
    }
    return {static_cast<std::int32_t>(milliseconds / divisor),
            static_cast<std::int32_t>(duration_ms / divisor)};
}

Result<void> WebpAnimation::open(std::span<const std::uint8_t> bytes,
                                 std::int64_t max_pixels) {
    const WebPData file = {bytes.data(), bytes.size()};
    const std::unique_ptr<WebPDemuxer, FreeWebp> demuxer(WebPDemux(&file));
    if (!demuxer) return damaged("its chunks are cut off or contradict each other");
    const std::int64_t width = WebPDemuxGetI(demuxer.get(), WEBP_FF_CANVAS_WIDTH);
    const std::int64_t height = WebPDemuxGetI(demuxer.get(), WEBP_FF_CANVAS_HEIGHT);
    announced_ = WebPDemuxGetI(demuxer.get(), WEBP_FF_FRAME_COUNT);
    if (width > video::kMaxSide || height > video::kMaxSide ||
        width * height > max_pixels) {
        return Error{ErrorCode::kTooLarge,
                     "the WebP is " + std::to_string(width) + " x " +
                         std::to_string(height) + " pixels; the limit is " +
                         std::to_string(max_pixels)};
    }
    format_.width = static_cast<std::int32_t>(width);
    format_.height = static_cast<std::int32_t>(height);
    format_.rate = rate_of(*demuxer);

    WebPAnimDecoderOptions options;
    const bool known = WebPAnimDecoderOptionsInit(&options) != 0;
    options.color_mode = MODE_RGBA;
    options.use_threads = 0;
    if (known) decoder_.reset(WebPAnimDecoderNew(&file, &options));
    if (!decoder_ || announced_ < 1) return damaged("it has no frame that can be read");
    return {};
}

Result<bool> WebpAnimation::next(TimedPicture& shown) {
    if (shown_ == announced_) return false;
    std::uint8_t* canvas = nullptr;
    int end_ms = 0;
    if (WebPAnimDecoderGetNext(decoder_.get(), &canvas, &end_ms) == 0) {
        return damaged("frame " + std::to_string(shown_) + " of " +
                       std::to_string(announced_) + " is truncated or corrupt");
    }
    ++shown_;
    if (shown.picture.width != format_.width || shown.picture.height != format_.height) {
        shown.picture = video::Picture(format_.width, format_.height);
    }
    std::memcpy(shown.picture.pixels.data(),
                canvas,
                shown.picture.pixels.size() * sizeof(video::Rgba));
    for (video::Rgba& pixel : shown.picture.pixels) pixel = video::canonical(pixel);
    // A frame comes with the moment of its end.
    shown.time_us = std::exchange(end_ms_, end_ms) * kMicrosecondsPerMs;
    return true;
}

}  // namespace

Result<std::unique_ptr<PictureSource>> open_webp_animation(
    std::span<const std::uint8_t> bytes,
    std::int64_t max_pixels) {
    auto source = std::make_unique<WebpAnimation>();
    if (auto opened = source->open(bytes, max_pixels); !opened) return opened.error();
    return std::unique_ptr<PictureSource>(std::move(source));
}

}  // namespace haarmony::ingest
