#include "server/api/attributes.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "server/http/header_value.h"

namespace haarmony::server {
namespace {

bool has_control_character(std::string_view text) {
    return std::any_of(text.begin(), text.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte < 0x20 || byte == 0x7f;
    });
}

bool is_tag(std::string_view tag) {
    return !tag.empty() && tag.size() <= kMaxTagBytes &&
           tag.find(',') == std::string_view::npos && !has_control_character(tag);
}

std::optional<std::string> read_uri(Inputs& inputs) {
    std::optional<std::string> uri = inputs.text("uri");
    if (!uri) return {};
    if (uri->size() <= kMaxUriBytes && !has_control_character(*uri)) return uri;
    inputs.refuse("uri",
                  "is longer than " + std::to_string(kMaxUriBytes) +
                      " bytes or has control characters");
    return {};
}

std::optional<std::string> read_metadata(Inputs& inputs) {
    const std::optional<nlohmann::json> metadata = inputs.object("metadata");
    if (!metadata) return {};
    std::string text = metadata->dump();
    if (text.size() <= kMaxMetadataBytes) return text;
    inputs.refuse("metadata",
                  "is longer than " + std::to_string(kMaxMetadataBytes) + " bytes");
    return {};
}

}  // namespace

std::optional<std::vector<std::string>> read_tags(Inputs& inputs) {
    std::optional<std::vector<std::string>> given = inputs.strings("tags");
    if (!given) return {};
    std::vector<std::string> tags;
    for (const std::string& tag : *given) tags.emplace_back(http::trim(tag));
    if (tags.size() <= kMaxTags && std::all_of(tags.begin(), tags.end(), is_tag))
        return tags;
    inputs.refuse("tags",
                  "is not a list of at most " + std::to_string(kMaxTags) +
                      " tags of 1 to " + std::to_string(kMaxTagBytes) +
                      " bytes without commas and control characters");
    return {};
}

GivenAttributes read_attributes(Inputs& inputs) {
    return {read_uri(inputs), read_tags(inputs), read_metadata(inputs)};
}

}  // namespace haarmony::server
