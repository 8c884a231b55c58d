#include "server/api/video_frame.h"

#include <string>
#include <utility>

#include "server/api/inputs.h"
#include "server/api/picture_format.h"
#include "server/api/server_timing.h"
#include "server/api/video_place.h"
#include "server/app/video_picture.h"
#include "server/http/conditional.h"

namespace haarmony::server {
namespace {

// The request as it is spelt: all that its picture can depend on.
std::string spelling_of(const http::Request& request) {
    std::string text(request.header("Accept"));
    for (const auto& [name, value] : request.query) {
        text += '\n' + name + '=' + value;
    }
    return text + '\n' + request.body;
}

http::Response response_of(const PictureAnswer& answer, PictureFormat format) {
    const ReplyCache::Reply& reply = answer.reply;
    http::Response response;
    response.body = reply->bytes;
    response.headers["Content-Type"] = media_type_of(format);
    response.headers["X-Width"] = std::to_string(reply->width);
    response.headers["X-Height"] = std::to_string(reply->height);
    response.headers["X-Frame-Interval"] =
        std::to_string(reply->first_frame) + '-' + std::to_string(reply->last_frame);
    const auto word = [](bool finer) { return finer ? "yes" : "no"; };
    response.headers["X-Detail"] =
        std::string(word(reply->finer_in_space)) + ", " + word(reply->finer_in_time);
    if (const auto& times = answer.times)
        response.headers["Server-Timing"] = server_timing({{"decode", times->decode},
                                                           {"draw", times->draw},
                                                           {"encode", times->encode}});
    return response;
}

Reply frame(const Context& context, const http::Request& request, Inputs& inputs) {
    const VideoPlace place = read_video_place(inputs);
    const auto revision = inputs.text("rev");
    const PictureFormat format = read_picture_format(inputs, request.header("Accept"));
    const auto background = read_background(inputs);
    if (const auto problem = inputs.refused()) return *problem;
    const auto video = context.videos.clip(place.video);
    if (!video) return video.error();
    if (revision && *revision != (*video)->row().revision)
        return http::Problem{404,
                             "not_found",
                             "video " + std::to_string(place.video) +
                                 " has no revision '" + *revision + "'",
                             "rev",
                             {}};
    auto picture = picture_at((*video)->clip(), place);
    if (!picture) return picture.problem();
    picture->format = format;
    picture->background = background;
    const std::string etag = etag_of(key_of((*video)->row(), *picture));
    http::Response response;
    // What the client has already need not be drawn.
    if (!http::is_unmodified(request, etag)) {
        const auto made =
            picture_reply(context.videos, **video, *picture, spelling_of(request));
        if (!made) return made.error();
        response = response_of(*made, format);
    }
    response.headers["ETag"] = etag;
    response.headers["Vary"] = "Accept";
    response.headers["Accept-Ranges"] = "bytes";
    response.headers["X-Content-Type-Options"] = "nosniff";
    response.headers["Cache-Control"] =
        revision ? "public, max-age=31536000, immutable" : "no-cache";
    return response;
}

}  // namespace

Reply get_frame(const Context& context, const http::Request& request) {
    auto inputs = Inputs::of_query(request);
    if (!inputs) return inputs.problem();
    return frame(context, request, *inputs);
}

Reply post_frame(const Context& context, const http::Request& request) {
    auto inputs = Inputs::of_request(request);
    if (!inputs) return inputs.problem();
    return frame(context, request, *inputs);
}

http::Cost cost_of_frame(const Context& context, const http::Request& request) {
    return context.videos.replies().knows(spelling_of(request)) ? http::Cost::kCheap
                                                                : http::Cost::kCostly;
}

}  // namespace haarmony::server
