#include "ingest/webp.h"

#include <webp/decode.h>
#include <webp/demux.h>

#include <memory>
#include <string>

namespace haarmony::ingest {
namespace {

struct Demuxer {
    explicit Demuxer(std::span<const std::uint8_t> bytes) {
        const WebPData view = {bytes.data(), bytes.size()};
        handle = WebPDemux(&view);
        has_frame = handle != nullptr && WebPDemuxGetFrame(handle, 1, &frame) != 0;
    }
    ~Demuxer() {
        if (has_frame) WebPDemuxReleaseIterator(&frame);
        WebPDemuxDelete(handle);
    }
    Demuxer(const Demuxer&) = delete;
    Demuxer& operator=(const Demuxer&) = delete;

    WebPDemuxer* handle = nullptr;
    WebPIterator frame{};
    bool has_frame = false;
};

Error damaged(const std::string& reason) {
    return {ErrorCode::kUndecodable, "damaged WebP: " + reason};
}

}  // namespace

Result<Raster> decode_webp(std::span<const std::uint8_t> bytes) {
    const Demuxer demuxer(bytes);
    if (!demuxer.has_frame)
        return damaged("its chunks are cut off or contradict each other");
    const WebPIterator& frame = demuxer.frame;
    const int width =
        static_cast<int>(WebPDemuxGetI(demuxer.handle, WEBP_FF_CANVAS_WIDTH));
    const int height =
        static_cast<int>(WebPDemuxGetI(demuxer.handle, WEBP_FF_CANVAS_HEIGHT));
    const bool covers = frame.width == width && frame.height == height;
    const bool inside = frame.x_offset >= 0 && frame.y_offset >= 0 &&
                        frame.width <= width - frame.x_offset &&
                        frame.height <= height - frame.y_offset;
    if (!inside) return damaged("its first frame lies outside the canvas");

    // What the first frame leaves bare is transparent.
    const bool alpha = frame.has_alpha != 0 || !covers;
    Raster raster(width, height, alpha ? 4 : 3);
    const int stride = static_cast<int>(raster.row_bytes());
    std::uint8_t* first = raster.row(frame.y_offset) +
                          static_cast<std::size_t>(frame.x_offset) * raster.channels;
    const std::size_t room =
        raster.pixels.size() - static_cast<std::size_t>(first - raster.pixels.data());
    const WebPData& stream = frame.fragment;
    const std::uint8_t* decoded =
        alpha ? WebPDecodeRGBAInto(stream.bytes, stream.size, first, room, stride)
              : WebPDecodeRGBInto(stream.bytes, stream.size, first, room, stride);
    if (decoded == nullptr) return damaged("its bitstream is truncated or corrupt");
    return raster;
}

}  // namespace haarmony::ingest
