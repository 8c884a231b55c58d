#include "server/api/points_json.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "engine/curve/approximate.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

constexpr std::size_t kShownBytes = 80;

std::string place_of(std::string_view place, std::size_t index) {
    return std::string(place) + '[' + std::to_string(index) + ']';
}

http::Problem not_rows(const json& value, std::string_view place) {
    return malformed(std::string(place) + " '" + shown_json(value) +
                         "' is not an array of points, [[x, y], ...]",
                     place);
}

// The numbers of `row`, a JSON array, to where `out` points.
std::optional<http::Problem> read_row(const json::array_t& row,
                                      std::string_view place,
                                      double* out) {
    for (std::size_t i = 0; i < row.size(); ++i) {
        if (!row[i].is_number())
            return malformed(
                place_of(place, i) + " '" + shown_json(row[i]) + "' is not a number",
                place_of(place, i));
        out[i] = row[i].get<double>();
        if (!(std::abs(out[i]) <= curve::kLargestCoordinate))
            return impossible(
                "out_of_range",
                place_of(place, i) + " '" + shown_json(row[i]) + "' is larger than 1e100",
                place_of(place, i));
    }
    return {};
}

http::Problem too_many(std::string_view place, std::size_t count, std::size_t most) {
    return impossible(
        "too_many_" + std::string(place.substr(0, place.find_first_of(".["))),
        std::string(place) + " has " + std::to_string(count) + " entries, more than " +
            std::to_string(most),
        place);
}

}  // namespace

http::Problem impossible(std::string_view code,
                         std::string detail,
                         std::string_view param) {
    return {422, std::string(code), std::move(detail), std::string(param), {}};
}

http::Problem impossible(const Error& error) {
    if (error.code != ErrorCode::kInvalidArgument && error.code != ErrorCode::kTooLarge)
        return http::problem_of(error);
    return impossible("out_of_range", error.message, error.param);
}

http::Problem malformed(std::string detail, std::string_view param) {
    return {400, "invalid_argument", std::move(detail), std::string(param), {}};
}

std::string shown_json(const json& value) {
    // What is long is not written out to be cut.
    if (value.is_array()) return "an array of " + std::to_string(value.size());
    if (value.is_object()) return "an object of " + std::to_string(value.size());
    std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
    if (text.size() > kShownBytes) text = text.substr(0, kShownBytes) + "...";
    return text;
}

std::string number_text(double value) {
    std::string text;
    append_number(text, value);
    return text;
}

Outcome<curve::Points> read_points(const json& value,
                                   std::string_view place,
                                   std::size_t most) {
    if (!value.is_array()) return not_rows(value, place);
    const auto& rows = value.get_ref<const json::array_t&>();
    if (rows.empty()) return curve::Points();
    if (rows.size() > most) return too_many(place, rows.size(), most);
    if (!rows.front().is_array()) return not_rows(rows.front(), place_of(place, 0));
    const std::size_t dimension = rows.front().size();
    if (dimension < 1 || dimension > std::size_t{curve::kMostDimensions})
        return impossible("dimension_out_of_range",
                          place_of(place, 0) + " has " + std::to_string(dimension) +
                              " numbers, not 1 to 8",
                          place_of(place, 0));
    curve::Points points(rows.size(), static_cast<int>(dimension));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (!rows[i].is_array()) return not_rows(rows[i], place_of(place, i));
        const auto& row = rows[i].get_ref<const json::array_t&>();
        if (row.size() != dimension)
            return impossible("mixed_dimensions",
                              place_of(place, i) + " has " + std::to_string(row.size()) +
                                  " numbers, the first has " + std::to_string(dimension),
                              place_of(place, i));
        // The place is put together where there is something to say.
        double* const out = points[i].data();
        const bool plain = std::ranges::all_of(row, [](const json& number) {
            return number.is_number_float() &&
                   std::abs(*number.get_ptr<const double*>()) <=
                       curve::kLargestCoordinate;
        });
        if (plain) {
            for (std::size_t k = 0; k < dimension; ++k)
                out[k] = *row[k].get_ptr<const double*>();
        } else if (auto problem = read_row(row, place_of(place, i), out)) {
            return *std::move(problem);
        }
    }
    return points;
}

Outcome<std::vector<double>> read_numbers(const json& value,
                                          std::string_view place,
                                          std::size_t most) {
    if (!value.is_array())
        return malformed(std::string(place) + " '" + shown_json(value) +
                             "' is not an array of numbers",
                         place);
    const auto& row = value.get_ref<const json::array_t&>();
    if (row.size() > most) return too_many(place, row.size(), most);
    std::vector<double> numbers(row.size());
    if (auto problem = read_row(row, place, numbers.data())) return *std::move(problem);
    return numbers;
}

void append_number(std::string& out, double value) {
    if (!std::isfinite(value)) {
        out += "null";
        return;
    }
    std::array<char, 32> digits{};  // the longest double in fewest digits has 24
    const auto end = std::to_chars(digits.begin(), digits.end(), value).ptr;
    out.append(digits.data(), end);
}

void append_numbers(std::string& out, std::span<const double> numbers) {
    out += '[';
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (i > 0) out += ',';
        append_number(out, numbers[i]);
    }
    out += ']';
}

void append_points(std::string& out, const curve::Points& points) {
    constexpr std::size_t kUsualDigits = 19;
    out.reserve(out.size() + points.numbers().size() * kUsualDigits + 2 * points.size());
    out += '[';
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i > 0) out += ',';
        append_numbers(out, points[i]);
    }
    out += ']';
}

std::string points_text(const curve::Points& points) {
    std::string text;
    append_points(text, points);
    return text;
}

std::string numbers_text(std::span<const double> numbers) {
    std::string text;
    append_numbers(text, numbers);
    return text;
}

}  // namespace haarmony::server
