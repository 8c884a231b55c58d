#include "server/api/video_panorama.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "engine/video/panorama.h"
#include "server/api/content_tag.h"
#include "server/api/inputs.h"
#include "server/api/picture_format.h"
#include "server/api/points_json.h"
#include "server/app/video_picture.h"

namespace haarmony::server {
namespace {

constexpr std::int32_t kUsualWidth = 640;
constexpr std::int64_t kMostPixels = std::int64_t{16} << 20;

struct View {
    std::int64_t video = 0;
    double time = 0;
    video::PanoramaView view;
};

View read_view(Inputs& inputs) {
    constexpr double kAny = std::numeric_limits<double>::max();
    View view;
    if (!inputs.has("video")) inputs.refuse("video", "is missing");
    view.video =
        inputs.integer("video", 1, std::numeric_limits<std::int64_t>::max()).value_or(0);
    view.time = inputs.number("time", -kAny, kAny).value_or(0);
    view.view.yaw = inputs.number("yaw", -kAny, kAny).value_or(0);
    view.view.pitch = inputs.number("pitch", -kAny, kAny).value_or(0);
    view.view.fov = inputs.number("fov", -kAny, kAny).value_or(view.view.fov);
    view.view.width = static_cast<std::int32_t>(
        inputs.integer("width", 1, video::kLargestView).value_or(kUsualWidth));
    view.view.height =
        static_cast<std::int32_t>(inputs.integer("height", 1, video::kLargestView)
                                      .value_or(std::max(1, view.view.width * 3 / 4)));
    return view;
}

}  // namespace

Reply get_panorama(const Context& context, const http::Request& request) {
    auto inputs = Inputs::of_query(request);
    if (!inputs) return inputs.problem();
    const View view = read_view(*inputs);
    const PictureFormat format = read_picture_format(*inputs, request.header("Accept"));
    const auto background = read_background(*inputs);
    if (const auto problem = inputs->refused()) return *problem;
    const auto video = context.videos.clip(view.video);
    if (!video) return video.error();
    const video::ClipShape& shape = (*video)->clip().shape();
    const double frame = std::floor(view.time * shape.rate().per_second());
    if (!(frame >= 0 && frame < static_cast<double>(shape.frames())))
        return impossible("out_of_range",
                          "time '" + number_text(view.time) + "' is outside the clip",
                          "time");
    if (std::int64_t{view.view.width} * view.view.height > kMostPixels)
        return http::Problem{413,
                             "too_large",
                             std::to_string(view.view.width) + " x " +
                                 std::to_string(view.view.height) +
                                 " pixels are more than " + std::to_string(kMostPixels),
                             "width",
                             {}};
    const auto drawn =
        video::draw_panorama((*video)->clip(),
                             {shape.time_levels(), static_cast<std::int64_t>(frame)},
                             view.view);
    if (!drawn && drawn.error().code == ErrorCode::kInvalidArgument)
        return impossible(drawn.error());
    if (!drawn) return drawn.error();
    auto bytes = encode_picture(*drawn, format, background);
    if (!bytes) return bytes.error();
    http::Response response;
    response.headers["Content-Type"] = media_type_of(format);
    response.headers["X-Width"] = std::to_string(drawn->width);
    response.headers["X-Height"] = std::to_string(drawn->height);
    response.headers["ETag"] = content_tag(*bytes);
    response.headers["Vary"] = "Accept";
    response.headers["Accept-Ranges"] = "bytes";
    response.headers["Cache-Control"] = "no-cache";
    response.headers["X-Content-Type-Options"] = "nosniff";
    response.body = *std::move(bytes);
    return response;
}

}  // namespace haarmony::server
