// A drawing as the page sends it:
//   {"width": w, "height": h, "background": null or "#rrggbb", "items": [{"points":
//    [[x, y], ...], "width": px or [px, ...], "color": "#rrggbb", "fill": false}, ...]}
//
// Errors  400 naming the place ("strokes.items[2].color") of a missing, unknown or wrong
//         member; 422 for a drawing without anything painted and a stroke without points.
// Threads const-safe.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "engine/image/strokes.h"
#include "server/api/outcome.h"

namespace haarmony::server {

[[nodiscard]] Outcome<image::StrokePicture> parse_strokes(const nlohmann::json& value);

}  // namespace haarmony::server
