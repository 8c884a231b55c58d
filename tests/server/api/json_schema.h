// A small validator of JSON Schema 2020-12, as far as schema/openapi.yaml uses it.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace haarmony::server {

// The first place where `value` breaks `schema`, or nothing. References are looked up in
// `document`. Throws std::runtime_error for a keyword that it does not know.
[[nodiscard]] std::optional<std::string> violation(const nlohmann::json& value,
                                                   const nlohmann::json& schema,
                                                   const nlohmann::json& document,
                                                   const std::string& at = "");

}  // namespace haarmony::server
