// Grids of points in JSON: [[[x, y, z], ...], ...], u index first.
//
// Errors   as points_json.h; 422 for rows of different length.
// Threads  values.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "engine/curve/surface.h"
#include "server/api/outcome.h"

namespace haarmony::server {

// An empty grid has no dimension.
[[nodiscard]] Outcome<curve::Grid> read_grid(const nlohmann::json& value,
                                             std::string_view place);

void append_grid(std::string& out, const curve::Grid& grid);
[[nodiscard]] std::string grid_text(const curve::Grid& grid);

// "35 x 35".
[[nodiscard]] std::string size_text(const curve::Grid& grid);

}  // namespace haarmony::server
