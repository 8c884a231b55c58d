// Everything that a request says, by name, wherever it says it: query parameters, members
// of a JSON body, fields of a multipart body; and the picture, if the body carries one.
//
//   http::Request -> [inputs] -> query_options, query_source, image_upload, ...
//
// A handler asks for what it knows, by name and type, and then for refused(): the first
// thing that was wrong, or a name that nobody asked for.
//
// Shape   a name comes once, in one place: more is refused. Text is parsed, JSON must have
//         the right type ("20" is no number there).
// Errors  400 naming the parameter; 415 for a body of a type that is not read.
// Threads a value; keeps views into the request, which must outlive it.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/api/outcome.h"
#include "server/http/message.h"
#include "server/http/problem.h"

namespace haarmony::server {

// The problem code of a number in JSON that is not finite.
inline constexpr std::string_view kNotFinite = "not_finite";

class Inputs {
  public:
    // The query parameters and the body, by its Content-Type.
    [[nodiscard]] static Outcome<Inputs> of_request(const http::Request& request);
    // The query parameters alone.
    [[nodiscard]] static Outcome<Inputs> of_query(const http::Request& request);
    // The members of a JSON object that is part of a body.
    [[nodiscard]] static Outcome<Inputs> of_object(nlohmann::json object);

    // The body of an image/* request or the multipart part "file"; nothing if there is
    // neither, or no body at all.
    [[nodiscard]] std::optional<std::string_view> picture() const { return picture_; }

    // Each gives nothing where the name is absent or wrong; refused() tells which.
    [[nodiscard]] std::optional<std::int64_t> integer(std::string_view name,
                                                      std::int64_t least,
                                                      std::int64_t most);
    [[nodiscard]] std::optional<double> number(std::string_view name,
                                               double least,
                                               double most);
    [[nodiscard]] std::optional<bool> boolean(std::string_view name);
    [[nodiscard]] std::optional<std::string> text(std::string_view name);
    [[nodiscard]] std::optional<std::string> one_of(
        std::string_view name,
        std::span<const std::string_view> words);
    // Text: separated by commas, or a JSON array; JSON: an array of strings, or that text.
    [[nodiscard]] std::optional<std::vector<std::string>> strings(std::string_view name);
    // Text: a JSON object; JSON: an object.
    [[nodiscard]] std::optional<nlohmann::json> object(std::string_view name);
    // A JSON member of any type; text is a JSON string here.
    [[nodiscard]] std::optional<nlohmann::json> any(std::string_view name);
    // Only a JSON member: text is refused.
    [[nodiscard]] std::optional<nlohmann::json> member(std::string_view name);
    // The same where it lies, for what would be long to copy; null where it is absent.
    [[nodiscard]] const nlohmann::json* peek(std::string_view name);

    [[nodiscard]] bool has(std::string_view name) const;
    // Whether the input came as text, without a JSON type.
    [[nodiscard]] bool is_text(std::string_view name) const;

    // Notes a problem that a handler found in `name`; the first one counts.
    void refuse(http::Problem problem);
    void refuse(std::string_view name, std::string_view complaint);

    // The first problem, if any. Every known name must have been asked for.
    [[nodiscard]] std::optional<http::Problem> refused() const;

  private:
    struct Input {
        nlohmann::json value;
        bool is_text = false;
        bool known = false;
    };

    [[nodiscard]] std::optional<http::Problem> add(const std::string& name, Input input);
    [[nodiscard]] std::optional<http::Problem> add_query(const http::Request& request);
    [[nodiscard]] std::optional<http::Problem> add_body(const http::Request& request);
    [[nodiscard]] std::optional<http::Problem> add_json(const std::string& body);
    [[nodiscard]] std::optional<http::Problem> add_object(nlohmann::json object);
    [[nodiscard]] std::optional<http::Problem> add_multipart(
        const http::Request& request);
    [[nodiscard]] const Input* find(std::string_view name) const;
    [[nodiscard]] const Input* take(std::string_view name);

    std::map<std::string, Input, std::less<>> inputs_;
    std::optional<std::string_view> picture_;
    std::optional<http::Problem> problem_;
};

// A strict whole number, as in "/images/12": digits only, no sign but '-', no spaces.
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view text);

}  // namespace haarmony::server
