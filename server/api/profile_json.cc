#include "server/api/profile_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

namespace haarmony::server {
namespace {

using nlohmann::json;

constexpr double kWeightOne = 100;  // stored weights are in 1/100
constexpr std::size_t kShownBytes = 40;
constexpr std::size_t kMaxNameBytes = 64;
constexpr std::array<std::string_view, 5> kColorSpaces{"yiq", "rgb", "hsv", "lab", "luv"};
constexpr std::array<std::string_view, 2> kDecompositions{"standard", "nonstandard"};
constexpr std::array<std::string_view, 3> kBinRules{"log2_plus_1", "linear", "literal"};

// Stops at the first thing that is wrong; the complaint starts with its place.
class WeightsReader {
  public:
    explicit WeightsReader(Inputs& inputs) : inputs_(inputs) {}

    std::optional<image::Weights> read(const json& value) {
        image::Weights weights{};
        if (!is_array_of(value, weights.size(), "weights", "3 arrays of 6 numbers"))
            return {};
        for (std::size_t channel = 0; channel < weights.size(); ++channel) {
            const std::string at = "weights[" + std::to_string(channel) + "]";
            if (!is_array_of(value[channel], weights[channel].size(), at, "6 numbers"))
                return {};
            for (std::size_t bin = 0; bin < weights[channel].size(); ++bin)
                if (!read_weight(value[channel][bin],
                                 at + "[" + std::to_string(bin) + "]",
                                 weights[channel][bin]))
                    return {};
        }
        return weights;
    }

  private:
    bool refuse(const std::string& at, const json& value, const std::string& why) {
        inputs_.refuse(
            http::Problem{400,
                          "invalid_argument",
                          at + " '" + value.dump().substr(0, kShownBytes) + "' " + why,
                          at,
                          {}});
        return false;
    }

    bool is_array_of(const json& value,
                     std::size_t size,
                     const std::string& at,
                     const std::string& what) {
        if (value.is_array() && value.size() == size) return true;
        return refuse(at, value, "is not an array of " + what);
    }

    bool read_weight(const json& value, const std::string& at, std::int32_t& weight) {
        constexpr double kMost = image::kMaxWeight / kWeightOne;
        if (!value.is_number())
            return refuse(at, value, "is not a number from 0 to 10000");
        const auto number = value.get<double>();
        if (!(number >= 0 && number <= kMost))
            return refuse(at, value, "is not a number from 0 to 10000");
        const double hundredths = std::round(number * kWeightOne);
        // Both sides are the double next to a number of two decimals, if it is one.
        if (hundredths / kWeightOne != number)
            return refuse(at, value, "has more than two decimals");
        weight = static_cast<std::int32_t>(hundredths);
        return true;
    }

    Inputs& inputs_;
};

std::optional<image::Calibration> read_calibration(Inputs& inputs, const json& value) {
    image::Calibration calibration;
    bool whole = value.is_object() && value.size() == 2;
    for (const auto& [name, number] : {std::pair("intercept", &calibration.intercept),
                                       std::pair("scale", &calibration.scale)}) {
        whole = whole && value.contains(name) && value[name].is_number();
        if (whole) *number = value[name].get<double>();
    }
    if (!whole) {
        inputs.refuse("calibration", "is neither null nor {\"intercept\", \"scale\"}");
        return {};
    }
    // A probability that grows with the distance is none of a match.
    if (calibration.scale < 0) {
        inputs.refuse("calibration", "has a scale below 0");
        return {};
    }
    return calibration;
}

}  // namespace

json weights_json(const image::Weights& weights) {
    json channels = json::array();
    for (const auto& channel : weights) {
        json bins = json::array();
        for (const std::int32_t weight : channel) bins.push_back(weight / kWeightOne);
        channels.push_back(std::move(bins));
    }
    return channels;
}

json profile_json(const schema::StoredProfile& profile,
                  bool built_in,
                  std::int64_t indexed) {
    json calibration;
    if (profile.calibration)
        calibration = {{"intercept", profile.calibration->first},
                       {"scale", profile.calibration->second}};
    return {{"name", profile.name},
            {"color_space", profile.color_space},
            {"decomposition", profile.decomposition},
            {"m", profile.m},
            {"bin_rule", profile.bin_rule},
            {"weights", weights_json(profile.weights)},
            {"calibration", std::move(calibration)},
            {"built_in", built_in},
            {"indexed", indexed},
            {"updated_at", built_in ? json() : json(profile.updated_at)}};
}

bool is_word(std::string_view text) {
    return !text.empty() && text.size() <= kMaxNameBytes &&
           std::ranges::all_of(text, [](char c) {
               return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' ||
                      c == '-';
           });
}

std::optional<http::Problem> refuse_name(const std::string& name) {
    if (is_word(name)) return {};
    return http::Problem{
        400,
        "invalid_argument",
        "the name '" + name.substr(0, 80) + "' is not 1 to 64 of a-z, 0-9, _ and -",
        "name",
        {}};
}

image::Profile read_profile(Inputs& inputs,
                            const std::string& name,
                            const image::Profile& defaults) {
    const bool changed = inputs.has("color_space") || inputs.has("decomposition") ||
                         inputs.has("m") || inputs.has("bin_rule") ||
                         inputs.has("weights");
    image::Profile profile = defaults;
    profile.name = name;
    if (changed) profile.calibration.reset();
    if (const auto said = inputs.text("name"); said && *said != name)
        inputs.refuse("name", "is not the name in the address, '" + name + "'");
    if (const auto word = inputs.one_of("color_space", kColorSpaces))
        profile.kind.color_space = image::color_space_from_name(*word).value();
    if (const auto word = inputs.one_of("decomposition", kDecompositions))
        profile.kind.decomposition = image::decomposition_from_name(*word).value();
    if (const auto m = inputs.integer("m", 1, image::kMaxCoefficients))
        profile.m = static_cast<int>(*m);
    if (const auto word = inputs.one_of("bin_rule", kBinRules))
        profile.bin_rule = image::bin_rule_from_name(*word).value();
    if (const auto weights = inputs.member("weights"))
        profile.weights = WeightsReader(inputs).read(*weights).value_or(profile.weights);
    if (const auto calibration = inputs.member("calibration")) {
        profile.calibration.reset();
        if (!calibration->is_null())
            profile.calibration = read_calibration(inputs, *calibration);
    }
    return profile;
}

}  // namespace haarmony::server
