#include "tests/server/api/drawn_curves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace haarmony::server {

using nlohmann::json;

json random_points(std::size_t count, int dimension, unsigned seed) {
    std::mt19937 random(seed);
    json points = json::array();
    for (std::size_t i = 0; i < count; ++i) {
        json point = json::array();
        for (int k = 0; k < dimension; ++k)
            point.push_back(static_cast<double>(random() % 1000000) / 1e3);
        points.push_back(std::move(point));
    }
    return points;
}

double difference(const json& a, const json& b) {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    if (a.is_number() && b.is_number())
        return std::abs(a.get<double>() - b.get<double>());
    if (!a.is_array() || !b.is_array() || a.size() != b.size()) return kInfinite;
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        largest = std::max(largest, difference(a[i], b[i]));
    return largest;
}

json with(json object, const json& members) {
    object.update(members);
    return object;
}

json answer(Interface& interface, const std::string& target, const json& body) {
    const http::Response response = interface.post_json(target, body);
    EXPECT_EQ(response.status, 200) << target << " " << body_of(response);
    return json_of(response);
}

}  // namespace haarmony::server
