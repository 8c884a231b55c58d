#include "server/api/inputs.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "server/http/json.h"
#include "server/http/multipart.h"
#include "server/http/target.h"

namespace haarmony::server {
namespace {

using nlohmann::json;
using MaybeProblem = std::optional<http::Problem>;

constexpr std::size_t kShownBytes = 80;

// The value as a complaint quotes it.
std::string shown(const json& value) {
    std::string text = value.is_string()
                           ? value.get<std::string>()
                           : value.dump(-1, ' ', false, json::error_handler_t::replace);
    if (text.size() > kShownBytes) text = text.substr(0, kShownBytes) + "...";
    return text;
}

http::Problem bad_value(std::string_view name, std::string detail) {
    return {400, "invalid_argument", std::move(detail), std::string(name), {}};
}

// "image/png; x=y" -> "image/png", in lower case.
std::string media_type(std::string_view content_type) {
    std::string type(content_type.substr(0, content_type.find(';')));
    while (!type.empty() && (type.back() == ' ' || type.back() == '\t')) type.pop_back();
    std::transform(type.begin(), type.end(), type.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return type;
}

std::optional<double> parse_number(std::string_view text) {
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end || !std::isfinite(value)) return {};
    return value;
}

std::vector<std::string> split_at_commas(std::string_view text) {
    std::vector<std::string> pieces;
    for (;;) {
        const std::size_t comma = text.find(',');
        pieces.emplace_back(text.substr(0, comma));
        if (comma == std::string_view::npos) return pieces;
        text.remove_prefix(comma + 1);
    }
}

std::string number_text(double value) { return json(value).dump(); }

}  // namespace

std::optional<std::int64_t> parse_integer(std::string_view text) {
    std::int64_t value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end) return {};
    return value;
}

Outcome<Inputs> Inputs::of_query(const http::Request& request) {
    Inputs inputs;
    if (MaybeProblem problem = inputs.add_query(request)) return *std::move(problem);
    return inputs;
}

Outcome<Inputs> Inputs::of_request(const http::Request& request) {
    Inputs inputs;
    if (MaybeProblem problem = inputs.add_query(request)) return *std::move(problem);
    if (MaybeProblem problem = inputs.add_body(request)) return *std::move(problem);
    return inputs;
}

Outcome<Inputs> Inputs::of_object(json object) {
    Inputs inputs;
    if (MaybeProblem problem = inputs.add_object(std::move(object)))
        return *std::move(problem);
    return inputs;
}

MaybeProblem Inputs::add(const std::string& name, Input input) {
    if (inputs_.emplace(name, std::move(input)).second) return {};
    return http::Problem{400,
                         "repeated_parameter",
                         "'" + shown(name) + "' is given more than once",
                         name,
                         {}};
}

MaybeProblem Inputs::add_query(const http::Request& request) {
    for (const auto& [name, value] : request.query)
        if (MaybeProblem problem = add(name, {value, true, false})) return problem;
    return {};
}

MaybeProblem Inputs::add_body(const http::Request& request) {
    if (request.body.empty()) return {};
    const std::string_view content_type = request.header("Content-Type");
    const std::string type = media_type(content_type);
    if (type.starts_with("image/")) {
        picture_ = request.body;
        return {};
    }
    if (type == "application/json") return add_json(request.body);
    if (type == "multipart/form-data") return add_multipart(request);
    const std::string what = type.empty() ? std::string("without a Content-Type")
                                          : "of type '" + shown(type) + "'";
    return http::Problem{415,
                         "unsupported_media_type",
                         "a body " + what +
                             " is not read; send image/*, multipart/form-data or "
                             "application/json",
                         "Content-Type",
                         {}};
}

MaybeProblem Inputs::add_json(const std::string& body) {
    Result<json> parsed = http::parse_json(body);
    if (!parsed) {
        http::Problem problem = http::problem_of(parsed.error());
        if (!problem.param.empty()) problem.code = kNotFinite;
        return problem;
    }
    return add_object(std::move(parsed).value());
}

MaybeProblem Inputs::add_object(json object) {
    if (!object.is_object())
        return http::Problem{
            400, "invalid_argument", "the JSON body must be an object", "", {}};
    for (auto& [name, value] : object.items())
        if (MaybeProblem problem = add(name, {std::move(value), false, false}))
            return problem;
    return {};
}

MaybeProblem Inputs::add_multipart(const http::Request& request) {
    Result<std::vector<http::Part>> parts =
        http::parse_multipart(request.header("Content-Type"), request.body);
    if (!parts) return http::problem_of(parts.error());
    for (const http::Part& part : parts.value()) {
        if (part.name != "file") {
            if (!http::is_utf8(part.body)) return bad_value(part.name, "not UTF-8");
            if (MaybeProblem problem =
                    add(part.name, {std::string(part.body), true, false}))
                return problem;
            continue;
        }
        // Noted under its name too, so that a second one is a repetition.
        if (MaybeProblem problem = add(part.name, {"", true, true})) return problem;
        picture_ = part.body;
    }
    return {};
}

const Inputs::Input* Inputs::find(std::string_view name) const {
    const auto found = inputs_.find(name);
    return found == inputs_.end() ? nullptr : &found->second;
}

