#include "server/api/query_source.h"

#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "server/api/base64.h"
#include "server/api/signature_json.h"
#include "server/api/strokes_json.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 5> kQuerySources{"image",
                                                        "id",
                                                        "signature",
                                                        "strokes",
                                                        "url"};
constexpr std::array<std::string_view, 2> kPictureSources{"image", "url"};

// The name of the only source that is there ("" for the body's picture); a problem in
// `inputs` if there is none or more than one.
std::optional<std::string_view> only_source(Inputs& inputs,
                                            std::span<const std::string_view> names) {
    std::vector<std::string_view> given;
    if (inputs.picture()) given.emplace_back("");
    for (const std::string_view name : names)
        if (inputs.has(name)) given.push_back(name);
    if (given.size() == 1) return given.front();

    std::string list = "a picture in the body";
    for (const std::string_view name : names) list += ", " + std::string(name);
    if (given.empty()) {
        inputs.refuse(http::Problem{
            400, "no_source", "nothing to work on: send one of " + list, "", {}});
    } else {
        inputs.refuse(http::Problem{400,
                                    "several_sources",
                                    "more than one source is given: send one of " + list,
                                    std::string(given.back()),
                                    {}});
    }
    // All of them are known, whatever else is wrong.
    for (const std::string_view name : names) (void)inputs.any(name);
    return {};
}

template <typename T>
std::optional<T> keep(Inputs& inputs, std::string_view name, Outcome<T> outcome) {
    if (outcome) return *std::move(outcome);
    http::Problem problem = outcome.problem();
    if (problem.param.empty()) problem.param = name;
    inputs.refuse(std::move(problem));
    return {};
}

std::optional<SourceBytes> read_image(Inputs& inputs) {
    const std::optional<json> text = inputs.member("image");
    if (!text) return {};
    if (!text->is_string()) {
        inputs.refuse("image", "is not a string of base64");
        return {};
    }
    std::optional<std::string> bytes = keep<std::string>(
        inputs, "image", decode_base64(text->get_ref<const std::string&>()));
    if (!bytes) return {};
    return SourceBytes(*std::move(bytes));
}

std::optional<SourceBytes> read_body(Inputs& inputs) {
    if (!inputs.picture()->empty()) return SourceBytes(*inputs.picture());
    inputs.refuse(
        http::Problem{400, "no_source", "the picture has no bytes", "file", {}});
    return {};
}

std::optional<SourceUrl> read_url(Inputs& inputs) {
    std::optional<std::string> url = inputs.text("url");
    if (!url) return {};
    return SourceUrl{*std::move(url)};
}

template <typename To, typename From>
std::optional<To> widen(std::optional<From> value) {
    if (!value) return {};
    return To(*std::move(value));
}

}  // namespace

std::optional<QuerySource> read_query_source(Inputs& inputs) {
    const std::optional<std::string_view> name = only_source(inputs, kQuerySources);
    if (!name) return {};
    if (name->empty()) return widen<QuerySource>(read_body(inputs));
    if (*name == "image") return widen<QuerySource>(read_image(inputs));
    if (*name == "url") return widen<QuerySource>(read_url(inputs));
    if (*name == "id") {
        const auto id = inputs.integer("id", 1, std::numeric_limits<std::int64_t>::max());
        return id ? std::optional<QuerySource>(ImageId{*id}) : std::nullopt;
    }
    if (*name == "strokes") {
        const std::optional<json> value = inputs.member("strokes");
        if (!value) return {};
        return widen<QuerySource>(keep(inputs, *name, parse_strokes(*value)));
    }
    return widen<QuerySource>(keep(
        inputs,
        *name,
        Outcome<image::Signature>(parse_signature(inputs.any("signature").value()))));
}

std::optional<std::variant<SourceBytes, SourceUrl>> read_picture_source(Inputs& inputs) {
    using Source = std::variant<SourceBytes, SourceUrl>;
    const std::optional<std::string_view> name = only_source(inputs, kPictureSources);
    if (!name) return {};
    if (name->empty()) return widen<Source>(read_body(inputs));
    if (*name == "image") return widen<Source>(read_image(inputs));
    return widen<Source>(read_url(inputs));
}

std::span<const std::uint8_t> view_of(const SourceBytes& bytes) {
    const std::string_view view =
        std::visit([](const auto& text) { return std::string_view(text); }, bytes);
    return {reinterpret_cast<const std::uint8_t*>(view.data()), view.size()};
}

}  // namespace haarmony::server
