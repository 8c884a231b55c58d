#include "server/api/picture_format.h"

#include <algorithm>
#include <charconv>
#include <string>

#include "server/http/header_value.h"

namespace haarmony::server {
namespace {

struct Range {
    std::string type;
    double quality = 1;
};

// Nothing for an element that is malformed: it is as if it were not there.
std::optional<Range> range_of(std::string_view element) {
    const auto value = http::parse_parameterized(element);
    if (!value) return {};
    Range range{http::lower_case(value->value), 1};
    for (const auto& [name, text] : value->parameters) {
        if (name != "q") continue;
        const auto [end, error] =
            std::from_chars(text.data(), text.data() + text.size(), range.quality);
        if (error != std::errc{} || end != text.data() + text.size()) return {};
    }
    return range;
}

// 3 for the type itself, 2 for all of its kind, 1 for all; 0: another.
int nearness(std::string_view range, std::string_view type) {
    if (range == type) return 3;
    if (range == "*/*") return 1;
    const std::string_view kind = type.substr(0, type.find('/') + 1);
    return range.ends_with("/*") && range.substr(0, range.size() - 1) == kind ? 2 : 0;
}

}  // namespace

PictureFormat accepted_format(std::string_view accept) {
    PictureFormat best = PictureFormat::kPng;
    double best_quality = 0;
    for (std::size_t i = 0; i < kPictureFormats.size(); ++i) {
        const auto format = static_cast<PictureFormat>(i);
        double quality = 0;
        int nearest = 0;
        for (const std::string_view element : http::split_list(accept)) {
            const auto range = range_of(element);
            if (!range) continue;
            const int near = nearness(range->type, media_type_of(format));
            if (near <= nearest) continue;
            nearest = near;
            quality = range->quality;
        }
        if (quality > best_quality) {
            best = format;
            best_quality = quality;
        }
    }
    return best;
}

PictureFormat read_picture_format(Inputs& inputs, std::string_view accept) {
    const auto named = inputs.one_of("format", kPictureFormats);
    if (!named) return accepted_format(accept);
    const auto at = std::find(kPictureFormats.begin(), kPictureFormats.end(), *named);
    // Another word is refused already.
    if (at == kPictureFormats.end()) return PictureFormat::kPng;
    return static_cast<PictureFormat>(at - kPictureFormats.begin());
}

std::optional<video::Rgba> read_background(Inputs& inputs) {
    const auto text = inputs.text("background");
    if (!text) return {};
    std::string_view digits = *text;
    if (digits.starts_with('#')) digits.remove_prefix(1);
    unsigned value = 0;
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    if (digits.size() != 6 || error != std::errc{} ||
        end != digits.data() + digits.size()) {
        inputs.refuse("background", "is not #rrggbb");
        return {};
    }
    return video::Rgba{static_cast<std::uint8_t>(value >> 16),
                       static_cast<std::uint8_t>(value >> 8),
                       static_cast<std::uint8_t>(value),
                       255};
}

}  // namespace haarmony::server
