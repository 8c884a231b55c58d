// Rows of numbers in JSON, read and written: points of curves, details, grids.
//
// Shape    [[x, y], ...], 1 to 8 numbers a row, all rows alike; numbers are written in the
//          fewest digits that name the same double.
// Errors   400 what has another type; 422 what no curve can have: rows of different length, a
//          number beyond curve::kLargestCoordinate, too many rows. `param` is the place of the
//          bad value: "points[3][1]".
// Threads  values.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/curve/points.h"
#include "server/api/outcome.h"

namespace haarmony::server {

// 422: well-formed, but nothing that there can be.
[[nodiscard]] http::Problem impossible(std::string_view code,
                                       std::string detail,
                                       std::string_view param);
// Of an argument that the engine refused.
[[nodiscard]] http::Problem impossible(const Error& error);
// 400: of the wrong type, contradictory, or missing.
[[nodiscard]] http::Problem malformed(std::string detail, std::string_view param);

// A value as a detail quotes it: cut short.
[[nodiscard]] std::string shown_json(const nlohmann::json& value);
[[nodiscard]] std::string number_text(double value);

// No rows are Points without a dimension.
[[nodiscard]] Outcome<curve::Points> read_points(const nlohmann::json& value,
                                                 std::string_view place,
                                                 std::size_t most);
[[nodiscard]] Outcome<std::vector<double>> read_numbers(const nlohmann::json& value,
                                                        std::string_view place,
                                                        std::size_t most);

void append_number(std::string& out, double value);
void append_numbers(std::string& out, std::span<const double> numbers);
void append_points(std::string& out, const curve::Points& points);
[[nodiscard]] std::string points_text(const curve::Points& points);
[[nodiscard]] std::string numbers_text(std::span<const double> numbers);

}  // namespace haarmony::server
