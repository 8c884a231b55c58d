#include "server/api/explanation_json.h"

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "engine/image/color_space.h"
#include "engine/image/explain.h"
#include "ingest/thumbnail.h"
#include "server/api/base64.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

constexpr int kQuality = 85;
constexpr double kHundredths = 100.0;
constexpr double kAverageUnit = image::kAverageOne;

json channel_json(const image::ExplainedChannel& channel, std::string_view name) {
    json bins = json::array();
    for (std::size_t b = 1; b < channel.bins.size(); ++b) {
        const image::ExplainedBin& bin = channel.bins[b];
        bins.push_back({{"bin", b},
                        {"weight", bin.weight / kHundredths},
                        {"matched", bin.matched},
                        {"missed", bin.missed}});
    }
    return {{"channel", name},
            {"average",
             {{"query", channel.query_average / kAverageUnit},
              {"target", channel.target_average / kAverageUnit},
              {"weight", channel.bins[0].weight / kHundredths}}},
            {"distance",
             static_cast<double>(channel.distance()) / (kHundredths * kAverageUnit)},
            {"bins", std::move(bins)},
            {"matched", channel.matched},
            {"missed", channel.missed}};
}

}  // namespace

Result<json> explanation_json(const image::Signature& query,
                              const image::Signature& target,
                              const image::Profile& profile,
                              int m) {
    const image::Explanation explanation = image::explain(query, target, profile, m);
    json channels = json::array();
    for (int c = 0; c < image::kChannels; ++c) {
        const std::string_view name = image::channel_name(profile.kind.color_space, c);
        channels.push_back(channel_json(explanation[static_cast<std::size_t>(c)], name));
    }
    const std::vector<std::uint8_t> drawing = image::draw_matches(query, explanation);
    const auto jpeg = ingest::encode_jpeg({drawing.data(),
                                           image::kDrawingWidth,
                                           image::kSide,
                                           1,
                                           std::ptrdiff_t{image::kDrawingWidth}},
                                          kQuality);
    if (!jpeg) return jpeg.error();
    const std::string_view bytes(reinterpret_cast<const char*>(jpeg->data()),
                                 jpeg->size());
    return json{{"channels", std::move(channels)},
                {"picture", "data:image/jpeg;base64," + encode_base64(bytes)}};
}

}  // namespace haarmony::server
