#include "server/app/raw_frames.h"

#include <cstdint>

#include "engine/video/create_frame.h"

namespace haarmony::server {

std::size_t raw_frame_bytes(const video::FrameFormat& format) {
    return std::size_t{4} * static_cast<std::size_t>(format.width) *
           static_cast<std::size_t>(format.height);
}

Result<bool> RawFrames::next(video::SourceFrame& frame) {
    const std::size_t size = raw_frame_bytes(format_);
    if (bytes_.size() < size) return false;
    const ImageView picture{reinterpret_cast<const std::uint8_t*>(bytes_.data()),
                            format_.width,
                            format_.height,
                            4,
                            std::ptrdiff_t{4} * format_.width};
    video::create_frame(picture, frame.tree);
    frame.repeats = 1;
    bytes_ = bytes_.subspan(size);
    return true;
}

}  // namespace haarmony::server
