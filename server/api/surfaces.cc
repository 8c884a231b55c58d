#include "server/api/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/curve/surface.h"
#include "server/api/curve_json.h"
#include "server/api/grid_json.h"
#include "server/http/json.h"

namespace haarmony::server {
namespace {

using curve::Ends;
using nlohmann::json;

struct Surface {
    curve::Grid control;
    std::array<int, 2> levels{};
};

std::optional<std::array<int, 2>> levels_of(const curve::Grid& grid) {
    const auto u = curve::level_of(grid.along_u, Ends::kOpen);
    const auto v = curve::level_of(grid.along_v, Ends::kOpen);
    if (!u || !v) return {};
    return std::array<int, 2>{*u, *v};
}

http::Problem no_levels(const curve::Grid& grid, std::string_view place) {
    return impossible("grid_size",
                      std::string(place) + " is a grid of " + size_text(grid) +
                          " points, not of 2^a + 3 by 2^b + 3",
                      place);
}

Outcome<Surface> read_surface(Inputs& inputs) {
    const json* points = inputs.peek("points");
    if (auto problem = refused_so_far(inputs)) return *std::move(problem);
    if (points == nullptr) return malformed("points is missing", "points");
    auto grid = read_grid(*points, "points");
    if (!grid) return grid.problem();
    const auto levels = levels_of(*grid);
    if (!levels) return no_levels(*grid, "points");
    return Surface{*std::move(grid), *levels};
}

// Two numbers of a member that is an array of them.
Outcome<std::array<double, 2>> read_pair(const json& value, std::string_view name) {
    auto numbers = read_numbers(value, name, 2);
    if (!numbers) return numbers.problem();
    if (numbers->size() != 2)
        return malformed(std::string(name) + " '" + numbers_text(*numbers) +
                             "' is not two numbers, one for u and one for v",
                         name);
    return std::array<double, 2>{(*numbers)[0], (*numbers)[1]};
}

std::string levels_text(std::array<int, 2> levels) {
    const std::array<double, 2> numbers{double(levels[0]), double(levels[1])};
    return numbers_text(numbers);
}

// A grid of details: of so many points of the surface's dimension.
Outcome<curve::Grid> read_detail(const json& details,
                                 const std::string& name,
                                 std::size_t step,
                                 std::array<std::size_t, 2> size,
                                 int dimension) {
    const std::string place = "details[" + std::to_string(step) + "]." + name;
    if (!details.contains(name)) return malformed(place + " is missing", place);
    auto grid = read_grid(details[name], place);
    if (!grid) return grid;
    if (grid->along_u != size[0] || grid->along_v != size[1])
        return impossible("grid_size",
                          place + " is a grid of " + size_text(*grid) + " points, not " +
                              std::to_string(size[0]) + " x " + std::to_string(size[1]),
                          place);
    if (grid->points.dimension() != dimension)
        return impossible("mixed_dimensions",
                          place + " has points of " +
                              std::to_string(grid->points.dimension()) +
                              " numbers, coarse of " + std::to_string(dimension),
                          place);
    return grid;
}

Outcome<curve::DetailGrids> read_step(const json& value,
                                      std::size_t step,
                                      std::array<int, 2> levels,
                                      int dimension) {
    const std::string place = "details[" + std::to_string(step) + "]";
    if (!value.is_object())
        return malformed(
            place + " '" + shown_json(value) + "' is not an object of cd, dc and dd",
            place);
    for (const auto& [name, member] : value.items())
        if (name != "cd" && name != "dc" && name != "dd")
            return http::Problem{400,
                                 "unknown_parameter",
                                 "'" + name.substr(0, 80) + "' is not known in " + place,
                                 place + "." + name,
                                 {}};
    const std::size_t cu = curve::control_count(levels[0], Ends::kOpen);
    const std::size_t cv = curve::control_count(levels[1], Ends::kOpen);
    const std::size_t du = curve::segment_count(levels[0]);
    const std::size_t dv = curve::segment_count(levels[1]);
    auto cd = read_detail(value, "cd", step, {cu, dv}, dimension);
    if (!cd) return cd.problem();
    auto dc = read_detail(value, "dc", step, {du, cv}, dimension);
    if (!dc) return dc.problem();
    auto dd = read_detail(value, "dd", step, {du, dv}, dimension);
    if (!dd) return dd.problem();
    return curve::DetailGrids{*std::move(cd), *std::move(dc), *std::move(dd)};
}

struct Decomposition {
    curve::MultiresSurface surface;
    std::array<int, 2> coarse{};
};

Outcome<Decomposition> read_decomposition(const json& coarse, const json& details) {
    Decomposition read;
    auto grid = read_grid(coarse, "coarse");
    if (!grid) return grid.problem();
    const auto levels = levels_of(*grid);
    if (!levels) return no_levels(*grid, "coarse");
    if (std::min((*levels)[0], (*levels)[1]) > 0)
        return impossible("grid_size",
                          "coarse is a grid of " + size_text(*grid) +
                              " points, but has 4 in one direction at least",
                          "coarse");
    read.coarse = *levels;
    read.surface.coarse = *std::move(grid);
    if (!details.is_array())
        return malformed("details '" + shown_json(details) + "' is not an array",
                         "details");
    const int finest = std::max((*levels)[0], (*levels)[1]);
    const auto most = static_cast<std::size_t>(curve::kMostLevel - finest);
    if (details.size() > most)
        return impossible("level_out_of_range",
                          "details has " + std::to_string(details.size()) +
                              " levels, more than " + std::to_string(most),
                          "details");
    const int dimension = read.surface.coarse.points.dimension();
    for (std::size_t step = 0; step < details.size(); ++step) {
        const int up = static_cast<int>(step);
        auto grids = read_step(
            details[step], step, {read.coarse[0] + up, read.coarse[1] + up}, dimension);
        if (!grids) return grids.problem();
        read.surface.details.push_back(*std::move(grids));
    }
    return read;
}

// Which reconstruction has levels [k, l]: so many steps from the coarse grid, if they fit.
std::optional<std::size_t> steps_to(std::array<double, 2> level,
                                    const Decomposition& decomposition) {
    const double steps = level[0] - decomposition.coarse[0];
    if (level[1] - decomposition.coarse[1] != steps || std::trunc(steps) != steps)
        return {};
    if (!(steps >= 0 && steps <= double(decomposition.surface.details.size()))) return {};
    return static_cast<std::size_t>(steps);
}

struct SurfaceEditRequest {
    std::array<double, 2> level{};
    std::array<double, 2> index{};
    std::vector<double> delta;
};

Outcome<SurfaceEditRequest> read_surface_edit(Inputs& inputs) {
    const json* level = inputs.peek("level");
    const auto control = inputs.object("control");
    if (auto problem = refused_so_far(inputs)) return *std::move(problem);
    if (level == nullptr) return malformed("level is missing", "level");
    if (!control) return malformed("control is missing", "control");
    auto levels = read_pair(*level, "level");
    if (!levels) return levels.problem();
    auto members = Inputs::of_object(*control);
    if (!members) return members.problem();
    const json* place = members->peek("index");
    const json* by = members->peek("delta");
    if (auto problem = members->refused()) {
        problem->param = "control." + problem->param;
        return *std::move(problem);
    }
    if (place == nullptr) return malformed("control.index is missing", "control.index");
    if (by == nullptr) return malformed("control.delta is missing", "control.delta");
    auto index = read_pair(*place, "control.index");
    if (!index) return index.problem();
    auto delta = read_numbers(*by, "control.delta", curve::kMostDimensions);
    if (!delta) return delta.problem();
    return SurfaceEditRequest{*levels, *index, *std::move(delta)};
}

// Once the grid is known.
std::optional<http::Problem> refuse_surface_edit(const SurfaceEditRequest& edit,
                                                 const Surface& surface) {
    const int dimension = surface.control.points.dimension();
    if (edit.delta.size() != static_cast<std::size_t>(dimension))
        return impossible("mixed_dimensions",
                          "control.delta has " + std::to_string(edit.delta.size()) +
                              " numbers, the points have " + std::to_string(dimension),
                          "control.delta");
    for (std::size_t way = 0; way < 2; ++way) {
        const std::string at = "[" + std::to_string(way) + "]";
        if (auto problem =
                refuse_level("level" + at, edit.level[way], surface.levels[way]))
            return problem;
        const double index = edit.index[way];
        const int controls = static_cast<int>(std::ceil(edit.level[way]));
        const std::size_t count = curve::control_count(controls, Ends::kOpen);
        if (!(index >= 0 && index < double(count) && std::trunc(index) == index))
            return impossible("out_of_range",
                              "control.index" + at + " '" + number_text(index) +
                                  "' is not a whole number from 0 to " +
                                  std::to_string(count - 1),
                              "control.index" + at);
    }
    return {};
}

curve::SurfaceEdit to_engine(const SurfaceEditRequest& edit) {
    curve::SurfaceEdit engine;
    engine.level_u = edit.level[0];
    engine.level_v = edit.level[1];
    engine.index_u = static_cast<std::size_t>(edit.index[0]);
    engine.index_v = static_cast<std::size_t>(edit.index[1]);
    engine.delta = edit.delta;
    return engine;
}

}  // namespace

Reply post_surface_decompose(const Context& /*context*/, const http::Request& request) {
    auto inputs = curve_inputs(request);
    if (!inputs) return inputs.problem();
    auto surface = read_surface(*inputs);
    if (!surface) return surface.problem();
    if (const auto problem = inputs->refused()) return *problem;
    const curve::MultiresSurface apart = curve::decompose(surface->control);
    std::string details = "[";
    for (const curve::DetailGrids& step : apart.details) {
        if (details.size() > 1) details += ',';
        JsonObject grids(details);
        grids.json("cd", grid_text(step.cd))
            .json("dc", grid_text(step.dc))
            .json("dd", grid_text(step.dd));
        grids.end();
    }
    std::string text;
    JsonObject reply(text);
    reply.json("levels", levels_text(surface->levels))
        .json("coarse", grid_text(apart.coarse))
        .json("details", details + ']');
    reply.end();
    return http::json_text_response(200, std::move(text));
}

Reply post_surface_reconstruct(const Context& /*context*/, const http::Request& request) {
    auto inputs = curve_inputs(request);
    if (!inputs) return inputs.problem();
    const json* coarse = inputs->peek("coarse");
    const json* details = inputs->peek("details");
    const json* levels = inputs->peek("levels");
    const json* level = inputs->peek("level");
    if (const auto problem = inputs->refused()) return *problem;
    if (coarse == nullptr) return malformed("coarse is missing", "coarse");
    if (details == nullptr) return malformed("details is missing", "details");
    auto apart = read_decomposition(*coarse, *details);
    if (!apart) return apart.problem();
    const std::size_t all = apart->surface.details.size();
    const std::array<int, 2> finest{apart->coarse[0] + static_cast<int>(all),
                                    apart->coarse[1] + static_cast<int>(all)};
    if (levels != nullptr) {
        auto said = read_pair(*levels, "levels");
        if (!said) return said.problem();
        if ((*said)[0] != finest[0] || (*said)[1] != finest[1])
            return impossible("level_out_of_range",
                              "levels '" + numbers_text(*said) +
                                  "' are not those of coarse and details, " +
                                  levels_text(finest),
                              "levels");
    }
    std::size_t steps = all;
    if (level != nullptr) {
        auto wanted = read_pair(*level, "level");
        if (!wanted) return wanted.problem();
        const auto found = steps_to(*wanted, *apart);
        if (!found)
            return impossible("level_out_of_range",
                              "level '" + numbers_text(*wanted) + "' is none from " +
                                  levels_text(apart->coarse) + " to " +
                                  levels_text(finest) + " in steps of both directions",
                              "level");
        steps = *found;
    }
    const int up = static_cast<int>(steps);
    std::string text;
    JsonObject reply(text);
    reply.json("points", grid_text(curve::reconstruct(apart->surface, steps)))
        .json("levels", levels_text({apart->coarse[0] + up, apart->coarse[1] + up}));
    reply.end();
    return http::json_text_response(200, std::move(text));
}

Reply post_surface_edit(const Context& /*context*/, const http::Request& request) {
    auto inputs = curve_inputs(request);
    if (!inputs) return inputs.problem();
    auto edit = read_surface_edit(*inputs);
    if (!edit) return edit.problem();
    auto surface = read_surface(*inputs);
    if (!surface) return surface.problem();
    if (const auto problem = inputs->refused()) return *problem;
    if (auto problem = refuse_surface_edit(*edit, *surface)) return *std::move(problem);
    const auto edited = curve::edit_surface(surface->control, to_engine(*edit));
    if (!edited) return impossible(edited.error());
    std::string text;
    JsonObject reply(text);
    reply.json("points", grid_text(edited->control))
        .json("levels", levels_text(surface->levels))
        .integer("changed", static_cast<std::int64_t>(edited->changed));
    reply.end();
    return http::json_text_response(200, std::move(text));
}

}  // namespace haarmony::server
