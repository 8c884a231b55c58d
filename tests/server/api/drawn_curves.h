// Curves of a test's own, as JSON, and what a refusal of one says.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "tests/server/api/interface.h"

namespace haarmony::server {

// So many points of numbers below 1000, the same for a seed.
[[nodiscard]] nlohmann::json random_points(std::size_t count,
                                           int dimension,
                                           unsigned seed);

// The largest difference of numbers at the same places; infinite where the shapes differ.
[[nodiscard]] double difference(const nlohmann::json& a, const nlohmann::json& b);

// The object with members replaced or added.
[[nodiscard]] nlohmann::json with(nlohmann::json object, const nlohmann::json& members);

// The reply to a request that is to be answered with 200.
[[nodiscard]] nlohmann::json answer(Interface& interface,
                                    const std::string& target,
                                    const nlohmann::json& body);

}  // namespace haarmony::server
