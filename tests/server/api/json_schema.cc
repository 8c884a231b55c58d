#include "tests/server/api/json_schema.h"

#include <algorithm>
#include <regex>
#include <set>
#include <stdexcept>

namespace haarmony::server {
namespace {

using nlohmann::json;
using Violation = std::optional<std::string>;

bool has_type(const json& value, const std::string& type) {
    if (type == "null") return value.is_null();
    if (type == "boolean") return value.is_boolean();
    if (type == "integer") return value.is_number_integer();
    if (type == "number") return value.is_number();
    if (type == "string") return value.is_string();
    if (type == "array") return value.is_array();
    if (type == "object") return value.is_object();
    throw std::runtime_error("unknown type " + type);
}

bool is_annotation(const std::string& keyword) {
    static const std::set<std::string> annotations{
        "description", "default", "format", "contentEncoding", "summary"};
    return annotations.contains(keyword);
}

Violation check_members(const json& value,
                        const json& schema,
                        const json& document,
                        const std::string& at) {
    const json properties = schema.value("properties", json::object());
    for (const auto& [name, member] : value.items()) {
        const std::string here = at + "/" + name;
        if (properties.contains(name)) {
            if (Violation found = violation(member, properties[name], document, here))
                return found;
        } else if (schema.value("additionalProperties", json(true)) == false) {
            return here + " is not described";
        }
    }
    return {};
}

Violation check_keyword(const json& value,
                        const std::string& keyword,
                        const json& rule,
                        const json& schema,
                        const json& document,
                        const std::string& at) {
    const auto broken = [&]() -> Violation {
        return at + " = " + value.dump().substr(0, 100) + " breaks " + keyword + " " +
               rule.dump();
    };
    const auto holds = [&](bool applies, auto&& test) -> Violation {
        return applies && !test() ? broken() : std::nullopt;
    };
    if (is_annotation(keyword)) return {};
    if (keyword == "type") {
        const json types = rule.is_array() ? rule : json::array({rule});
        return std::any_of(types.begin(),
                           types.end(),
                           [&](const json& type) { return has_type(value, type); })
                   ? std::nullopt
                   : broken();
    }
    if (keyword == "enum")
        return std::find(rule.begin(), rule.end(), value) != rule.end() ? std::nullopt
                                                                        : broken();
    if (keyword == "$ref") {
        const std::string pointer = rule.get<std::string>().substr(1);
        return violation(value, document.at(json::json_pointer(pointer)), document, at);
    }
    if (keyword == "oneOf") {
        const auto fits = [&](const json& one) {
            return !violation(value, one, document, at);
        };
        return std::count_if(rule.begin(), rule.end(), fits) == 1 ? std::nullopt
                                                                  : broken();
    }
    if (keyword == "minimum")
        return holds(value.is_number(), [&] { return value >= rule; });
    if (keyword == "maximum")
        return holds(value.is_number(), [&] { return value <= rule; });
    if (keyword == "minLength")
        return holds(value.is_string(),
                     [&] { return value.get<std::string>().size() >= rule; });
    if (keyword == "maxLength")
        return holds(value.is_string(),
                     [&] { return value.get<std::string>().size() <= rule; });
    if (keyword == "pattern")
        return holds(value.is_string(), [&] {
            return std::regex_search(value.get<std::string>(),
                                     std::regex(rule.get<std::string>()));
        });
    if (keyword == "minItems")
        return holds(value.is_array(), [&] { return value.size() >= rule; });
    if (keyword == "maxItems")
        return holds(value.is_array(), [&] { return value.size() <= rule; });
    if (keyword == "required") {
        if (!value.is_object()) return {};
        for (const json& name : rule)
            if (!value.contains(name.get<std::string>()))
                return at + " lacks " + name.get<std::string>();
        return {};
    }
    if (keyword == "items") {
        if (!value.is_array()) return {};
        for (std::size_t i = 0; i < value.size(); ++i)
            if (Violation found =
                    violation(value[i], rule, document, at + "/" + std::to_string(i)))
                return found;
        return {};
    }
    if (keyword == "properties" || keyword == "additionalProperties")
        return value.is_object() ? check_members(value, schema, document, at)
                                 : std::nullopt;
    throw std::runtime_error("unknown keyword " + keyword);
}

}  // namespace

Violation violation(const json& value,
                    const json& schema,
                    const json& document,
                    const std::string& at) {
    for (const auto& [keyword, rule] : schema.items())
        if (Violation found = check_keyword(value, keyword, rule, schema, document, at))
            return found;
    return {};
}

}  // namespace haarmony::server
