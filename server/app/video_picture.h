// A picture of a video, drawn and encoded, and kept for the next who asks.
//
//   server/api/video_frame -> [video_picture] -> engine/video/display.h, shutter.h
//                                  '--> reply_cache
//
// Shape    a picture is cropped to the clip's own size, then to the box.
// Errors   what the storage meets; kInvalidArgument where the format cannot hold the picture.
// Threads  const-safe.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "engine/video/clip_shape.h"
#include "engine/video/display.h"
#include "engine/video/image_tree.h"
#include "engine/video/picture.h"
#include "server/app/reply_cache.h"
#include "server/app/video_service.h"

namespace haarmony::server {

enum class PictureFormat { kPng, kWebp, kJpeg, kRgba };
inline constexpr std::array<std::string_view, 4> kPictureFormats{"png",
                                                                 "webp",
                                                                 "jpeg",
                                                                 "rgba"};
[[nodiscard]] std::string_view media_type_of(PictureFormat format);

// What is asked for, in numbers that this clip has.
struct VideoPicture {
    video::FrameRange frames;
    // That covers exactly these frames; none where several have to be averaged.
    std::optional<video::NodeAddress> node;
    int level = 0;                               // drawn as it is, where there is no side
    std::optional<std::int32_t> root_side = {};  // fractional zoom
    video::PixelBox box;                         // of the cropped picture at that size
    video::Edge edge = video::Edge::kNormalize;
    video::Finer finer = video::Finer::kFlat;
    PictureFormat format = PictureFormat::kPng;
    std::optional<video::Rgba> background = {};  // opaque
};

// The time node that covers exactly the frames, if there is one.
[[nodiscard]] std::optional<video::NodeAddress> node_of(const video::ClipShape& shape,
                                                        const video::FrameRange& frames);

// Of everything that the reply depends on: equal keys, equal bytes.
[[nodiscard]] std::string key_of(const schema::Video& video, const VideoPicture& picture);
// Strong; of the key.
[[nodiscard]] std::string etag_of(const std::string& key);

[[nodiscard]] Result<video::Picture> draw_picture(const video::TimeTree& clip,
                                                  const VideoPicture& picture);
[[nodiscard]] Result<std::string> encode_picture(
    const video::Picture& picture,
    PictureFormat format,
    const std::optional<video::Rgba>& background);

// What of a picture took how long.
struct PictureTimes {
    std::chrono::nanoseconds decode{};  // of what was not in memory of the node drawn
    std::chrono::nanoseconds draw{};
    std::chrono::nanoseconds encode{};
};

struct PictureAnswer {
    ReplyCache::Reply reply;
    std::optional<PictureTimes> times;  // none where it was kept
};

// From the cache, or drawn and put there under `alias`, too.
[[nodiscard]] Result<PictureAnswer> picture_reply(VideoService& videos,
                                                  const OpenVideo& video,
                                                  const VideoPicture& picture,
                                                  const std::string& alias);

}  // namespace haarmony::server
