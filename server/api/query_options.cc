#include "server/api/query_options.h"

#include <array>
#include <limits>
#include <string>
#include <utility>

#include "engine/image/profile.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

constexpr std::int64_t kMaxLimit = 1000;
constexpr std::size_t kMaxSeqBytes = 256;
constexpr std::array<std::string_view, 2> kMasks{"alpha", "none"};
constexpr std::array<std::string_view, 3> kOrientations{"none", "mirror", "all"};
constexpr std::array<std::string_view, 3> kKinds{"image", "frame", "all"};

void not_built(Inputs& inputs, std::string_view name, const std::string& what) {
    inputs.refuse(http::Problem{
        400, "not_built", what + " is not built yet", std::string(name), {}});
}

// A word of which only the first is built.
void only_first(Inputs& inputs,
                std::string_view name,
                std::span<const std::string_view> words) {
    const std::optional<std::string> word = inputs.one_of(name, words);
    if (word && *word != words.front())
        not_built(inputs, name, std::string(name) + "=" + *word);
}

void only_false(Inputs& inputs, std::string_view name) {
    if (inputs.boolean(name).value_or(false))
        not_built(inputs, name, std::string(name) + "=true");
}

std::optional<image::Profile> read_profile(Inputs& inputs) {
    const std::string name = inputs.text("profile").value_or("painted");
    std::optional<image::Profile> profile = image::built_in_profile(name);
    if (!profile)
        inputs.refuse(http::Problem{
            400, "unknown_profile", "there is no profile '" + name + "'", "profile", {}});
    return profile;
}

// Numbers and strings come back as they were sent; text has no type, so what reads as a
// whole number is one.
std::optional<json> read_seq(Inputs& inputs) {
    const bool is_text = inputs.is_text("seq");
    std::optional<json> seq = inputs.any("seq");
    if (!seq) return {};
    if (!seq->is_number() && !seq->is_string()) {
        inputs.refuse("seq", "is neither a number nor a string");
        return {};
    }
    if (!seq->is_string()) return seq;
    const auto& text = seq->get_ref<const std::string&>();
    if (text.size() > kMaxSeqBytes) {
        inputs.refuse("seq", "is longer than " + std::to_string(kMaxSeqBytes) + " bytes");
        return {};
    }
    const std::optional<std::int64_t> number = parse_integer(text);
    if (is_text && number) return json(*number);
    return seq;
}

}  // namespace

void refuse_not_built(Inputs& inputs, std::string_view name) {
    if (inputs.any(name)) not_built(inputs, name, std::string(name));
}

QueryOptions read_query_options(Inputs& inputs) {
    QueryOptions options;
    if (const auto limit = inputs.integer("limit", 1, kMaxLimit))
        options.search.limit = static_cast<int>(*limit);
    if (auto profile = read_profile(inputs)) options.search.profile = *std::move(profile);
    if (const auto m = inputs.integer("m", 1, image::kMaxCoefficients))
        options.search.m = static_cast<int>(*m);
    options.search.min_similarity = inputs.number("min_similarity", 0, 1);
    if (inputs.one_of("mask", kMasks) == "none") options.mask = Mask::kNone;
    options.seq = read_seq(inputs);

    only_first(inputs, "orientations", kOrientations);
    only_first(inputs, "kind", kKinds);
    only_false(inputs, "autocrop");
    only_false(inputs, "explain");
    const auto aspect_weight =
        inputs.number("aspect_weight", 0, std::numeric_limits<double>::max());
    if (aspect_weight.value_or(0) > 0)
        not_built(inputs, "aspect_weight", "an aspect_weight above 0");
    for (const std::string_view name : {"combine", "combine_by", "tags", "text"})
        refuse_not_built(inputs, name);
    return options;
}

}  // namespace haarmony::server
