#include "server/api/videos.h"

#include <string>
#include <utility>

#include "server/api/content_tag.h"
#include "server/api/image_id.h"
#include "server/api/inputs.h"
#include "server/api/json_text.h"
#include "server/api/list_page.h"
#include "server/api/video_json.h"
#include "server/http/json.h"

namespace haarmony::server {
namespace {

http::Response tagged(std::string text) {
    http::Response response = http::json_text_response(200, std::move(text));
    response.headers["Cache-Control"] = "no-cache";
    response.headers["ETag"] = content_tag(std::get<std::string>(response.body));
    return response;
}

}  // namespace

Reply list_videos(const Context& context, const http::Request& request) {
    auto inputs = Inputs::of_query(request);
    if (!inputs) return inputs.problem();
    const ListPlace place = ListPlace::read(*inputs);
    if (const auto problem = inputs->refused()) return *problem;
    const auto videos = context.videos.list(place.fetched(), place.cursor.value_or(0));
    if (!videos) return videos.error();
    std::string items = "[";
    std::string next_cursor;
    for (std::size_t i = 0; i < videos->size(); ++i) {
        if (i == static_cast<std::size_t>(place.limit)) {
            next_cursor = std::to_string((*videos)[i - 1].id);
            break;
        }
        if (i > 0) items += ',';
        append_video((*videos)[i], items);
    }
    std::string text;
    JsonObject(text)
        .json("items", items + ']')
        .text_or_null("next_cursor", next_cursor)
        .end();
    return tagged(std::move(text));
}

Reply get_video(const Context& context, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    auto id = video_id_of(request);
    if (!id) return id.problem();
    const auto video = context.videos.get(*id);
    if (!video) return video.error();
    std::string text;
    append_video(*video, text);
    return tagged(std::move(text));
}

Reply delete_video(const Context& context, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    auto id = video_id_of(request);
    if (!id) return id.problem();
    const auto removed = context.videos.remove(*id);
    if (!removed) return removed.error();
    return http::Response{204, {}, std::string()};
}

}  // namespace haarmony::server
