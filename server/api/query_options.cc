#include "server/api/query_options.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "engine/image/profile.h"
#include "server/api/attributes.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

constexpr std::int64_t kMaxLimit = 1000;
constexpr std::size_t kMaxSeqBytes = 256;
constexpr std::size_t kMaxCombined = 8;
constexpr std::size_t kMaxTextBytes = 1024;
constexpr std::array<std::string_view, 2> kMasks{"alpha", "none"};
constexpr std::array<std::string_view, 3> kOrientations{"none", "mirror", "all"};
constexpr std::array<std::string_view, 2> kCombineBy{"mean", "worst"};
constexpr std::array<std::string_view, 3> kKinds{"image", "frame", "all"};

QueryKind read_kind(Inputs& inputs) {
    const std::string word = inputs.one_of("kind", kKinds).value_or("image");
    if (word == "frame") return QueryKind::kFrame;
    return word == "all" ? QueryKind::kAll : QueryKind::kImage;
}

// Frames have no metadata and no borders, and ranks of two collections have no order.
void refuse_for_frames(Inputs& inputs, const QueryOptions& options) {
    if (options.kind == QueryKind::kImage) return;
    for (const std::string_view name : {"text", "tags"})
        if (inputs.has(name)) inputs.refuse(name, "does not apply to frames");
    if (options.explain) inputs.refuse("explain", "is not there for frames");
    if (options.kind == QueryKind::kAll && options.search.plan.combine)
        inputs.refuse("combine", "ranks images or frames, not both together");
}

std::optional<image::Profile> find_profile(const Context& context,
                                           Inputs& inputs,
                                           std::string_view param,
                                           const std::string& name) {
    Result<image::Profile> profile = context.images.profile(name);
    if (profile) return std::move(profile).value();
    http::Problem problem = http::problem_of(profile.error());
    if (profile.error().code == ErrorCode::kNotFound) {
        problem.status = 400;
        problem.code = "unknown_profile";
        problem.detail = "there is no profile '" + name + "'";
    }
    problem.param = param;
    inputs.refuse(std::move(problem));
    return {};
}

// The names under "combine", or the one under "profile".
std::vector<std::string> profile_names(Inputs& inputs) {
    const std::optional<std::string> single = inputs.text("profile");
    std::optional<std::vector<std::string>> combined = inputs.strings("combine");
    if (!combined) return {single.value_or("painted")};
    if (combined->empty() || combined->size() > kMaxCombined)
        inputs.refuse("combine",
                      "names " + std::to_string(combined->size()) +
                          " profiles, not 1 to " + std::to_string(kMaxCombined));
    if (single && (combined->empty() || combined->front() != *single))
        inputs.refuse("profile",
                      "is '" + *single + "', and 'combine' starts with another one");
    std::vector<std::string> sorted = *combined;
    std::ranges::sort(sorted);
    const auto twice = std::ranges::adjacent_find(sorted);
    if (twice != sorted.end()) inputs.refuse("combine", "names '" + *twice + "' twice");
    return *std::move(combined);
}

void read_profiles(const Context& context, Inputs& inputs, QueryOptions& options) {
    options.search.plan.combine = inputs.has("combine");
    const std::string_view param = options.search.plan.combine ? "combine" : "profile";
    options.look.kinds.clear();
    for (const std::string& name : profile_names(inputs)) {
        auto profile = find_profile(context, inputs, param, name);
        if (!profile) return;
        if (std::ranges::find(options.look.kinds, profile->kind) ==
            options.look.kinds.end())
            options.look.kinds.push_back(profile->kind);
        options.search.plan.profiles.push_back(*std::move(profile));
    }
    options.search.plan.combine_by = inputs.one_of("combine_by", kCombineBy) == "worst"
                                         ? image::CombineBy::kWorst
                                         : image::CombineBy::kMean;
}

Orientations read_orientations(Inputs& inputs) {
    const std::string word =
        inputs.one_of("orientations", kOrientations).value_or("none");
    if (word == "mirror") return Orientations::kMirror;
    return word == "all" ? Orientations::kAll : Orientations::kNone;
}

std::int32_t read_aspect_weight(Inputs& inputs) {
    constexpr double kHundredths = 100.0;
    const double weight =
        inputs.number("aspect_weight", 0, image::kMaxWeight / kHundredths).value_or(0);
    return static_cast<std::int32_t>(std::lround(weight * kHundredths));
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

schema::ImageFilter read_filter(Inputs& inputs) {
    schema::ImageFilter filter;
    filter.text = inputs.text("text").value_or("");
    if (filter.text.size() > kMaxTextBytes)
        inputs.refuse("text",
                      "is longer than " + std::to_string(kMaxTextBytes) + " bytes");
    filter.tags = read_tags(inputs).value_or(std::vector<std::string>{});
    return filter;
}

QueryOptions read_query_options(const Context& context, Inputs& inputs) {
    QueryOptions options;
    PlanOptions& plan = options.search.plan;
    if (const auto limit = inputs.integer("limit", 1, kMaxLimit))
        options.search.limit = static_cast<int>(*limit);
    read_profiles(context, inputs, options);
    if (const auto m = inputs.integer("m", 1, image::kMaxCoefficients))
        plan.m = static_cast<int>(*m);
    plan.min_similarity = inputs.number("min_similarity", 0, 1);
    plan.orientations = read_orientations(inputs);
    plan.aspect_weight = read_aspect_weight(inputs);
    if (inputs.one_of("mask", kMasks) == "none") options.look.mask = Mask::kNone;
    options.look.autocrop = inputs.boolean("autocrop").value_or(false);
    plan.content = options.look.autocrop;
    options.look.partial = inputs.boolean("partial").value_or(false);
    options.look.misregistered = inputs.boolean("misregistered").value_or(false);
    options.search.filter = read_filter(inputs);
    options.explain = inputs.boolean("explain").value_or(false);
    options.seq = read_seq(inputs);
    options.kind = read_kind(inputs);
    refuse_for_frames(inputs, options);
    return options;
}

}  // namespace haarmony::server
