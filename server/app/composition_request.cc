#include "server/app/composition_request.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/video/build.h"
#include "server/app/raw_frames.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

json layer_json(const LayerRequest& layer) {
    json object{{"translate", {layer.dx, layer.dy}},
                {"scale", {layer.scale_x, layer.scale_y}},
                {"start", layer.start},
                {"op", layer.op}};
    if (layer.at_level) object["at_level"] = *layer.at_level;
    if (layer.video != 0) {
        object["video"] = layer.video;
    } else {
        object["image"] = {layer.still.offset, layer.still.width, layer.still.height};
    }
    return object;
}

LayerRequest layer_of(const json& object) {
    LayerRequest layer;
    object.at("translate").at(0).get_to(layer.dx);
    object.at("translate").at(1).get_to(layer.dy);
    object.at("scale").at(0).get_to(layer.scale_x);
    object.at("scale").at(1).get_to(layer.scale_y);
    object.at("start").get_to(layer.start);
    object.at("op").get_to(layer.op);
    if (object.contains("at_level")) layer.at_level = object["at_level"].get<int>();
    if (object.contains("video")) {
        object.at("video").get_to(layer.video);
    } else {
        object.at("image").at(0).get_to(layer.still.offset);
        object.at("image").at(1).get_to(layer.still.width);
        object.at("image").at(2).get_to(layer.still.height);
    }
    return layer;
}

Error of_layer(std::size_t number, const Error& error) {
    return {error.code,
            "layers[" + std::to_string(number) + "]: " + error.message,
            "layers[" + std::to_string(number) + "]" +
                (error.param.empty() ? "" : "." + error.param)};
}

Result<std::unique_ptr<video::MemoryClip>> clip_of(const StillPicture& still,
                                                   std::span<const std::byte> stills) {
    const video::FrameFormat format{still.width, still.height, {25, 1}};
    const auto shape = video::ClipShape::make(format, 1);
    if (!shape) return shape.error();
    const std::size_t size = raw_frame_bytes(format);
    if (still.offset > stills.size() || size > stills.size() - still.offset)
        return Error{ErrorCode::kInvalidArgument, "the picture's pixels are not there"};
    RawFrames frames(stills.subspan(static_cast<std::size_t>(still.offset), size),
                     format);
    video::MemorySpool spool;
    video::MemoryClip::Sink sink;
    const auto built = video::build(frames, spool, sink);
    if (!built) return built.error();
    return sink.take();
}

Result<video::CompositionLayer> engine_layer(const LayerRequest& request,
                                             const video::TimeTree& clip) {
    video::CompositionLayer layer;
    layer.clip = &clip;
    const auto scale = video::scale_of(request.scale_x, request.scale_y);
    if (!scale) return scale.error();
    layer.placement.scale = *scale;
    layer.placement.dx = request.dx;
    layer.placement.dy = request.dy;
    layer.placement.at_level = request.at_level;
    layer.start = request.start;
    const auto op = video::parse_operator(request.op);
    if (!op) return op.error();
    layer.op = *op;
    return layer;
}

}  // namespace

std::string to_text(const CompositionRequest& request) {
    json layers = json::array();
    for (const LayerRequest& layer : request.layers) layers.push_back(layer_json(layer));
    json object{{"layers", std::move(layers)},
                {"width", request.width},
                {"height", request.height}};
    if (request.rate)
        object["rate"] = {request.rate->numerator, request.rate->denominator};
    return object.dump(-1, ' ', false, json::error_handler_t::replace);
}

Result<CompositionRequest> composition_request_of(std::string_view text) {
    CompositionRequest request;
    try {
        const json object = json::parse(text);
        for (const json& layer : object.at("layers"))
            request.layers.push_back(layer_of(layer));
        object.at("width").get_to(request.width);
        object.at("height").get_to(request.height);
        if (object.contains("rate"))
            request.rate = video::FrameRate{object["rate"].at(0).get<std::int32_t>(),
                                            object["rate"].at(1).get<std::int32_t>()};
    } catch (const json::exception&) {
        return Error{ErrorCode::kInvalidArgument,
                     "the composition " + std::string(text) + " is not understood"};
    }
    return request;
}

Result<OpenComposition> OpenComposition::open(VideoService& videos,
                                              const CompositionRequest& request,
                                              std::span<const std::byte> stills) {
    if (request.layers.empty())
        return Error{ErrorCode::kInvalidArgument, "there are no layers", "layers"};
    OpenComposition opened;
    std::int64_t end = 0;
    for (std::size_t i = 0; i < request.layers.size(); ++i) {
        const LayerRequest& asked = request.layers[i];
        const video::TimeTree* clip = nullptr;
        if (asked.video != 0) {
            auto video = videos.clip(asked.video);
            if (!video) return of_layer(i, video.error());
            clip = &(*video)->clip();
            end = std::max(end, asked.start + clip->shape().frames());
            opened.videos_.push_back(*std::move(video));
        } else {
            auto still = clip_of(asked.still, stills);
            if (!still) return of_layer(i, still.error());
            clip = still->get();
            end = std::max(end, asked.start + 1);
            opened.stills_.push_back(*std::move(still));
        }
        const auto layer = engine_layer(asked, *clip);
        if (!layer) return of_layer(i, layer.error());
        opened.layers_.push_back(*layer);
    }
    for (std::size_t i = 0; i < request.layers.size(); ++i)
        if (request.layers[i].video == 0)
            opened.layers_[i].frames = end - request.layers[i].start;
    const video::FrameFormat& lowest = opened.layers_.front().clip->shape().format();
    opened.canvas_ = {request.width == 0 ? lowest.width : request.width,
                      request.height == 0 ? lowest.height : request.height,
                      request.rate.value_or(lowest.rate)};
    const auto shape = video::composed_shape(opened.layers_, opened.canvas_);
    if (!shape) return shape.error();
    opened.shape_ = *shape;
    return opened;
}

}  // namespace haarmony::server
