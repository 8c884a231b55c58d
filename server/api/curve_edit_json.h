// What a request wants edited.
//   Inputs -> [curve_edit_json] -> curve_edit.cc
//
// Errors   as points_json.h, naming the member: "control.index".
// Threads  values.
#pragma once

#include <optional>
#include <vector>

#include "engine/curve/direct_edit.h"
#include "server/api/curve_json.h"

namespace haarmony::server {

// What is pulled: a control point, or a point of the curve at u or near a place.
struct Pulled {
    std::optional<double> index;
    std::optional<double> u;
    std::vector<double> near;
    std::vector<double> delta;
};

struct EditRequest {
    std::optional<double> level;
    std::optional<double> portion;
    bool fraction = false;  // of the length of the curve
    Pulled pulled;
    curve::Drag drag = curve::Drag::kSmooth;
    curve::Frame frame = curve::Frame::kFixed;
};

[[nodiscard]] Outcome<EditRequest> read_edit(Inputs& inputs);

}  // namespace haarmony::server
