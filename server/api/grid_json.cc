#include "server/api/grid_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "server/api/curve_json.h"
#include "server/api/points_json.h"

namespace haarmony::server {

using nlohmann::json;

Outcome<curve::Grid> read_grid(const json& value, std::string_view place) {
    if (!value.is_array())
        return malformed(std::string(place) + " '" + shown_json(value) +
                             "' is not a grid of points, [[[x, y, z], ...], ...]",
                         place);
    std::vector<curve::Points> rows;
    std::size_t count = 0;
    for (const json& row : value) {
        const std::string here =
            std::string(place) + '[' + std::to_string(rows.size()) + ']';
        auto points = read_points(row, here, kMostPoints);
        if (!points) return points.problem();
        if (!rows.empty() && points->size() != rows.front().size())
            return impossible("uneven_grid",
                              here + " has " + std::to_string(points->size()) +
                                  " points, the first row has " +
                                  std::to_string(rows.front().size()),
                              here);
        if (!rows.empty() && points->dimension() != rows.front().dimension())
            return impossible("mixed_dimensions",
                              here + " has points of " +
                                  std::to_string(points->dimension()) +
                                  " numbers, the first row of " +
                                  std::to_string(rows.front().dimension()),
                              here);
        count += points->size();
        if (count > kMostPoints)
            return impossible("too_many_points",
                              std::string(place) + " has more than " +
                                  std::to_string(kMostPoints) + " points",
                              place);
        rows.push_back(*std::move(points));
    }
    if (count == 0) return curve::Grid();
    curve::Grid grid(rows.size(), rows.front().size(), rows.front().dimension());
    auto out = grid.points.numbers().begin();
    for (const curve::Points& row : rows) out = std::ranges::copy(row.numbers(), out).out;
    return grid;
}

void append_grid(std::string& out, const curve::Grid& grid) {
    out += '[';
    for (std::size_t a = 0; a < grid.along_u; ++a) {
        if (a > 0) out += ',';
        out += '[';
        for (std::size_t b = 0; b < grid.along_v; ++b) {
            if (b > 0) out += ',';
            append_numbers(out, grid.at(a, b));
        }
        out += ']';
    }
    out += ']';
}

std::string grid_text(const curve::Grid& grid) {
    std::string text;
    append_grid(text, grid);
    return text;
}

std::string size_text(const curve::Grid& grid) {
    return std::to_string(grid.along_u) + " x " + std::to_string(grid.along_v);
}

}  // namespace haarmony::server
