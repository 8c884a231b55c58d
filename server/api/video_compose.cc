#include "server/api/video_compose.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "engine/video/ops/preview.h"
#include "server/api/content_tag.h"
#include "server/api/inputs.h"
#include "server/api/layers_json.h"
#include "server/api/picture_format.h"
#include "server/api/points_json.h"
#include "server/api/video_wishes.h"
#include "server/app/video_picture.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

// What the engine refuses of a composition is well-formed.
http::Problem refused(const Error& error) {
    return error.code == ErrorCode::kInvalidArgument ? impossible(error)
                                                     : http::problem_of(error);
}

struct PreviewAddress {
    video::NodeAddress at;
    int level = 0;
};

Outcome<PreviewAddress> read_preview(const json& value, const video::ClipShape& shape) {
    auto inputs = Inputs::of_object(value);
    if (!inputs) return inputs.problem();
    constexpr std::int64_t kMost = video::kMaxSampleBits;
    PreviewAddress preview;
    preview.at.time_level = static_cast<int>(
        inputs->integer("time_level", 0, kMost).value_or(shape.time_levels()));
    preview.at.index = inputs->integer("index", 0, std::int64_t{1} << kMost).value_or(0);
    preview.level = static_cast<int>(
        inputs->integer("level", 0, kMost).value_or(shape.space_levels()));
    if (const auto problem = inputs->refused()) {
        http::Problem named = *problem;
        // Of the right type, and outside of any clip.
        if (named.code == "invalid_argument" && value.contains(named.param) &&
            value[named.param].is_number_integer())
            named.status = 422;
        named.param = "preview." + named.param;
        return named;
    }
    return preview;
}

Reply show_preview(const OpenComposition& composition,
                   const PreviewAddress& preview,
                   PictureFormat format,
                   const std::optional<video::Rgba>& background) {
    const auto drawn = video::preview(
        composition.layers(), composition.canvas(), preview.at, preview.level);
    if (!drawn) return refused(drawn.error());
    auto bytes = encode_picture(*drawn, format, background);
    if (!bytes) return bytes.error();
    const video::FrameRange frames = composition.shape().frames_of(preview.at);
    http::Response response;
    response.headers["Content-Type"] = media_type_of(format);
    response.headers["X-Preview"] = "yes";
    response.headers["X-Width"] = std::to_string(drawn->width);
    response.headers["X-Height"] = std::to_string(drawn->height);
    response.headers["X-Frame-Interval"] =
        std::to_string(frames.first) + '-' + std::to_string(frames.end - 1);
    response.headers["Vary"] = "Accept";
    response.headers["Cache-Control"] = "no-store";
    response.headers["X-Content-Type-Options"] = "nosniff";
    response.body = *std::move(bytes);
    return response;
}

}  // namespace

Reply post_composition(const Context& context, const http::Request& request) {
    auto inputs = Inputs::of_request(request);
    if (!inputs) return inputs.problem();
    VideoRequest video;
    video.origin = VideoOrigin::kComposed;
    video.wishes = read_video_wishes(*inputs);
    const bool has_rate = inputs->has("rate");
    const video::FrameFormat format = read_frame_format(*inputs);
    const json* layers = inputs->peek("layers");
    const json* preview = inputs->peek("preview");
    const PictureFormat picture = read_picture_format(*inputs, request.header("Accept"));
    const auto background = read_background(*inputs);
    if (!inputs->has("layers")) inputs->refuse(malformed("layers is missing", "layers"));
    if (!preview && inputs->has("format"))
        inputs->refuse(malformed("format belongs to preview", "format"));
    if (const auto problem = inputs->refused()) return *problem;
    auto in = read_layers(context, *layers);
    if (!in) return in.problem();
    video.composition.layers = std::move(in->layers);
    video.composition.width = format.width;
    video.composition.height = format.height;
    if (has_rate) video.composition.rate = format.rate;
    const auto opened =
        OpenComposition::open(context.videos, video.composition, in->stills);
    if (!opened) return refused(opened.error());
    if (preview != nullptr) {
        auto address = read_preview(*preview, opened->shape());
        if (!address) return address.problem();
        if (!opened->shape().contains(address->at) ||
            address->level > opened->shape().space_levels())
            return impossible(
                "out_of_range",
                "preview " + preview->dump() + " is outside the composition",
                "preview");
        return show_preview(*opened, *address, picture, background);
    }
    return queue_video(context, std::move(video), in->stills);
}

}  // namespace haarmony::server
