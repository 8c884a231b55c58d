#include "server/app/video_request.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/video/pixel.h"
#include "server/app/video_files.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 6> kOrigins{"raw",
                                                   "leaves",
                                                   "clip",
                                                   "generated",
                                                   "composed",
                                                   "media"};

constexpr std::int32_t kMostDenominator = 1'001;

json rate_json(const video::FrameRate& rate) {
    return {rate.numerator, rate.denominator};
}

void read_rate(const json& value, video::FrameRate& rate) {
    value.at(0).get_to(rate.numerator);
    value.at(1).get_to(rate.denominator);
}

json parameters_json(const video::GeneratorParameters& parameters) {
    json object{{"width", parameters.width},
                {"height", parameters.height},
                {"frames", parameters.frames},
                {"rate", rate_json(parameters.rate)},
                {"seed", parameters.seed}};
    if (parameters.depth) object["depth"] = *parameters.depth;
    return object;
}

video::GeneratorParameters parameters_of(const json& object) {
    video::GeneratorParameters parameters;
    object.at("width").get_to(parameters.width);
    object.at("height").get_to(parameters.height);
    object.at("frames").get_to(parameters.frames);
    read_rate(object.at("rate"), parameters.rate);
    object.at("seed").get_to(parameters.seed);
    if (object.contains("depth")) parameters.depth = object["depth"].get<int>();
    return parameters;
}

}  // namespace

std::string to_text(const VideoRequest& request) {
    json object{{"origin", kOrigins[static_cast<std::size_t>(request.origin)]},
                {"name", request.wishes.name},
                {"delta", request.wishes.delta},
                {"max_frames", request.wishes.max_frames},
                {"index", request.wishes.index}};
    if (!request.input.empty()) object["input"] = request.input;
    if (!request.path.empty()) object["path"] = request.path;
    if (request.append_to) object["append_to"] = *request.append_to;
    if (request.format.width > 0) {
        object["width"] = request.format.width;
        object["height"] = request.format.height;
        object["rate"] = rate_json(request.format.rate);
    }
    if (!request.generator.empty()) {
        object["generate"] = request.generator;
        object["parameters"] = parameters_json(request.parameters);
    }
    if (!request.composition.layers.empty())
        object["composition"] = json::parse(to_text(request.composition));
    return object.dump(-1, ' ', false, json::error_handler_t::replace);
}

Result<VideoRequest> video_request_of(std::string_view text) {
    const Error foreign{ErrorCode::kInvalidArgument,
                        "the request " + std::string(text) + " is not understood"};
    const json object = json::parse(text, nullptr, false);
    if (!object.is_object()) return foreign;
    VideoRequest request;
    try {
        const auto& origin = object.at("origin").get_ref<const std::string&>();
        std::size_t which = 0;
        while (which < kOrigins.size() && kOrigins[which] != origin) ++which;
        if (which == kOrigins.size()) return foreign;
        request.origin = static_cast<VideoOrigin>(which);
        object.at("name").get_to(request.wishes.name);
        object.at("delta").get_to(request.wishes.delta);
        object.at("max_frames").get_to(request.wishes.max_frames);
        object.at("index").get_to(request.wishes.index);
        request.input = object.value("input", "");
        request.path = object.value("path", "");
        if (object.contains("append_to"))
            request.append_to = object["append_to"].get<std::int64_t>();
        if (object.contains("width")) {
            object.at("width").get_to(request.format.width);
            object.at("height").get_to(request.format.height);
            read_rate(object.at("rate"), request.format.rate);
        }
        request.generator = object.value("generate", "");
        if (object.contains("parameters"))
            request.parameters = parameters_of(object["parameters"]);
        if (object.contains("composition")) {
            auto composition = composition_request_of(object["composition"].dump());
            if (!composition) return composition.error();
            request.composition = *std::move(composition);
        }
    } catch (const json::exception&) {
        return foreign;
    }
    const double delta = request.wishes.delta;
    if (!(delta >= 0 && delta <= 255) || request.wishes.max_frames < 0) return foreign;
    if (!request.input.empty() && !is_input_name(request.input)) return foreign;
    return request;
}

std::optional<std::string> input_of_request(std::string_view text) {
    Result<VideoRequest> request = video_request_of(text);
    if (!request || request->input.empty()) return {};
    return std::move(request->input);
}

video::FrameRate rate_of(double per_second) {
    video::FrameRate best{static_cast<std::int32_t>(std::lround(per_second * 1'000)),
                          1'000};
    double error = std::abs(best.per_second() - per_second);
    for (std::int32_t denominator = 1; denominator <= kMostDenominator; ++denominator) {
        const auto numerator =
            static_cast<std::int32_t>(std::lround(per_second * denominator));
        if (numerator < 1) continue;
        const video::FrameRate rate{numerator, denominator};
        const double off = std::abs(rate.per_second() - per_second);
        // Where a smaller denominator is as near, it stands already.
        if (off < error || (off == error && denominator < best.denominator)) {
            best = rate;
            error = off;
        }
    }
    return best;
}

std::uint32_t delta_units(double delta) {
    return static_cast<std::uint32_t>(std::llround(delta * video::kDifferenceOne));
}

}  // namespace haarmony::server
