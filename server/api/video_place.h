// Where in a video a picture is: when, how fine, and which part.
//
//   Inputs -> [video_place] -> video_frame, video_export, ...
//
// Errors   read_video_place(): 400 for what contradicts or is of another type, left in the
//          inputs. picture_at(): 422 naming what the clip does not have, and where no time is
//          given; 413 for more pixels than are drawn at once.
#pragma once

#include <cstdint>
#include <optional>

#include "engine/video/time_tree.h"
#include "server/api/inputs.h"
#include "server/api/outcome.h"
#include "server/app/video_picture.h"

namespace haarmony::server {

// As it was asked for.
struct VideoPlace {
    std::int64_t video = 0;
    std::optional<std::int64_t> time_level;
    std::optional<std::int64_t> index;
    std::optional<std::int64_t> frame;
    std::optional<double> time;     // seconds
    std::optional<double> shutter;  // seconds that are averaged
    bool half_blur = false;
    std::optional<double> level;  // L where neither is given
    std::optional<std::int64_t> width;
    std::optional<double> x;
    std::optional<double> y;
    std::optional<double> w;
    std::optional<double> h;
    video::Edge edge = video::Edge::kNormalize;
    bool smooth = false;  // beyond the finest detail
};

// Of the names that API and openapi.yaml list; "video" has to be there.
[[nodiscard]] VideoPlace read_video_place(Inputs& inputs);

// In the clip's own numbers; format and background are left as they are.
[[nodiscard]] Outcome<VideoPicture> picture_at(const video::TimeTree& clip,
                                               const VideoPlace& place);

}  // namespace haarmony::server