const Inputs::Input* Inputs::take(std::string_view name) {
    const auto found = inputs_.find(name);
    if (found == inputs_.end()) return nullptr;
    found->second.known = true;
    return &found->second;
}

bool Inputs::has(std::string_view name) const { return find(name) != nullptr; }

bool Inputs::is_text(std::string_view name) const {
    const Input* input = find(name);
    return input != nullptr && input->is_text;
}

void Inputs::refuse(http::Problem problem) {
    if (!problem_) problem_ = std::move(problem);
}

void Inputs::refuse(std::string_view name, std::string_view complaint) {
    const Input* input = find(name);
    const std::string value = input == nullptr ? "" : " '" + shown(input->value) + "'";
    refuse(bad_value(name, std::string(name) + value + " " + std::string(complaint)));
}

std::optional<http::Problem> Inputs::refused() const {
    if (problem_) return problem_;
    for (const auto& [name, input] : inputs_)
        if (!input.known)
            return http::Problem{400,
                                 "unknown_parameter",
                                 "'" + shown(name) + "' is not known here",
                                 name,
                                 {}};
    return {};
}

std::optional<std::int64_t> Inputs::integer(std::string_view name,
                                            std::int64_t least,
                                            std::int64_t most) {
    const Input* input = take(name);
    if (input == nullptr) return {};
    std::optional<std::int64_t> value;
    if (input->is_text) {
        value = parse_integer(input->value.get_ref<const std::string&>());
    } else if (input->value.is_number_unsigned()) {
        const auto number = input->value.get<std::uint64_t>();
        if (number <= static_cast<std::uint64_t>(most))
            value = static_cast<std::int64_t>(number);
    } else if (input->value.is_number_integer()) {
        value = input->value.get<std::int64_t>();
    }
    if (value && *value >= least && *value <= most) return value;
    refuse(name,
           "is not a whole number from " + std::to_string(least) + " to " +
               std::to_string(most));
    return {};
}

std::optional<double> Inputs::number(std::string_view name, double least, double most) {
    const Input* input = take(name);
    if (input == nullptr) return {};
    std::optional<double> value;
    if (input->is_text) {
        value = parse_number(input->value.get_ref<const std::string&>());
    } else if (input->value.is_number()) {
        value = input->value.get<double>();
    }
    if (value && *value >= least && *value <= most) return value;
    refuse(name,
           "is not a number from " + number_text(least) + " to " + number_text(most));
    return {};
}

std::optional<bool> Inputs::boolean(std::string_view name) {
    const Input* input = take(name);
    if (input == nullptr) return {};
    if (input->value.is_boolean()) return input->value.get<bool>();
    if (input->is_text && input->value == "true") return true;
    if (input->is_text && input->value == "false") return false;
    refuse(name, "is neither true nor false");
    return {};
}

std::optional<std::string> Inputs::text(std::string_view name) {
    const Input* input = take(name);
    if (input == nullptr) return {};
    if (input->value.is_string()) return input->value.get<std::string>();
    refuse(name, "is not a string");
    return {};
}

std::optional<std::string> Inputs::one_of(std::string_view name,
                                          std::span<const std::string_view> words) {
    std::optional<std::string> value = text(name);
    if (!value || std::find(words.begin(), words.end(), *value) != words.end())
        return value;
    std::string list;
    for (const std::string_view word : words)
        list += (list.empty() ? "" : ", ") + std::string(word);
    refuse(name, "is none of: " + list);
    return {};
}

std::optional<std::vector<std::string>> Inputs::strings(std::string_view name) {
    const Input* input = take(name);
    if (input == nullptr) return {};
    json value = input->value;
    if (value.is_string()) {
        const auto& text = value.get_ref<const std::string&>();
        if (text.empty()) return std::vector<std::string>{};
        if (!text.starts_with('[')) return split_at_commas(text);
        Result<json> parsed = http::parse_json(text);
        value = parsed ? std::move(parsed).value() : json();
    }
    const auto is_string = [](const json& element) { return element.is_string(); };
    if (value.is_array() && std::all_of(value.begin(), value.end(), is_string))
        return value.get<std::vector<std::string>>();
    refuse(name, "is not a list of strings");
    return {};
}

std::optional<json> Inputs::object(std::string_view name) {
    const Input* input = take(name);
    if (input == nullptr) return {};
    json value = input->value;
    if (input->is_text) {
        Result<json> parsed = http::parse_json(value.get_ref<const std::string&>());
        value = parsed ? std::move(parsed).value() : json();
    }
    if (value.is_object()) return value;
    refuse(name, "is not a JSON object");
    return {};
}

std::optional<json> Inputs::any(std::string_view name) {
    const Input* input = take(name);
    if (input == nullptr) return {};
    return input->value;
}

const json* Inputs::peek(std::string_view name) {
    const Input* input = take(name);
    if (input == nullptr) return nullptr;
    if (!input->is_text) return &input->value;
    refuse(name, "can only be a member of a JSON body");
    return nullptr;
}

std::optional<json> Inputs::member(std::string_view name) {
    const json* value = peek(name);
    return value == nullptr ? std::optional<json>() : std::optional<json>(*value);
}

}  // namespace haarmony::server
