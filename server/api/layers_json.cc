#include "server/api/layers_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "engine/video/clip_shape.h"
#include "engine/video/ops/composite.h"
#include "ingest/decode.h"
#include "ingest/media_fragment.h"
#include "server/api/base64.h"
#include "server/api/inputs.h"
#include "server/api/points_json.h"
#include "server/app/mapped_file.h"

namespace haarmony::server {
namespace {

using nlohmann::json;
using Picture = std::span<const std::uint8_t>;

constexpr double kFurthest = 4'294'967'296;  // 2^32 pixels

// Two numbers, as [x, y].
Outcome<std::array<double, 2>> read_pair(Inputs& inputs,
                                         std::string_view name,
                                         double otherwise) {
    const auto value = inputs.member(name);
    std::array<double, 2> pair{otherwise, otherwise};
    if (!value) return pair;
    if (!value->is_array() || value->size() != 2 || !(*value)[0].is_number() ||
        !(*value)[1].is_number())
        return malformed(
            std::string(name) + " '" + shown_json(*value) + "' is not [x, y]", name);
    return std::array<double, 2>{(*value)[0].get<double>(), (*value)[1].get<double>()};
}

Outcome<std::array<std::int64_t, 2>> read_translation(Inputs& inputs) {
    auto pair = read_pair(inputs, "translate", 0);
    if (!pair) return pair.problem();
    std::array<std::int64_t, 2> whole{};
    for (std::size_t i = 0; i < 2; ++i) {
        const double value = (*pair)[i];
        if (value != std::floor(value) || std::abs(value) > kFurthest)
            return impossible(
                "out_of_range",
                "translate '" + number_text(value) + "' is not a whole number of pixels",
                "translate");
        whole[i] = static_cast<std::int64_t>(value);
    }
    return whole;
}

// Straight RGBA of full size.
Outcome<StillPicture> keep_pixels(Picture bytes, std::vector<std::byte>& stills) {
    ingest::DecodeLimits limits;
    limits.min_side = video::kMaxSide;  // a JPEG is not to come back smaller
    ingest::Decoder decoder(limits);
    const auto picture = decoder.decode(bytes);
    if (!picture) return picture.error();
    const ImageView view = picture->view();
    const StillPicture still{stills.size(), view.width, view.height};
    stills.reserve(stills.size() + std::size_t{4} * static_cast<std::size_t>(view.width) *
                                       static_cast<std::size_t>(view.height));
    for (int y = 0; y < view.height; ++y) {
        const std::uint8_t* pixel = view.row(y);
        for (int x = 0; x < view.width; ++x, pixel += view.channels) {
            const bool grey = view.channels == 1;
            const std::uint8_t alpha = view.channels == 4 ? pixel[3] : 255;
            for (const std::uint8_t channel :
                 {pixel[0], pixel[grey ? 0 : 1], pixel[grey ? 0 : 2], alpha})
                stills.push_back(std::byte{channel});
        }
    }
    return still;
}

Outcome<StillPicture> stored_image(const Context& context,
                                   ImageId id,
                                   std::vector<std::byte>& stills) {
    const auto image = context.images.get(id);
    if (!image) return image.error();
    const auto path = context.media_roots.locate(image->uri);
    if (path && !ingest::is_key_frame_uri(image->uri)) {
        const auto file = MappedFile::open(*path);
        if (file) {
            const auto bytes = (*file)->bytes();
            return keep_pixels(
                {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
                stills);
        }
    }
    const auto thumbnail = context.images.thumbnail(id);
    if (!thumbnail) return thumbnail.error();
    return keep_pixels(thumbnail->bytes, stills);
}

Outcome<StillPicture> read_still(const Context& context,
                                 const json& value,
                                 std::vector<std::byte>& stills) {
    if (value.is_string()) {
        const auto bytes = decode_base64(value.get_ref<const std::string&>());
        if (!bytes) return malformed("image: " + bytes.error().message, "image");
        return keep_pixels(
            {reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size()},
            stills);
    }
    if (!value.is_number_integer() || value.get<std::int64_t>() < 1)
        return malformed(
            "image '" + shown_json(value) + "' is neither the id of an image nor base64",
            "image");
    return stored_image(context, ImageId{value.get<std::int64_t>()}, stills);
}

Outcome<LayerRequest> read_layer(const Context& context,
                                 const json& value,
                                 std::vector<std::byte>& stills) {
    auto inputs = Inputs::of_object(value);
    if (!inputs) return inputs.problem();
    LayerRequest layer;
    constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
    layer.video = inputs->integer("video", 1, kMost).value_or(0);
    const json* image = inputs->peek("image");
    if (inputs->has("video") == inputs->has("image"))
        inputs->refuse(
            http::Problem{400,
                          inputs->has("video") ? "several_sources" : "no_source",
                          "a layer is one video or one image",
                          "video",
                          {}});
    auto translate = read_translation(*inputs);
    if (!translate) return translate.problem();
    auto scale = read_pair(*inputs, "scale", 1);
    if (!scale) return scale.problem();
    layer.dx = (*translate)[0];
    layer.dy = (*translate)[1];
    layer.scale_x = (*scale)[0];
    layer.scale_y = (*scale)[1];
    if (const auto level = inputs->integer("at_level", -kMost, kMost))
        layer.at_level = static_cast<int>(std::clamp<std::int64_t>(*level, -1, 99));
    layer.start = inputs->integer("start", -kMost, kMost).value_or(0);
    if (layer.start < 0 || layer.start > std::int64_t{1} << video::kMaxTimeLevels)
        inputs->refuse(impossible("out_of_range",
                                  "start '" + std::to_string(layer.start) +
                                      "' is not a frame that a clip can have",
                                  "start"));
    if (const auto op = inputs->one_of("op", video::kOperatorNames)) layer.op = *op;
    if (const auto problem = inputs->refused()) return *problem;
    if (image == nullptr) return layer;
    auto still = read_still(context, *image, stills);
    if (!still) return still.problem();
    layer.still = *still;
    return layer;
}

}  // namespace

Outcome<LayersIn> read_layers(const Context& context, const json& layers) {
    if (!layers.is_array()) return malformed("layers is not a list", "layers");
    if (layers.empty() || layers.size() > video::kMaxLayers)
        return impossible("out_of_range",
                          "layers has " + std::to_string(layers.size()) +
                              " entries, not 1 to " + std::to_string(video::kMaxLayers),
                          "layers");
    LayersIn in;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const std::string place = "layers[" + std::to_string(i) + "]";
        auto layer = read_layer(context, layers[i], in.stills);
        if (!layer) {
            http::Problem problem = layer.problem();
            problem.detail = place + ": " + problem.detail;
            problem.param = problem.param.empty() ? place : place + "." + problem.param;
            return problem;
        }
        in.layers.push_back(*std::move(layer));
    }
    return in;
}

}  // namespace haarmony::server
