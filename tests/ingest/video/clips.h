// Clips for the tests of reading and writing films, and files made of them: through our own
// sink, libwebp's encoder, libav's containers, or byte by byte.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/video/clip_shape.h"
#include "engine/video/picture.h"
#include "ingest/picture_source.h"
#include "ingest/video_sink.h"
#include "ingest/video_source.h"

namespace haarmony::ingest::testing {

using Bytes = std::vector<std::uint8_t>;

struct Clip {
    video::FrameFormat format;
    std::vector<video::Picture> pictures;
};

enum class Alpha { kOpaque, kRandom, kDisc };

// Smooth colours that move; alpha opaque, random byte by byte with many clear pixels, or a
// soft disc.
[[nodiscard]] Clip moving_clip(const video::FrameFormat& format, int frames, Alpha alpha);
[[nodiscard]] Clip flat_clip(const video::FrameFormat& format,
                             int frames,
                             video::Rgba color);

[[nodiscard]] Bytes write_film(const Clip& clip, Container container);
[[nodiscard]] Bytes write_film(const Clip& clip, const VideoSinkOptions& options);

// All pictures of a source.
struct Shown {
    video::FrameFormat format;
    std::vector<video::Picture> pictures;
    std::vector<std::int64_t> times_us;
};
// With the error of opening or of the first frame that cannot be read.
[[nodiscard]] Result<Shown> read_all(Result<std::unique_ptr<PictureSource>> source);
// Decoded in this process, or in the child.
[[nodiscard]] Result<Shown> decode_here(const Bytes& file,
                                        VideoFrames frames = VideoFrames::kAll);
[[nodiscard]] Result<Shown> decode_in_child(const Bytes& file,
                                            const VideoSourceOptions& options = {});

// Of all colour channels, in decibels; 99 where nothing differs.
[[nodiscard]] double psnr(const std::vector<video::Picture>& a,
                          const std::vector<video::Picture>& b);
[[nodiscard]] int largest_difference(const video::Picture& a, const video::Picture& b);
[[nodiscard]] video::Picture over(const video::Picture& picture, video::Rgba background);

// What Matroska says is inside, packet by packet, decodable or not.
struct Packets {
    int codec = 0;  // AVCodecID
    bool audio = false;
    int width = 16;
    int height = 16;
    std::vector<Bytes> packets;
};
[[nodiscard]] Bytes matroska_of(const Packets& packets);

// A lossless animated WebP whose frames last `durations_ms`.
[[nodiscard]] Bytes animated_webp(const Clip& clip, const std::vector<int>& durations_ms);

// YUV4MPEG2 with 4:4:4 pictures of one colour each.
struct Yuv {
    std::uint8_t y = 0;
    std::uint8_t u = 0;
    std::uint8_t v = 0;
};
[[nodiscard]] Bytes y4m_of(int width, int height, const std::vector<Yuv>& frames);

}  // namespace haarmony::ingest::testing
