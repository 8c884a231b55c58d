#include "server/api/curve_edit_json.h"

#include <array>
#include <string>
#include <utility>

namespace haarmony::server {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 2> kDrags{"smooth", "full"};
constexpr std::array<std::string_view, 2> kUnits{"length", "fraction"};

// The same problem of a member of `within`.
http::Problem inside(http::Problem problem, std::string_view within) {
    problem.param =
        std::string(within) + (problem.param.empty() ? "" : ".") + problem.param;
    return problem;
}

Outcome<Pulled> read_pulled(const json& value, std::string_view name) {
    if (!value.is_object())
        return malformed(
            std::string(name) + " '" + shown_json(value) + "' is not an object", name);
    auto members = Inputs::of_object(value);
    if (!members) return inside(members.problem(), name);
    Pulled pulled;
    const bool is_control = name == "control";
    if (is_control) {
        pulled.index = read_whole(*members, "index");
    } else {
        pulled.u = read_real(*members, "u");
        if (const json* near = members->peek("near")) {
            auto place = read_numbers(*near, "near", curve::kMostDimensions);
            if (!place) return inside(place.problem(), name);
            if (place->size() != 2)
                return inside(malformed("near '" + numbers_text(*place) +
                                            "' is not two numbers, x and y",
                                        "near"),
                              name);
            pulled.near = *std::move(place);
        }
    }
    if (const json* delta = members->peek("delta")) {
        auto numbers = read_numbers(*delta, "delta", curve::kMostDimensions);
        if (!numbers) return inside(numbers.problem(), name);
        pulled.delta = *std::move(numbers);
    } else {
        return inside(malformed("delta is missing", "delta"), name);
    }
    if (const auto problem = members->refused()) return inside(*problem, name);
    if (is_control && !pulled.index)
        return inside(malformed("index is missing", "index"), name);
    if (!is_control && pulled.u.has_value() != pulled.near.empty())
        return inside(malformed("exactly one of u and near is to be given", "u"), name);
    return pulled;
}

}  // namespace

Outcome<EditRequest> read_edit(Inputs& inputs) {
    EditRequest edit;
    edit.level = read_real(inputs, "level");
    edit.portion = read_real(inputs, "portion");
    if (edit.portion && !(*edit.portion > 0)) inputs.refuse("portion", "is not above 0");
    edit.fraction = inputs.one_of("portion_unit", kUnits) == kUnits[1];
    if (inputs.one_of("drag", kDrags) == kDrags[1]) edit.drag = curve::Drag::kFull;
    edit.frame = read_frame(inputs).value_or(curve::Frame::kFixed);
    const json* control = inputs.peek("control");
    const json* point = inputs.peek("point");
    if (auto problem = refused_so_far(inputs)) return *std::move(problem);
    if ((control == nullptr) == (point == nullptr))
        return malformed("exactly one of control and point is to be given", "control");
    if (edit.level.has_value() == edit.portion.has_value())
        return malformed("exactly one of level and portion is to be given", "level");
    if (inputs.has("portion_unit") && !edit.portion)
        return malformed("portion_unit is the unit of portion, which is missing",
                         "portion_unit");
    if (inputs.has("drag") && control)
        return malformed("drag says how a point is dragged, not a control point", "drag");
    auto pulled =
        control ? read_pulled(*control, "control") : read_pulled(*point, "point");
    if (!pulled) return pulled.problem();
    edit.pulled = *std::move(pulled);
    return edit;
}

}  // namespace haarmony::server
